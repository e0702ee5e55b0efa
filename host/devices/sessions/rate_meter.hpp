// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

namespace tactus::host
{

/// Estimates the rate of a counter that is read now and then, as the slope of the line of best fit through all readings. A
/// late reading, or one that missed the newest count, therefore has little effect. For one thread.
class RateMeter
{
public:
    struct Rate
    {
        double hz = 0.0;
        double error = 0.0;   ///< standard error in Hz, from the scatter about the line
    };

    void add (double time_s, std::uint64_t count) noexcept;
    void reset() noexcept { *this = {}; }

    /// Empty until there are three readings at different times.
    std::optional<Rate> rate() const noexcept;
    double span() const noexcept { return newest; }   ///< time from the first reading to the latest, in s

private:
    // Relative to the first reading: the means, and the sums of squares about them.
    std::uint64_t looks = 0, first_count = 0;
    double first_time = 0.0, newest = 0.0;
    double mean_t = 0.0, mean_n = 0.0, tt = 0.0, tn = 0.0, nn = 0.0;
};

}   // namespace tactus::host
