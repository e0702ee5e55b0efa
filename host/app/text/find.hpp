// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace tactus::host
{

/// The texts that can be searched in an entry of a list, such as a preset or a node type.
struct Findable
{
    std::string title;   ///< "Soft pad"
    std::string names;   ///< other names, such as an id
    std::string tags;    ///< words that describe the entry
    std::string text;    ///< what is written about it
};

/// Searches a list for all words of a query, ignoring case, and returns the numbers of what fits, the best first; equals keep their order. What has
/// the query as its title is best, then come titles that end with it (elasto-plastic friction is a friction), other titles and names, tags, synonyms
/// ("squeak" finds what squeals), and the text. A word counts only from its first letter: "rough" is not in "through". If nothing fits, mistyped and
/// shortened words ("gratng", "elpl") are tried, unless `may_guess` is false. Without words, all entries fit.
std::vector<std::size_t> bestMatches (const std::vector<Findable>&, const std::string& query, bool may_guess = true);

}   // namespace tactus::host
