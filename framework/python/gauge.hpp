// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
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
    struct Kind;   ///< what is taken of each tick, and what becomes of it

    struct Options
    {
        std::string kind {}, port {}, position {};   ///< kind: as in tactus.lab.Measure
        double level = 0.0, hold_s = 0.0;
        bool is_above = true;
        std::vector<double> reference {};   ///< one value for each tick
    };

    /// `names` are the columns of the run. Throws std::invalid_argument if they do not have what the gauge needs.
    Gauge (Options, std::span<const std::string> names);

    void add (std::span<const Tap> taps, double dt_s) noexcept;   ///< after each tick
    double result() const noexcept;

private:
    double work (std::span<const Tap> taps) noexcept;
    double reached (double now, double dt_s) noexcept;

    Options options;
    const Kind* kind;
    std::vector<std::size_t> columns, places;               // of the port, and of the position
    std::vector<double> force_before, position_before {};   // empty before the first tick
    std::size_t ticks = 0;
    double value = 0.0, work_so_far = 0.0, since_s = -1.0;
};

}   // namespace tactus::python
