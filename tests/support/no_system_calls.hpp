// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace tactus::test
{

/// True where forbidSystemCalls works: Linux on x86-64 and aarch64, without a sanitizer, which has calls of its own.
bool canForbidSystemCalls() noexcept;

/// From now on, any system call of this thread but write and exit kills the process with SIGSYS. For a child process:
/// there is no way back.
void forbidSystemCalls() noexcept;

/// How a child process ended.
struct ChildEnd
{
    int status = -1;   ///< what `run` returned; -1 if it did not come to that
    int signal = 0;    ///< that killed it, or 0
};

/// Forks, and runs this in the child, which ends with it at once, whatever other threads it started are at.
ChildEnd inChild (const std::function<int()>& run);

}   // namespace tactus::test
