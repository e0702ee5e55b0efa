// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "variant.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tactus::bench
{

/// Two ways to work out the same thing, of which the second is what the first is measured against.
struct Contest
{
    using Make = std::function<std::unique_ptr<Variant>()>;
    using Row = std::vector<double>;   ///< what comes in on a tick

    std::string key;             ///< as in the JSON: "juce/plan"
    std::string first, second;   ///< in words
    std::string about;           ///< what is worked out
    Make make_first, make_second;
    std::vector<Row> inputs;
    double tolerance = 0.0;   ///< largest difference between outputs; 0: none, bit for bit
};

/// The reference graph, the tree and the chain (docs/bench.md). [message thread]
std::vector<Contest> contests();

struct Agreement
{
    bool agree = false;
    double worst = 0.0;       ///< largest difference
    std::size_t values = 0;   ///< how many were compared
};

Agreement compare (const Contest&);

}   // namespace tactus::bench
