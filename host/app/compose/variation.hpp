// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Other values for the parameters of a graph: those between two snapshots, and random ones.

#include <tactus/graph/edit.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/text/result.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tactus::host
{

/// The result of morphBetween().
struct Morph
{
    graph::Command command = graph::Batch {};
    std::string control;                    ///< the id of the new control
    int params = 0;                         ///< the number of parameters that it moves
    int left_out = 0;                       ///< differing values that it cannot move: choices, switches, vectors, values in subgraphs, and what a wire sets
    std::vector<std::string> replaced {};   ///< the names of the controls whose place it takes, because their values differ
};

/// Recalls a snapshot, and adds a control that moves numbers linearly from there to another snapshot, in one undo step. It takes the place of the controls
/// that differ, because a parameter has one control. In both snapshots, it is at its end, so that recalling one moves it. Ids: morph/empty (a snapshot is),
/// morph/same (no number differs).
Result<Morph> morphBetween (const graph::Graph&, int from, int to, const Catalogue&);

/// Gives the numbers of these nodes of a patch, and of what is inside of them but mixers, new values, at random within their usual ranges: evenly, or by
/// ratio where a range spans a decade and more. What a wire or a control sets stays, and so do choices, switches, places, vectors and numbers without a
/// usual range. The same seed gives the same values. The name of the step contains the seed. Empty if there is nothing to change.
graph::Batch randomised (const graph::Graph&, const std::string& patch, std::span<const graph::Id> nodes, const Catalogue&, std::uint64_t seed);

}   // namespace tactus::host
