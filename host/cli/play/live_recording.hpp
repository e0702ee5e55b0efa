// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/cli/command_run.hpp>
#include <host/cli/recorder.hpp>
#include <tactus/kit/threads/spsc_ring.hpp>
#include <tactus/run/runner.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// Records a run while it ticks, but not the ticks while it halts. The tick thread never waits for the files, and a full
/// disk ends the recording but not the run. If the process is killed, the recording up to its last second is kept in a file next to the
/// target (IfKilled::kept).
class LiveRecording final : public RunListener
{
public:
    /// Creates the files; they appear under their final names at commit(). [main thread]
    LiveRecording (Run&, const std::vector<std::string>& files);

    void after (const Plan&, std::uint64_t tick, bool halts) noexcept override;   // [tick thread]

    /// Writes the frames that have arrived; call this many times a second. Prints a warning to stderr for each file that
    /// cannot be written and is given up.
    /// [main thread]
    void drain();

    /// Writes the remaining frames and completes the files. Prints a warning to stderr if ticks are missing. If a
    /// file could not be written, returns the reason for the first one. [main thread, after the run]
    std::optional<Message> commit();

private:
    void giveUp (std::vector<Message>);

    Recorder recorder;
    std::optional<Message> failure;
    std::uint64_t ticks_per_flush, drained = 0, flushed = 0;   // drained, flushed: number of ticks before the next one
    SpscRing<double> ring;                                     // each frame: the number of a tick, and the values of that tick
};

}   // namespace tactus::host
