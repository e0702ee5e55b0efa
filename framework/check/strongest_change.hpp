// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/run/device/device_numbers.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tactus::check
{

/// A change of a contact or its device, and how many times the response could then be as large before the loop swings (roomToGrow()).
struct Change
{
    std::string what;   ///< such as "twice the rate"
    double room = 0.0;
};

/// Tries some changes on the sampled loop of a contact, one at a time, and returns the one that leaves the most room: half the stiffness, more or less
/// virtual damping, twice the rate, a hold.predictive, no delay, and a device with twice the damping. `response` is as for loopRadius(). Empty if the
/// loop is not known, or if its response takes more than a few ticks, which would take long. The rate is left out if the device is not that fast.
/// `drags`: the force is that of friction, whose slips a hold.predictive cannot foresee: then it is left out. `others` are the responses along other
/// directions: a change of the contact leaves them as they are, one of the rate or the device does not, and all loops have to rest. [any thread]
std::optional<Change> strongestChange (std::span<const double> response, const DeviceNumbers&, double period_s, bool drags = false,
                                       std::span<const std::vector<double>> others = {});

}   // namespace tactus::check
