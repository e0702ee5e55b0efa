// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "variant.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tactus::bench
{

/// Two ways to compute the same thing. The second is the yardstick for the first.
struct Contest
{
    using Make = std::function<std::unique_ptr<Variant>()>;
    using Row = std::vector<double>;   ///< the inputs of one tick

    std::string key;             ///< as in the JSON: "juce/plan"
    std::string first, second;   ///< names that are shown to the user
    std::string about;           ///< what both compute
    Make make_first, make_second;
    std::vector<Row> inputs;
    double tolerance = 0.0;   ///< largest allowed difference between outputs; 0 means bit for bit
};

/// The reference graph, as it is and with light kernels, dry wood, the tree and the chain (docs/bench.md). [message thread]
std::vector<Contest> contests();

struct Agreement
{
    bool agree = false;
    double worst = 0.0;       ///< largest difference found
    std::size_t values = 0;   ///< number of values that were compared
};

Agreement compare (const Contest&);

}   // namespace tactus::bench
