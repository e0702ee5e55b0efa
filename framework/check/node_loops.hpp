// SPDX-License-Identifier: MIT
#pragma once

#include "measure.hpp"

#include <tactus/run/device/device_numbers.hpp>

#include <span>
#include <vector>

namespace tactus::check
{

/// The sampled loop along the direction in which a node's own force is steepest.
struct NodeLoop
{
    std::size_t node = 0;
    std::vector<double> response {};   ///< of the whole graph along this direction, as for loopRadius()
    double may_grow = 0.0;             ///< roomToGrow()
    double passive_up_to = 0.0;        ///< how many times the response could be as large and still be passive
};

/// The loops at a place, the weakest first. A node whose direction another one has, such as a mixer, is left out: the steeper one stands for both, or the
/// first one. `response` is that of the role in its three axes, at this place. Empty if mass or damping of the device are not known. [any thread]
std::vector<NodeLoop> nodeLoops (const Slope&, std::span<const Jacobian> response, const DeviceNumbers&, double period_s);

}   // namespace tactus::check
