// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tactus::host
{

/// From now on a request to stop (Ctrl-C, Ctrl-Z, a closed terminal, kill) is noted instead of ending the program at once, so
/// that forces go to zero and files are left whole or not at all. [main thread]
void watchForStop() noexcept;

/// True once somebody asked. [any thread]
bool stopRequested() noexcept;

/// Asks as a signal would. [any thread]
void requestStop() noexcept;

/// What the emergency stop does from now on, and what ends it: SIGUSR1 and SIGUSR2 call them, on whichever thread they meet
/// and in the midst of whatever it does, where there are such signals. null: nothing, any more. [main thread]
void watchForEmergency (void (*stop)() noexcept, void (*rearm)() noexcept) noexcept;

}   // namespace tactus::host
