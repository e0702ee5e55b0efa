// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ratio.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tactus::bench
{

/// Two that are timed against each other: in each round both work right after one another, and who begins alternates. So what else the machine does meets both alike, and their ratio holds where their times do not.
struct Pair
{
    std::string name;   ///< "plan/hand": the first over the second
    std::function<void (int round)> first, second;
    double first_work = 1.0, second_work = 1.0;   ///< in a round: what its time is divided by
    int rounds = 1;

    std::vector<double> first_s {}, second_s {};   ///< of each round, once measured

    Ratio ratio() const;
};

/// Through Google Benchmark, which prints what it times unless it is told to be quiet.
void measure (std::vector<std::unique_ptr<Pair>>&, bool quiet);

}   // namespace tactus::bench
