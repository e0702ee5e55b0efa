// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/model/wire_rules.hpp>
#include <host/app/text/find.hpp>

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

/// A type of node: its entry, what is searched in it, and its ports.
struct PaletteType
{
    PaletteEntry entry;
    Findable searched;   ///< names and ids, the name that a new node gets, keywords, and in the text, the summary, ports, units and quantities
    Face face;

    bool fits (const WireEnd&) const;   ///< whether it has a port for this end of a wire
};

/// The description of a node that is dragged from a list, and the type of a dragged node; empty if something else is dragged.
std::string asDragged (const PaletteEntry&);
std::string typeOfDragged (const std::string&);

/// The types of the catalogue and the subgraphs of a graph, without the subgraphs that are or contain `patch`, where a node will be.
std::vector<PaletteType> paletteTypes (const graph::Graph&, const Catalogue&, const std::string& patch = {});

/// Finds types of nodes, as text/find.hpp says. Each result has a port for every wire end in `fits`: one end for a dropped wire, two for inserting
/// into a wire. Without a query, all entries come in groups: those whose port is made for the one end in `fits`, if they are few; of the others,
/// the types in `recent`; and the families.
std::vector<PaletteEntry> searchPalette (const std::string& query, const graph::Graph&, const Catalogue&, const std::vector<WireEnd>& fits,
                                         const std::vector<std::string>& recent = {}, const std::string& patch = {});

/// The entries that fit the query, the best first. An entry without a name is known by its type.
std::vector<PaletteEntry> matching (const std::vector<PaletteEntry>&, const std::string& query);

/// A function that returns the entries that a palette lists for a query.
using PaletteSearch = std::function<std::vector<PaletteEntry> (const std::string& query)>;

/// Searches these entries.
PaletteSearch searchIn (std::vector<PaletteEntry>);

}   // namespace tactus::host
