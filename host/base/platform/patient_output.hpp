// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

namespace tactus::host
{

/// From now on, a pipe or a terminal that takes nothing cannot keep this program from ending: once a stop was requested, its standard output, its
/// messages, and the pipes that it writes (openPipesBy) are given up after this time without any progress. Writing to them then fails. Opening a
/// pipe that nobody reads ends with the stop, too. A reader that is only slow gets everything. Call it again to change the time. [main thread]
void giveUpBlockedOutputs (std::chrono::milliseconds after = std::chrono::seconds (2));

}   // namespace tactus::host
