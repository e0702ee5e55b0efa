// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// Asks the system to let the calling thread be on time: before all that is not real time (SCHED_FIFO), on one core if
/// one is named, woken without slack. Returns a sentence for each thing that is not granted; the thread runs all the
/// same. [the thread itself, before its first tick]
std::vector<std::string> becomeRealTime (std::optional<int> core);

/// Keeps the memory of the process from being paged out. Returns why not, if not. [main thread]
std::optional<std::string> lockMemory();

}   // namespace tactus::host
