// SPDX-License-Identifier: GPL-3.0-or-later
#include "search.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <sstream>

namespace tactus::host
{

namespace
{
std::string lower (std::string text)
{
    std::ranges::transform (text, text.begin(), [] (unsigned char c) { return static_cast<char> (std::tolower (c)); });
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

bool containsAll (const std::string& text, const std::vector<std::string>& words)
{
    return std::ranges::all_of (words, [text = lower (text)] (const std::string& w) { return text.find (w) != std::string::npos; });
}

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
    return type.origin.empty() ? summary : summary + " Plugin " + std::filesystem::path (type.origin).stem().string() + ".";
}

/// 0 if the id or name starts with the query, 1 if it contains it, else 2.
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
    const auto consider = [&] (PaletteEntry entry, const Face& face) {
        std::string all = entry.type + ' ' + entry.name + ' ' + entry.summary;
        for (const auto* ports : { &face.inputs, &face.params, &face.outputs })
            for (const auto& p : *ports)
                all += ' ' + p.id + ' ' + std::string (p.unit.unit.symbol) + ' ' + std::string (name (p.quantity()));
        const bool fitting = std::ranges::all_of (fits, [&] (const WireEnd& end) { return fitsSomewhere (face, end); });
        if (fitting && containsAll (all, words)) found.push_back (std::move (entry));
    };
    const auto face = [&] (const std::string& type) {
        graph::Node node;
        node.type = type;
        return faceOf (g, g.root, node, catalogue);
    };
    for (const auto& type : catalogue)
        consider ({ std::string (type.info.id), std::string (type.info.name), summaryOf (type) }, face (std::string (type.info.id)));
    for (const auto& [id, patch] : g.graphs)
    {
        const auto count = std::to_string (patch.nodes.size()) + (patch.nodes.size() == 1 ? " node." : " nodes.");
        consider ({ "graph:" + id, id, "A subgraph of this graph with " + count }, face ("graph:" + id));
    }

    const auto whole = lower (query);
    if (! whole.empty()) std::ranges::stable_sort (found, {}, [&] (const PaletteEntry& e) { return rank (e, whole); });
    return found;
}

std::vector<PaletteEntry> matching (const std::vector<PaletteEntry>& entries, const std::string& query)
{
    const auto words = wordsOf (query);
    auto found = entries;
    std::erase_if (found, [&] (const PaletteEntry& e) { return ! containsAll (e.type + ' ' + e.name + ' ' + e.summary, words); });
    return found;
}

}   // namespace tactus::host
