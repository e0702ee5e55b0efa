// SPDX-License-Identifier: GPL-3.0-or-later
#include "find.hpp"

#include <tactus/text/closest_match.hpp>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <sstream>
#include <string_view>
#include <utility>

namespace tactus::host
{

namespace
{
/// In lower case, with spaces for what joins words: "friction.elasto_plastic" becomes "friction elasto plastic".
std::string plain (std::string text)
{
    std::ranges::transform (text, text.begin(), [] (unsigned char c) {
        const bool joins = c == '.' || c == ':' || c == '_' || c == '-';
        return joins ? ' ' : static_cast<char> (std::tolower (c));
    });
    return text;
}

std::vector<std::string> wordsOf (const std::string& text)
{
    std::istringstream stream { text };
    std::vector<std::string> words;
    for (std::string w; stream >> w;)
        words.push_back (w);
    return words;
}

bool isLetter (char c) { return std::isalnum (static_cast<unsigned char> (c)) != 0 || static_cast<unsigned char> (c) >= 0x80; }

/// True if a word of the text begins like this.
bool begins (const std::string& text, std::string_view word)
{
    for (auto at = text.find (word); at != std::string::npos; at = text.find (word, at + 1))
        if (at == 0 || ! isLetter (text[at - 1])) return true;
    return false;
}

/// Words that people type, and what entries say instead, the closest first.
constexpr std::pair<std::string_view, std::string_view> synonyms[] {
    { "squeak", "squeal squeals stick" },
    { "sticky", "stick sticks adhesion honey" },
    { "bumpy", "bump bumps ridges relief pebble notch" },
    { "buzz", "vibration hum hums rattle" },
    { "viscous", "liquid honey oil" },
    { "subgraph", "graph subgraphs" },
    { "detent", "notch notched snap" },
    { "click", "key detent button" },
    { "button", "key click" },
    { "fabric", "cloth weave" },
    { "rough", "abrasive grain" },
    { "wobble", "lfo vibration" },
    { "pulse", "clip heartbeat shock" },
    { "slippery", "glass viscous" },
    { "squishy", "gel foam rubber tissue" },
    { "jelly", "gel" },
    { "water", "liquid" },
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

constexpr int of_tag = 10, begins_name = 20, begins_tag = 30, of_synonym = 40, in_text = 50, first_guess = 60, second_guess = 70, no_match = 80;

/// The words of an entry.
struct Fields
{
    std::string title, names, tags, text;
    std::vector<std::string> name_words, tag_words;

    explicit Fields (const Findable& e)
        : title (plain (e.title)), names (plain (e.title + ' ' + e.names)), tags (plain (e.tags)), text (plain (e.text)),
          name_words (wordsOf (names)), tag_words (wordsOf (tags))
    {
    }

    bool says (std::string_view word) const { return begins (names, word) || begins (tags, word) || begins (text, word); }

    /// The rank of a word of a query: 0 fits best. From first_guess on, it may be mistyped or shortened.
    int rankOf (const std::string& word) const
    {
        if (std::ranges::count (name_words, word) > 0) return 0;
        if (std::ranges::count (tag_words, word) > 0) return of_tag;
        if (begins (names, word)) return begins_name;
        if (begins (tags, word)) return begins_tag;
        for (const auto& [typed, meant] : synonyms)
            if (word.size() > 3 && typed.starts_with (word))
                for (int further = of_synonym; const auto& m : wordsOf (std::string (meant)))
                {
                    if (says (m)) return further;
                    ++further;
                }
        if (begins (text, word)) return in_text;
        const auto isTypo = [&] (const std::string& w) { return word.size() > 3 && editDistance (word, w) <= (word.size() > 5 ? 2 : 1); };
        if (std::ranges::any_of (name_words, isTypo) || std::ranges::any_of (tag_words, isTypo)) return first_guess;
        const auto isShort = [&] (const std::string& w) { return word.size() > 2 && abbreviates (word, w); };
        return std::ranges::any_of (name_words, isShort) || (word.size() > 2 && abbreviates (word, title)) ? second_guess : no_match;
    }
};

constexpr int per_rank = 100, title_is_query = -4, title_ends = -3, title_begins = -2, in_order = -1;

/// Less is better. The worst word counts first; per_rank * no_match if one does not fit.
int scoreOf (const Findable& entry, const std::vector<std::string>& words, const std::string& query)
{
    const Fields fields (entry);
    if (fields.title == query) return title_is_query;
    int worst = 0, sum = 0;
    for (const auto& word : words)
    {
        const int rank = fields.rankOf (word);
        worst = std::max (worst, rank);
        sum += rank;
    }
    if (worst <= of_tag && fields.title.ends_with (' ' + query)) return title_ends;   // elasto-plastic friction is the kind that was asked for
    if (worst <= of_tag && fields.title.starts_with (query)) return title_begins;
    if (worst == 0 && words.size() > 1 && (' ' + fields.names + ' ').find (' ' + query + ' ') != std::string::npos) return in_order;   // "lfo.amplitude"
    return worst < no_match ? worst * per_rank + sum : no_match * per_rank;
}
}   // namespace

std::vector<std::size_t> bestMatches (const std::vector<Findable>& entries, const std::string& query, bool may_guess)
{
    const auto words = wordsOf (plain (query));
    std::vector<std::size_t> found (entries.size());
    std::iota (found.begin(), found.end(), std::size_t {});
    if (words.empty()) return found;
    std::string whole;
    for (const auto& w : words)
        whole += (whole.empty() ? "" : " ") + w;
    std::vector<int> scores;
    for (const auto& e : entries)
        scores.push_back (scoreOf (e, words, whole));
    const auto scoreAt = [&] (std::size_t i) { return scores[i]; };
    std::ranges::stable_sort (found, {}, scoreAt);
    const bool is_guess = may_guess && ! found.empty() && scoreAt (found.front()) >= first_guess * per_rank;
    std::erase_if (found, [&] (std::size_t i) { return scoreAt (i) >= (is_guess ? no_match : first_guess) * per_rank; });
    return found;
}

}   // namespace tactus::host
