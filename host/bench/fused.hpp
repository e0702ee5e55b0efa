// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contest.hpp"

#include <vector>

namespace tactus::bench
{

/// Contests of plans, and for some of them the same with the plan fused (docs/fusion.md). Compiles the code, without optimisation if `quick`.
/// Without a compiler, none is added, and the reason is printed to stderr. [message thread]
std::vector<Contest> withFused (std::vector<Contest>, bool quick = false);

}   // namespace tactus::bench
