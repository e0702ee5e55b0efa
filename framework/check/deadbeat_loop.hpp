// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/run/device/device_numbers.hpp>

#include <cstddef>
#include <optional>

namespace tactus::check
{

/// The device and the wall as a hold.deadbeat assumes them to be.
struct DeadbeatPlan
{
    double mass = 0.0;        ///< kg, > 0
    double damping = 0.0;     ///< N s/m
    double stiffness = 0.0;   ///< of the wall, in N/m
    std::size_t delay = 0;    ///< ticks
};

/// The loop of a hold.deadbeat and a device whose tool stays in the wall, without a hand: exact. `delay_ticks` is that from the sensor to the motor.
///
/// In contact, all that the node does is linear: it estimates the speed and the hand's force from the last three positions, and plans the forces of two
/// ticks. So two ticks together are one linear step of the state of node and device. The first mode of the device counts, its quanta and its Coulomb
/// friction do not.
///
/// Returns the largest magnitude of an eigenvalue, per tick: the tool comes to rest if it is below 1. Empty if the mass or the damping of the device is
/// not known. [any thread]
std::optional<double> deadbeatRadius (const DeadbeatPlan&, const DeviceNumbers&, std::size_t delay_ticks, double period_s);

}   // namespace tactus::check
