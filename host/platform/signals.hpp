// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tactus::host
{

/// From now on, a stop request (Ctrl-C, Ctrl-Z, Ctrl-\\, a closed terminal or pipe, kill, a timer, a limit on CPU time) is recorded
/// instead of ending or suspending the program immediately, so that forces can go to zero and files are either complete or
/// absent. Only SIGKILL and SIGSTOP cannot be caught, and faults are left to Failsafe. [main thread]
void watchForStop() noexcept;

/// True once a stop was requested. [any thread]
bool stopRequested() noexcept;

/// Requests a stop, as a signal does. [any thread]
void requestStop() noexcept;

/// Sets the actions of two signals, on systems that have them: SIGUSR1 calls `stop`, the emergency stop; SIGUSR2, which rearmed in
/// earlier versions, calls `asked_to_rearm`. The system calls them on any thread, whatever it is doing. Null: no action.
/// [main thread]
void watchForEmergency (void (*stop)() noexcept, void (*asked_to_rearm)() noexcept) noexcept;

}   // namespace tactus::host
