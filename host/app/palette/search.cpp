// SPDX-License-Identifier: GPL-3.0-or-later
#include "search.hpp"

#include <host/app/text/filled.hpp>

#include <tactus/text/closest_match.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <sstream>
#include <string_view>
#include <utility>

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

/// What can be searched in an entry, in lower case.
struct SearchFields
{
    std::vector<std::string> names;   ///< the parts of its id and the words of its name
    std::vector<std::string> keywords;
    std::string text;   ///< summary, ports, units, quantities

    SearchFields (const PaletteEntry& e, std::string_view all_keywords, const std::string& all_text)
        : keywords (wordsOf (std::string (all_keywords))), text (lower (all_text))
    {
        auto id = e.type;
        std::ranges::replace_if (
            id, [] (char c) { return c == '.' || c == ':' || c == '_'; }, ' ');
        names = wordsOf (id + ' ' + e.name);
        names.push_back (lower (e.type));
    }
};

/// True if the letters of the word occur in the text in this order, and it begins with the first of them: "elpl" in "elasto plastic".
bool abbreviates (const std::string& word, const std::string& text)
{
    std::size_t at = 0;
    for (const char c : text)
        if (at < word.size() && c == word[at])
            ++at;
        else if (at == 0)
            return false;
    return at == word.size();
}

constexpr int first_guess = 4, no_match = 6;

/// How well a word of a query matches an entry: 0 is best. From first_guess on, the word may be mistyped or shortened.
int rankOf (const std::string& word, const SearchFields& s)
{
    const auto starts = [&] (const std::string& w) { return w.starts_with (word); };
    const auto contains = [&] (const std::string& w) { return w.find (word) != std::string::npos; };
    const auto isTypo = [&] (const std::string& w) { return word.size() > 3 && editDistance (word, w) <= (word.size() > 5 ? 2 : 1); };
    if (std::ranges::any_of (s.names, starts)) return 0;
    if (std::ranges::any_of (s.keywords, starts)) return 1;
    if (std::ranges::any_of (s.names, contains)) return 2;
    if (contains (s.text) || std::ranges::any_of (s.keywords, contains)) return 3;
    if (std::ranges::any_of (s.names, isTypo) || std::ranges::any_of (s.keywords, isTypo)) return first_guess;
    const auto isShort = [&] (const std::string& w) { return word.size() > 2 && abbreviates (word, w); };
    return std::ranges::any_of (s.names, isShort) ? first_guess + 1 : no_match;
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
    return type.origin.empty() ? summary : summary + " " + filled (TRANS ("Plugin %1."), std::filesystem::path (type.origin).stem().string()).toStdString();
}

std::string familyOf (const std::string& type) { return type.substr (0, type.find_first_of (".:")); }

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
                                         const std::vector<std::string>& recent)
{
    const auto words = wordsOf (query);
    std::vector<std::pair<int, PaletteEntry>> found;
    const auto consider = [&] (const PaletteEntry& entry, std::string_view keywords) {
        graph::Node node;
        node.type = entry.type;
        const auto face = faceOf (g, g.root, node, catalogue);
        if (! std::ranges::all_of (fits, [&] (const WireEnd& end) { return fitsSomewhere (face, end); })) return;
        std::string text = entry.summary;
        for (const auto* ports : { &face.inputs, &face.params, &face.outputs })
            for (const auto& p : *ports)
                text += ' ' + p.id + ' ' + std::string (p.unit.unit.symbol) + ' ' + std::string (name (p.quantity()));
        const SearchFields searched { entry, keywords, text };
        int worst = 0, sum = 0;
        for (const auto& word : words)
        {
            const int rank = rankOf (word, searched);
            worst = std::max (worst, rank);
            sum += rank;
        }
        if (worst < no_match) found.emplace_back (worst * 100 + sum, entry);
    };
    for (const auto& type : catalogue)
        consider ({ std::string (type.info.id), std::string (type.info.name), summaryOf (type) }, type.info.keywords);
    for (const auto& [id, patch] : g.graphs)
    {
        const auto count = patch.nodes.size() == 1 ? TRANS ("A subgraph of this graph with %1 node.") : TRANS ("A subgraph of this graph with %1 nodes.");
        consider ({ "graph:" + id, id, filled (count, patch.nodes.size()).toStdString() }, {});
    }

    std::ranges::stable_sort (found, {}, [] (const auto& f) { return f.first; });
    const auto isGuess = [] (const auto& f) { return f.first >= first_guess * 100; };
    if (! found.empty() && ! isGuess (found.front())) std::erase_if (found, isGuess);
    std::vector<PaletteEntry> entries;
    for (auto& f : found)
        entries.push_back (std::move (f.second));
    return words.empty() ? grouped (entries, recent) : entries;
}

std::vector<PaletteEntry> matching (const std::vector<PaletteEntry>& entries, const std::string& query)
{
    const auto words = wordsOf (query);
    auto found = entries;
    std::erase_if (found, [&] (const PaletteEntry& e) { return ! containsAll (e.type + ' ' + e.name + ' ' + e.summary, words); });
    return found;
}

}   // namespace tactus::host
