// SPDX-License-Identifier: MIT
#pragma once

namespace tactus::examine
{

/// True where forbidSystemCalls works: Linux on x86-64 and aarch64, without a sanitizer (sanitizers make their own
/// system calls).
bool canForbidSystemCalls() noexcept;

enum class Allow
{
    writing,          ///< write
    waking_threads,   ///< write, and futex with FUTEX_WAKE
    nothing
};

/// From now on, any system call of this thread except exit and the allowed ones raises SIGSYS. Without a handler, that ends the
/// process; a handler finds the number of the call in `si_syscall`. Use it in a child process only: it cannot be undone.
void forbidSystemCalls (Allow) noexcept;

}   // namespace tactus::examine
