// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/examine/forbid_system_calls.hpp>

#include <functional>

namespace tactus::test
{

using examine::Allow;
using examine::canForbidSystemCalls;

/// From now on, any system call of this thread except write, exit and the allowed ones kills the process with SIGSYS. Use
/// it in a child process only: it cannot be undone.
inline void forbidSystemCalls (Allow allowed = Allow::writing) noexcept { examine::forbidSystemCalls (allowed); }

/// How a child process ended.
struct ChildEnd
{
    int status = -1;   ///< what `run` returned; -1 if it did not return
    int signal = 0;    ///< the signal that killed it, or 0
};

/// Forks and runs this in the child. The child exits as soon as the function returns, no matter what its other threads are
/// doing.
ChildEnd inChild (const std::function<int()>& run);

}   // namespace tactus::test
