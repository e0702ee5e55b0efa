// SPDX-License-Identifier: MIT
#include "closest_match.hpp"
#include "list_text.hpp"

#include "quote.hpp"

#include <algorithm>
#include <vector>

namespace tactus
{
namespace
{
std::string inLowerCase (std::string_view word)
{
    std::string lower (word);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char> (c - 'A' + 'a');
    return lower;
}

/// The only candidate that begins with the word, or that has all but its last letter in common with a longer word: "rate_hz" for "rate",
/// "params" for "parameters". Empty if there are several.
std::string_view onlyContinuation (std::string_view word, std::span<const std::string_view> known)
{
    constexpr std::size_t shortest = 3, shortest_stem = 5;
    std::string_view only;
    for (const auto candidate : known)
    {
        const auto common = static_cast<std::size_t> (std::ranges::mismatch (word, candidate).in1 - word.begin());
        const bool is_longer = word.size() > candidate.size() && common >= shortest_stem && common + 1 >= candidate.size()
                               && word.find_first_not_of ("abcdefghijklmnopqrstuvwxyz") == word.npos;
        if (! is_longer && (word.size() < shortest || common < word.size() || word == candidate)) continue;
        if (! only.empty() && only != candidate) return {};
        only = candidate;
    }
    return only;
}
}   // namespace

int editDistance (std::string_view a, std::string_view b)
{
    // Row i holds the distances from the first i letters of a to every prefix of b. A swap looks two rows back.
    std::vector<int> before_last (b.size() + 1), last (b.size() + 1), row (b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = static_cast<int> (j);
    for (std::size_t i = 1; i <= a.size(); ++i)
    {
        before_last.swap (last);
        last.swap (row);
        row[0] = static_cast<int> (i);
        for (std::size_t j = 1; j <= b.size(); ++j)
        {
            row[j] = std::min ({ last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1) });
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min (row[j], before_last[j - 2] + 1);
        }
    }
    return row[b.size()];
}

std::string_view closestMatch (std::string_view word, std::span<const std::string_view> known)
{
    constexpr std::size_t longest = 30;   // no known word is longer than this, so a key of a megabyte need not be compared
    constexpr std::size_t most = 1000;    // a hostile file asks about thousands of names among tens of thousands
    if (word.size() > longest || known.size() > most) return {};
    std::string_view best;
    int nearest = 3;
    const auto lower = inLowerCase (word);
    for (const auto candidate : known)
    {
        const int tolerance = std::min (word.size(), candidate.size()) > 4 ? 2 : 1;
        if (const int d = editDistance (lower, inLowerCase (candidate)); d <= tolerance && d < nearest && d < static_cast<int> (candidate.size()))
        {
            best = candidate;
            nearest = d;
        }
    }
    return best.empty() ? onlyContinuation (lower, known) : best;
}

std::string suggestion (std::string_view word, std::span<const std::string> known)
{
    const auto meant = closestMatch (word, std::vector<std::string_view> (known.begin(), known.end()));
    if (! meant.empty()) return "did you mean " + quote (meant) + "?";
    std::string all;
    for (const auto& name : known)
        addToList (all, name);
    return "the known names are: " + all;
}

std::string didYouMean (std::string_view word, const std::vector<std::string>& known)
{
    const auto meant = closestMatch (word, std::vector<std::string_view> (known.begin(), known.end()));
    return meant.empty() ? "" : " (did you mean '" + std::string (meant) + "'?)";
}

}   // namespace tactus
