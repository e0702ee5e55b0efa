// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactus
{

/// Number of insertions, deletions, replacements and swaps of neighbours that turn one word into the other.
int editDistance (std::string_view, std::string_view);

/// The known word that was probably meant: one typo away, or two for words of more than four letters, where upper and lower case are the
/// same; else the only one that begins with the word, or that the word begins with but for its last letter ("params" for "parameters").
/// Empty if there is none, or if more than 1000 words are known, as the search would take too long.
std::string_view closestMatch (std::string_view word, std::span<const std::string_view> known);

/// "did you mean 'damping'?", or the whole list if no known word is close.
std::string suggestion (std::string_view word, std::span<const std::string> known);

/// " (did you mean 'mu'?)", or "".
std::string didYouMean (std::string_view word, const std::vector<std::string>& known);

}   // namespace tactus
