// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tactus::host
{

/// From now on, a stop request (Ctrl-C, Ctrl-Z, a closed terminal, kill) is recorded instead of ending the program
/// immediately, so that forces can go to zero and files are either complete or absent. [main thread]
void watchForStop() noexcept;

/// True once a stop was requested. [any thread]
bool stopRequested() noexcept;

/// Requests a stop, as a signal does. [any thread]
void requestStop() noexcept;

/// Sets the actions of two signals, on systems that have them: SIGUSR1 calls `stop`, the emergency stop; SIGUSR2, which used to
/// rearm, calls `asked_to_rearm`. Either is called on any thread, at any point of its work. Null: no action. [main thread]
void watchForEmergency (void (*stop)() noexcept, void (*asked_to_rearm)() noexcept) noexcept;

}   // namespace tactus::host
