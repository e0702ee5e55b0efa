// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ratio.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tactus::bench
{

/// Two functions timed against each other. In each round one runs right after the other, and they take turns going first. Other
/// load on the machine then affects both equally, so their ratio is reliable even if their times are not.
struct Pair
{
    std::string name;   ///< such as "plan/hand": the name of the first, a slash, and the name of the second
    std::function<void (int round)> first, second;
    double first_work = 1.0, second_work = 1.0;   ///< work done in one round; the time is divided by it
    int rounds = 1;
    std::function<void (int round)> prepare {};   ///< runs before the first in each round, untimed

    std::vector<double> first_s {}, second_s {};   ///< time of each round in s, filled by measure()

    Ratio ratio() const;
};

/// Runs the pairs through Google Benchmark, which prints the times unless `quiet` is set.
void measure (std::vector<std::unique_ptr<Pair>>&, bool quiet);

}   // namespace tactus::bench
