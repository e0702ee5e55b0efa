// SPDX-License-Identifier: MIT
#pragma once

#include "instance.hpp"

#include "journal.hpp"

#include <span>

namespace tactus::plan
{

/// Moves the knobs of a plan's nodes to their targets, in a straight line that takes ramp_s. A new target during a ramp starts
/// a new ramp from the current value. Choices, and nodes that have not ticked yet, change immediately.
class Ramps
{
public:
    static constexpr double ramp_s = 0.020;

    void prepare (std::span<const Instance>, double rate_hz);   // [main thread]

    void look (Journal* = nullptr) noexcept;   ///< starts ramps to all targets set since the last call, and passes hits on   [tick thread]
    void goOn() noexcept;                      ///< continues the ramps of the previous plan                                     [tick thread]
    void step() noexcept;                      ///< advances all ramps by one tick                                            [tick thread]
    void startAll() noexcept;                  ///< from now on, new targets of all nodes start ramps                          [tick thread]

    void head (std::size_t instance, std::size_t knob, double to, bool at_once = false) noexcept;   // [tick thread]

private:
    static void strike (std::size_t instance, const Instance&, Journal*) noexcept;

    std::span<const Instance> instances;
    std::vector<std::size_t> moving;   // numbers of the instances with a ramp; has room for all instances
    int ticks = 1;                     // length of a ramp, in ticks
};

}   // namespace tactus::plan
