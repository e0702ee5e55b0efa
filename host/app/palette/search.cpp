// SPDX-License-Identifier: GPL-3.0-or-later
#include "search.hpp"

#include <host/app/model/fragment.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <string_view>

namespace tactus::host
{

namespace
{
/// The ports of a new node at which a wire from this end may arrive, or begin.
const std::vector<FacePort>& portsFor (const Face& face, const WireEnd& end) { return end.port->role == Role::output ? face.inputs : face.outputs; }

bool fitsAt (const FacePort& own, const WireEnd& end)
{
    const WireEnd here { &own, own.quantity() };
    return (own.role == Role::output ? checkWire (here, end) : checkWire (end, here)).has_value();
}

/// True if a port is not only possible at this end of a wire, but what the end asks for: a position for a position, a resistance for a load.
bool isMadeFor (const FacePort& own, const WireEnd& end)
{
    const auto &in = own.role == Role::output ? *end.port : own, &out = own.role == Role::output ? own : *end.port;
    const bool is_load = in.id == "normal_force" && out.id == "resistance";
    return (in.id == out.id || is_load) && own.quantity() == end.quantity && end.quantity != Quantity::any && fitsAt (own, end);
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

/// The entries in groups: the best, those that were chosen recently, then all by family. Each group begins with its title.
std::vector<PaletteEntry> grouped (const std::vector<PaletteEntry>& entries, const std::vector<std::string>& best, const std::vector<std::string>& recent)
{
    std::vector<PaletteEntry> all;
    const auto add = [&] (const juce::String& title, const std::vector<std::string>& types) {
        const auto begin = static_cast<std::ptrdiff_t> (all.size());
        for (const auto& type : types)
            if (const auto at = std::ranges::find (entries, type, &PaletteEntry::type); at != entries.end()) all.push_back (*at);
        if (std::ssize (all) > begin) all.insert (all.begin() + begin, PaletteEntry { {}, title.toStdString(), {} });
    };
    const auto isBest = [&] (const std::string& type) { return std::ranges::find (best, type) != best.end(); };
    auto others = recent;
    std::erase_if (others, isBest);
    add (TRANS ("Fits best"), best);
    add (TRANS ("Recent"), others);
    std::string family;
    for (const auto& e : entries)
    {
        if (isBest (e.type)) continue;
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

bool PaletteType::fits (const WireEnd& end) const
{
    return std::ranges::any_of (portsFor (face, end), [&] (const FacePort& p) { return fitsAt (p, end); });
}

std::vector<PaletteType> paletteTypes (const graph::Graph& g, const Catalogue& catalogue, const std::string& patch_name)
{
    std::vector<PaletteType> types;
    const auto add = [&] (PaletteEntry entry, std::string_view keywords) {
        graph::Node node;
        node.type = entry.type;
        auto face = faceOf (g, g.root, node, catalogue);
        std::string text = entry.summary;
        for (const auto* ports : { &face.inputs, &face.params, &face.outputs })
            for (const auto& p : *ports)
                text += ' ' + p.id + ' ' + std::string (p.unit.unit.symbol) + ' ' + std::string (name (p.quantity()));
        Findable searched { entry.name, entry.type + ' ' + usualName (entry.type), std::string (keywords), std::move (text) };
        types.push_back ({ std::move (entry), std::move (searched), std::move (face) });
    };
    for (const auto& type : catalogue)
        add ({ std::string (type.info.id), std::string (type.info.name), summaryOf (type) }, type.info.keywords);
    for (const auto& [id, patch] : g.graphs)
    {
        if (std::set<std::string> seen; ! patch_name.empty() && holds (g, id, patch_name, seen)) continue;   // it would contain itself
        const auto count = patch.nodes.size() == 1 ? TRANS ("A subgraph of this graph with %1 node.") : TRANS ("A subgraph of this graph with %1 nodes.");
        add ({ "graph:" + id, id, filled (count, patch.nodes.size()).toStdString() }, {});
    }
    return types;
}

std::vector<PaletteEntry> searchPalette (const std::string& query, const graph::Graph& g, const Catalogue& catalogue, const std::vector<WireEnd>& fits,
                                         const std::vector<std::string>& recent, const std::string& patch_name)
{
    constexpr std::size_t few = 8;   // else, they are no help
    std::vector<PaletteEntry> entries;
    std::vector<Findable> searched;
    std::vector<std::string> best;
    for (auto& type : paletteTypes (g, catalogue, patch_name))
    {
        if (! std::ranges::all_of (fits, [&] (const WireEnd& end) { return type.fits (end); })) continue;
        if (fits.size() == 1 && std::ranges::any_of (portsFor (type.face, fits[0]), [&] (const FacePort& p) { return isMadeFor (p, fits[0]); }))
            best.push_back (type.entry.type);
        searched.push_back (std::move (type.searched));
        entries.push_back (std::move (type.entry));
    }
    if (best.size() > few) best.clear();

    std::vector<PaletteEntry> found;
    for (const auto i : bestMatches (searched, query))
        found.push_back (entries[i]);
    return juce::String (query).trim().isEmpty() ? grouped (found, best, recent) : found;
}

std::vector<PaletteEntry> matching (const std::vector<PaletteEntry>& entries, const std::string& query)
{
    std::vector<Findable> searched;
    for (const auto& e : entries)
        searched.push_back ({ e.name.empty() ? e.type : e.name, e.type, {}, e.summary });
    std::vector<PaletteEntry> found;
    for (const auto i : bestMatches (searched, query))
        found.push_back (entries[i]);
    return found;
}

static constexpr std::string_view dragged_node = "node ";   // before its type

std::string asDragged (const PaletteEntry& e) { return std::string (dragged_node) + e.type; }

std::string typeOfDragged (const std::string& dragged) { return dragged.starts_with (dragged_node) ? dragged.substr (dragged_node.size()) : std::string(); }

PaletteSearch searchIn (std::vector<PaletteEntry> entries)
{
    return [all = std::move (entries)] (const std::string& query) { return matching (all, query); };
}

}   // namespace tactus::host
