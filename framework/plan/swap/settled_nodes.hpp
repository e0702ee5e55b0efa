// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plan/build/outside.hpp>

#include <vector>

namespace tactus::plan
{

/// By node: whether nothing that runs in a tick can change its inputs, so that its outputs only change with a param. Such a node has no
/// state, and its inputs come from other such nodes or from nowhere. It runs on the first tick of a plan, and whenever a param was
/// written; see Plan::tick.
///
/// In a section with its own rate no node is settled, because there outputs must change only when the section runs.
std::vector<bool> settledNodes (const Flat&, const Outside&);

}   // namespace tactus::plan
