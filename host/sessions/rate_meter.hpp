// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

namespace tactus::host
{

/// How many a second, from looks at a counter now and then: the slope of the straight line that fits all looks best, so that
/// a late look, or one that missed the newest count, moves it little. For one thread.
class RateMeter
{
public:
    struct Rate
    {
        double hz = 0.0;
        double error = 0.0;   ///< Hz, standard error of it, as far as the looks scatter about the line
    };

    void look (double time_s, std::uint64_t count) noexcept;
    void reset() noexcept { *this = {}; }

    /// Nothing before there were three looks at different times.
    std::optional<Rate> rate() const noexcept;
    double span() const noexcept { return newest; }   ///< s, from the first look to the latest

private:
    // Of what was since the first look: means, and sums of squares about them.
    std::uint64_t looks = 0, first_count = 0;
    double first_time = 0.0, newest = 0.0;
    double mean_t = 0.0, mean_n = 0.0, tt = 0.0, tn = 0.0, nn = 0.0;
};

}   // namespace tactus::host
