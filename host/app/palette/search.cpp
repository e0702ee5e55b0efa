// SPDX-License-Identifier: GPL-3.0-or-later
#include "search.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace tactus::host
{

namespace
{
std::string lower (std::string text)
{
    std::ranges::transform (text, text.begin(), [] (unsigned char c)
                            { return static_cast<char> (std::tolower (c)); });
    return text;
}

std::vector<std::string> wordsOf (const std::string& text)
{
    std::istringstream stream { lower (text) };
    std::vector<std::string> words;
    for (std::string w; stream >> w;)
        words.push_back (w);
    return words;
}

bool fitsSomewhere (const Face& face, const WireEnd& end)
{
    const auto any = [] (const std::vector<FacePort>& ports, auto check)
    {
        return std::ranges::any_of (ports, [&] (const FacePort& p)
                                    { return ! check (WireEnd { &p, p.quantity() }); });
    };
    if (end.port->role != Role::output) return any (face.outputs, [&] (const WireEnd& e)
                                                    { return whyNot (e, end); });
    return any (face.inputs, [&] (const WireEnd& e)
                { return whyNot (end, e); });
}

/// 0 for what begins with the query, 1 for what has it in its name, 2 for the rest.
int rank (const PaletteEntry& e, const std::string& query)
{
    const auto id = lower (e.type), name = lower (e.name);
    const auto last = id.substr (id.find_last_of (".:") + 1);
    if (last.starts_with (query) || id.starts_with (query) || name.starts_with (query)) return 0;
    return id.find (query) != std::string::npos || name.find (query) != std::string::npos ? 1 : 2;
}
}   // namespace

std::vector<PaletteEntry> searchPalette (const std::string& query, const graph::Graph& g, const Catalogue& catalogue, const std::vector<WireEnd>& fits)
{
    const auto words = wordsOf (query);
    std::vector<PaletteEntry> found;
    const auto consider = [&] (PaletteEntry entry, const Face& face)
    {
        std::string all = entry.type + ' ' + entry.name + ' ' + entry.summary;
        for (const auto* ports : { &face.inputs, &face.params, &face.outputs })
            for (const auto& p : *ports)
                all += ' ' + p.id + ' ' + std::string (p.unit.unit.symbol) + ' ' + std::string (name (p.quantity()));
        all = lower (std::move (all));
        const bool matches = std::ranges::all_of (words, [&] (const std::string& w)
                                                  { return all.find (w) != std::string::npos; });
        const bool fitting = std::ranges::all_of (fits, [&] (const WireEnd& end)
                                                  { return fitsSomewhere (face, end); });
        if (matches && fitting) found.push_back (std::move (entry));
    };
    const auto face = [&] (const std::string& type)
    {
        graph::Node node;
        node.type = type;
        return faceOf (g, g.root, node, catalogue);
    };
    for (const auto& type : catalogue)
        consider ({ std::string (type.info.id), std::string (type.info.name), std::string (type.info.summary) }, face (std::string (type.info.id)));
    for (const auto& [id, patch] : g.graphs)
        consider ({ "graph:" + id, id, "A subgraph of this graph, with " + std::to_string (patch.nodes.size()) + (patch.nodes.size() == 1 ? " node." : " nodes.") }, face ("graph:" + id));

    const auto whole = lower (query);
    if (! whole.empty()) std::ranges::stable_sort (found, {}, [&] (const PaletteEntry& e)
                                                   { return rank (e, whole); });
    return found;
}

std::vector<PaletteEntry> matching (const std::vector<PaletteEntry>& entries, const std::string& query)
{
    const auto words = wordsOf (query);
    auto found = entries;
    std::erase_if (found, [&] (const PaletteEntry& e)
                   { return ! std::ranges::all_of (words, [text = lower (e.type + ' ' + e.name + ' ' + e.summary)] (const std::string& w)
                                                   { return text.find (w) != std::string::npos; }); });
    return found;
}

}   // namespace tactus::host
