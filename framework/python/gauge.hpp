// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace tactus
{
struct Tap;
}

namespace tactus::python
{

/// One number about a run, computed tick by tick, so that no records are kept.
class Gauge
{
public:
    enum class Kind
    {
        peak,      ///< largest magnitude of the port
        largest,   ///< largest value of a scalar
        least,     ///< smallest value of a scalar
        mean,      ///< of a scalar over time
        rms,       ///< of the magnitude, over time
        last,      ///< a scalar in the last tick
        work,      ///< work of a force on a position, in J; a force is held until the next tick
        given,     ///< the most that this work has been above 0 at any time, in J
        reach,     ///< when a scalar has passed a level for a while, in s since the start; not a number if it never has
        misfit     ///< rms of the difference of a scalar from a column of a recording
    };

    struct Options
    {
        Kind kind = Kind::peak;
        std::string port {}, position {};
        double level = 0.0, hold_s = 0.0;
        bool is_above = true;
        std::vector<double> reference {};   ///< one value for each tick
    };

    /// `names` are the columns of the run. Throws std::invalid_argument if they do not have what the gauge needs.
    Gauge (Options, std::span<const std::string> names);

    void add (std::span<const Tap> taps, double dt_s) noexcept;   ///< after each tick
    double result() const noexcept;

private:
    double magnitude (std::span<const Tap> taps) const noexcept;

    Options options;
    std::vector<std::size_t> columns, places;   // of the port, and of the position
    std::vector<double> force_before, position_before;
    std::size_t ticks = 0;
    double value, most = 0.0, since_s = -1.0;
};

}   // namespace tactus::python
