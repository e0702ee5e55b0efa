// SPDX-License-Identifier: GPL-3.0-or-later
#include "search.hpp"

#include <host/app/model/fragment.hpp>
#include <host/app/text/filled.hpp>
#include <host/app/text/find.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <string_view>

namespace tactus::host
{

namespace
{
bool fitsSomewhere (const Face& face, const WireEnd& end)
{
    const bool starts_here = end.port->role != Role::output;
    return std::ranges::any_of (starts_here ? face.outputs : face.inputs, [&] (const FacePort& p) {
        const WireEnd own { &p, p.quantity() };
        return (starts_here ? checkWire (own, end) : checkWire (end, own)).has_value();
    });
}

/// The summary of a type, followed by the name of the plugin if the type comes from one.
std::string summaryOf (const NodeType& type)
{
    const std::string summary (type.info.summary);
    return type.origin.empty() ? summary : summary + " " + filled (TRANS ("Plugin %1."), std::filesystem::path (type.origin).stem().string()).toStdString();
}

std::string familyOf (const std::string& type) { return type.substr (0, type.find_first_of (".:")); }

/// True if a subgraph is a patch, or contains it. `seen` are the subgraphs that have been looked into.
bool holds (const graph::Graph& g, const std::string& subgraph, const std::string& patch, std::set<std::string>& seen)
{
    if (subgraph == patch) return true;
    const auto* inside = seen.insert (subgraph).second ? g.find (subgraph) : nullptr;
    return inside != nullptr && std::ranges::any_of (inside->nodes, [&] (const graph::Node& n) {
               return n.type.starts_with ("graph:") && holds (g, n.type.substr (6), patch, seen);
           });
}

/// The entries in groups: those that were chosen recently, then all by family. Each group begins with its title.
std::vector<PaletteEntry> grouped (const std::vector<PaletteEntry>& entries, const std::vector<std::string>& recent)
{
    std::vector<PaletteEntry> all;
    for (const auto& type : recent)
        if (const auto at = std::ranges::find (entries, type, &PaletteEntry::type); at != entries.end()) all.push_back (*at);
    if (! all.empty()) all.insert (all.begin(), PaletteEntry { {}, TRANS ("Recent").toStdString(), {} });
    std::string family;
    for (const auto& e : entries)
    {
        if (auto its_family = familyOf (e.type); its_family != family)
        {
            family = std::move (its_family);
            auto title = family == "graph" ? TRANS ("Subgraphs of this graph").toStdString() : family;
            title.front() = static_cast<char> (std::toupper (static_cast<unsigned char> (title.front())));
            all.push_back ({ {}, title, {} });
        }
        all.push_back (e);
    }
    return all;
}
}   // namespace

std::vector<PaletteEntry> searchPalette (const std::string& query, const graph::Graph& g, const Catalogue& catalogue, const std::vector<WireEnd>& fits,
                                         const std::vector<std::string>& recent, const std::string& patch_name)
{
    std::vector<PaletteEntry> entries;
    std::vector<Findable> searched;
    const auto consider = [&] (PaletteEntry entry, std::string_view keywords) {
        graph::Node node;
        node.type = entry.type;
        const auto face = faceOf (g, g.root, node, catalogue);
        if (! std::ranges::all_of (fits, [&] (const WireEnd& end) { return fitsSomewhere (face, end); })) return;
        std::string text = entry.summary;
        for (const auto* ports : { &face.inputs, &face.params, &face.outputs })
            for (const auto& p : *ports)
                text += ' ' + p.id + ' ' + std::string (p.unit.unit.symbol) + ' ' + std::string (name (p.quantity()));
        searched.push_back ({ entry.name, entry.type + ' ' + usualName (entry.type), std::string (keywords), std::move (text) });
        entries.push_back (std::move (entry));
    };
    for (const auto& type : catalogue)
        consider ({ std::string (type.info.id), std::string (type.info.name), summaryOf (type) }, type.info.keywords);
    for (const auto& [id, patch] : g.graphs)
    {
        if (std::set<std::string> seen; ! patch_name.empty() && holds (g, id, patch_name, seen)) continue;   // it would contain itself
        const auto count = patch.nodes.size() == 1 ? TRANS ("A subgraph of this graph with %1 node.") : TRANS ("A subgraph of this graph with %1 nodes.");
        consider ({ "graph:" + id, id, filled (count, patch.nodes.size()).toStdString() }, {});
    }

    std::vector<PaletteEntry> found;
    for (const auto i : bestMatches (searched, query))
        found.push_back (entries[i]);
    return juce::String (query).trim().isEmpty() ? grouped (found, recent) : found;
}

std::vector<PaletteEntry> matching (const std::vector<PaletteEntry>& entries, const std::string& query)
{
    std::vector<Findable> searched;
    for (const auto& e : entries)
        searched.push_back ({ e.name, e.type, {}, e.summary });
    std::vector<PaletteEntry> found;
    for (const auto i : bestMatches (searched, query))
        found.push_back (entries[i]);
    return found;
}

PaletteSearch searchIn (std::vector<PaletteEntry> entries)
{
    return [all = std::move (entries)] (const std::string& query) { return matching (all, query); };
}

}   // namespace tactus::host
