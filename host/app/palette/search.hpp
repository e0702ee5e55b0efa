// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/model/wire_rules.hpp>

#include <functional>
#include <string>
#include <vector>

namespace tactus::host
{

/// An entry of the palette, or the title of a group of entries.
struct PaletteEntry
{
    std::string type;   ///< "friction.elasto_plastic", "graph:grain"; empty for a title
    std::string name, summary;

    bool isTitle() const noexcept { return type.empty(); }
};

/// Finds the node types of the catalogue and the subgraphs of a graph, as text/find.hpp says, by their names and ids, the names that new nodes of
/// them get, their keywords, and their summaries, ports, units and quantities. Each result has a port for every wire end in `fits`: one end for a
/// dropped wire, two for inserting into a wire. Subgraphs that are or contain `patch`, where the node will be, are left out. Without a query, all
/// entries come in groups: the types in `recent`, then the families.
std::vector<PaletteEntry> searchPalette (const std::string& query, const graph::Graph&, const Catalogue&, const std::vector<WireEnd>& fits,
                                         const std::vector<std::string>& recent = {}, const std::string& patch = {});

/// The entries that fit the query, the best first.
std::vector<PaletteEntry> matching (const std::vector<PaletteEntry>&, const std::string& query);

/// What a palette lists for a query.
using PaletteSearch = std::function<std::vector<PaletteEntry> (const std::string& query)>;

/// Searches these entries.
PaletteSearch searchIn (std::vector<PaletteEntry>);

}   // namespace tactus::host
