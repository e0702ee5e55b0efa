// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/run/device/device_numbers.hpp>

#include <optional>
#include <span>

namespace tactus::check
{

/// A hand that holds the tool: a mass on a spring and a damper.
struct HeldHand
{
    double mass = 0.0;        ///< kg
    double damping = 0.0;     ///< N s/m
    double stiffness = 0.0;   ///< N/m
};

/// No hand, and the fingertips of Hajian & Howe (1997, "Identification of the mechanical impedance at the human finger tip"): about 6 g,
/// 2 to 4 N s/m and 200 to 800 N/m.
std::span<const HeldHand> usualHands() noexcept;

/// The loop of a device, a hand and a graph that was linearised at one place: exact between the ticks, under a force that is held.
///
/// `response` is the force of the graph along a direction after a step of the tool along it, tick by tick, in N/m; positive numbers pull back,
/// and the last one lasts. The device has its mass, its damping, its delay and, if it is known and finite, its first mode: the sensor and the
/// motor are then on one side of the structure, and the hand is on the other one. Quanta and Coulomb friction are left out.
///
/// Returns the largest magnitude of an eigenvalue: the loop comes to rest if it is below 1. Empty if the mass or the damping is not known, or
/// if the response needs more than 64 ticks to settle. [any thread]
std::optional<double> loopRadius (std::span<const double> response, const DeviceNumbers&, double period_s, const HeldHand&);

/// The largest radius of the loop, without a hand and with the usual ones. Empty if loopRadius() is. [any thread]
std::optional<double> largestRadius (std::span<const double> response, const DeviceNumbers&, double period_s);

/// The largest radius of a loop that rests. A tool that nothing holds has an eigenvalue of 1.
inline constexpr double at_rest = 1.0 + 1e-7;

}   // namespace tactus::check
