// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tactus
{

/// Requests what helps the calling thread to be on time: priority over everything that is not real-time (SCHED_FIFO), a fixed
/// core if one is given, and no timer slack. Returns a sentence for each request that is refused; the thread runs anyway. [the
/// thread itself, before its first tick]
std::vector<std::string> becomeRealTime (std::optional<int> core);

/// Keeps the memory of the process from being paged out. Returns why it failed, if it failed. [main thread]
std::optional<std::string> lockMemory();

}   // namespace tactus
