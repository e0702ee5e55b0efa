// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

namespace tactus::check_plugin
{

/// The result of work in a separate process.
struct ProcessResult
{
    bool done = false;       ///< the work returned
    std::string answer {};   ///< what the work returned, if done
    std::string why {};      ///< if not done: how the process ended, and in which hook
    bool endless = false;    ///< the process had to be killed, because the work never finished
};

/// The CPU time that work in a separate process may take.
struct Budget
{
    int cpu_seconds;     ///< of CPU time, for all of the work
    int call_seconds;    ///< of CPU time, from one entry into a hook (examine::Stage) to the next
    std::string of {};   ///< whose hooks they are, for messages: "mylab.rough_wood"
};

/// Runs `work` in a separate process, and waits until that process has ended. Its standard output goes to standard error. The process
/// is killed once it has used its CPU time, however long that takes in real time, or once all its threads have been waiting for a
/// minute. So a busy machine does not change the result. [main thread, no other threads]
ProcessResult runApart (const Budget&, const std::function<std::string()>& work);

}   // namespace tactus::check_plugin
