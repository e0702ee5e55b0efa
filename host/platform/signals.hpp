// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tactus::host
{

/// From now on a request to stop (Ctrl-C, a closed terminal, kill) is noted instead of ending the program at once, so
/// that forces go to zero and files are left whole or not at all. [main thread]
void watchForStop() noexcept;

/// True once somebody asked. [any thread]
bool stopRequested() noexcept;

/// Asks as a signal would. [any thread]
void requestStop() noexcept;

}   // namespace tactus::host
