// SPDX-License-Identifier: MIT
#pragma once

#include "instance.hpp"

#include <framework/journal.hpp>

#include <span>

namespace tactus::plan
{

/// Moves the knobs of a plan's nodes towards their targets, in a straight line within ramp_s. A new target while one is
/// on its way is headed for from where it stands. Choices, and nodes that have not ticked yet, go there at once.
class Ramps
{
public:
    static constexpr double ramp_s = 0.020;

    void prepare (std::span<const Instance>, double rate_hz);   // [main thread]

    void look (Journal* = nullptr) noexcept;   ///< heads for all targets that were set since it last looked, and hands on hits   [tick thread]
    void goOn() noexcept;                      ///< with what is on its way from the plan before               [tick thread]
    void step() noexcept;                      ///< one tick further                                           [tick thread]
    void startAll() noexcept;                  ///< all nodes have ticked now                                  [tick thread]

    void head (std::size_t instance, std::size_t knob, double to, bool at_once = false) noexcept;   // [tick thread]

private:
    static void strike (std::size_t instance, const Instance&, Journal*) noexcept;

    std::span<const Instance> instances;
    std::vector<std::size_t> moving;   // instances; with room for all
    int ticks = 1;                     // of a ramp
};

}   // namespace tactus::plan
