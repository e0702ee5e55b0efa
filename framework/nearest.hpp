// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace tactus
{

/// The candidate a misspelt word was most likely meant to be, or "" if none is near.
template <typename Range>
std::string nearest (std::string_view word, const Range& candidates)
{
    std::string best;
    std::size_t best_distance = word.size() / 3 + 2;
    for (const std::string_view candidate : candidates)
    {
        std::vector<std::size_t> row (candidate.size() + 1);
        std::iota (row.begin(), row.end(), std::size_t { 0 });
        for (std::size_t i = 0; i < word.size(); ++i)
        {
            std::size_t diagonal = row[0];
            row[0] = i + 1;
            for (std::size_t j = 0; j < candidate.size(); ++j)
            {
                const auto change = diagonal + (word[i] != candidate[j]);
                diagonal = row[j + 1];
                row[j + 1] = std::min ({ change, row[j] + 1, row[j + 1] + 1 });
            }
        }
        if (row.back() < best_distance)
        {
            best_distance = row.back();
            best = candidate;
        }
    }
    return best;
}

/// " (did you mean 'mu'?)" or "".
template <typename Range>
std::string didYouMean (std::string_view word, const Range& candidates)
{
    const auto guess = nearest (word, candidates);
    return guess.empty() ? "" : " (did you mean '" + guess + "'?)";
}

}   // namespace tactus
