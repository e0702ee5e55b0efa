// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/model/wire_rules.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// An entry of the palette.
struct PaletteEntry
{
    std::string type;   ///< "friction.elasto_plastic", "graph:grain"
    std::string name, summary;
};

/// Finds the node types of the catalogue and the subgraphs of a graph that contain all words of the query in their id, name,
/// summary, ports, units or quantities. Those whose id or name starts with the query come first. Each result has a port for
/// every wire end in `fits`: one end for a dropped wire, two for inserting into a wire.
std::vector<PaletteEntry> searchPalette (const std::string& query, const graph::Graph&, const Catalogue&, const std::vector<WireEnd>& fits);

/// The entries that contain all words of the query, in the given order.
std::vector<PaletteEntry> matching (const std::vector<PaletteEntry>&, const std::string& query);

}   // namespace tactus::host
