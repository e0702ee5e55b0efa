// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/check/measure.hpp>
#include <tactus/run/device/device_numbers.hpp>

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tactus::check
{

/// A contact that is not passive, along the force of one node or of all together.
struct Contact
{
    std::string node;                                         ///< its path, if there are several; "" for all together
    Stretch::Softer softer = Stretch::Softer::unknown;        ///< of a friction
    double stiffness = 0.0;                                   ///< sigma, in N/m
    double damping = 0.0;                                     ///< b, in N s/m
    double limit = 0.0;                                       ///< what the device can dissipate, in N s/m
    std::function<double (double, double, double)> load {};   ///< what it has to dissipate, in N s/m, by sigma, b and the period in s

    double share (double period_s) const { return load (stiffness, damping, period_s) / std::max (limit, 1e-12); }
};

/// The dampers between hand and motor.
struct Dampers
{
    double claimed = 0.0;         ///< what all nodes claim to damp, in N s/m
    bool are_predicted = false;   ///< a hold.predictive makes more b, from the force

    /// True if a virtual damping is much more than what is claimed, as behind a hold.predictive, a filter or a ceiling.
    bool leaveUnclaimed (double damping) const noexcept { return damping > 1.5 * claimed; }
};

/// The remedy for a b that is much larger than what the dampers of the graph claim.
inline constexpr const char* smaller_b = "a smaller b (that no damper of the graph claims and a ceiling or a filter or a hold.predictive "
                                         "may cause)";

/// The changes that make all of these contacts passive, in words. Each contact has a part, and any of the ways in it suffices; a rate or a device is for all.
/// `load`: what the device would have to dissipate, in N s/m. [any thread]
std::string passiveRemedy (std::span<const Contact>, double load, const Dampers&, const DeviceNumbers&, double period_s);

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
