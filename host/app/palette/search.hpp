// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/model/wire_rules.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// Something that can be put on the canvas.
struct PaletteEntry
{
    std::string type;   ///< "friction.elasto_plastic", "graph:grain"
    std::string name, summary;
};

/// The types of the catalogue and the subgraphs of a graph that have all words of the query in their id, name, sentence, or
/// in the unit or quantity of a port; those whose id or name begins with it first. Only those with a port that fits each of
/// the wire ends: one that waits, or both of a wire that something is to be put into.
std::vector<PaletteEntry> searchPalette (const std::string& query, const graph::Graph&, const Catalogue&, const std::vector<WireEnd>& fits);

/// Those that have all words of the query, in the order they came.
std::vector<PaletteEntry> matching (const std::vector<PaletteEntry>&, const std::string& query);

}   // namespace tactus::host
