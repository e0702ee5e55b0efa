// SPDX-License-Identifier: MIT
#pragma once

#include "measure.hpp"

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

    bool operator== (const HeldHand&) const = default;
};

/// No hand; the corners of the range of fingertips of Hajian & Howe (1997, "Identification of the mechanical impedance at the human finger tip"): about
/// 6 g, 2 to 4 N s/m and 200 to 800 N/m; and an arm that holds a handle, of van Beek, Bergmann Tiest, Mugge & Kappers (2015, "Haptic perception of force
/// magnitude and its relation to postural arm dynamics in 3D", figure 3): 0.554 kg, 6.45 N s/m and 135 N/m.
std::span<const HeldHand> usualHands() noexcept;

/// The motion of a device and a hand in a tick, as a matrix. Its rows are the states after the tick, the position and the speed of the sensor first;
/// its columns are the states before the tick and, last, a force that is held. The mass and the damping of the device must be known. [any thread]
Jacobian heldMotion (const DeviceNumbers&, double period_s, const HeldHand&);

/// The loop of a device, a hand and a graph that was linearised at one place: exact between the ticks, under a force that is held.
///
/// `response` is the force of the graph along a direction after a step of the tool along it, tick by tick, in N/m; positive numbers pull back,
/// and the last one lasts. The device has its mass, its damping, its delay and, if it is known and finite, its first mode: the sensor and the
/// motor are then on one side of the structure, and the hand is on the other one. Quanta and Coulomb friction are left out.
///
/// Returns the largest magnitude of an eigenvalue: the loop comes to rest if it is below 1. Empty if the mass or the damping is not known, or
/// if the response needs more than 64 ticks to settle. [any thread]
std::optional<double> loopRadius (std::span<const double> response, const DeviceNumbers&, double period_s, const HeldHand&);

/// The same for several axes, of one device or of several, each with such a hand. `axes` are the devices of the rows and columns of the response. Axes
/// that do not influence each other are separate loops, also after a turn of the axes of one device. Also empty if one of these loops has more than 64
/// states. [any thread]
std::optional<double> loopRadius (std::span<const Jacobian> response, std::span<const DeviceNumbers* const> axes, double period_s, const HeldHand&);

/// The exact damping that the devices need so that a loop is passive, whatever the hand does: the largest eigenvalue, over all frequencies, of
///
///     W^1/2 Re [T/2 (1 - e^-jwT) H (w)] W^1/2 / (1 - cos wT)
///
/// Re is the Hermitian part. H is the frequency response of the force, with the delays of the devices. W has a weight for each axis. With weights of 1,
/// the result is in N s/m. With one over the damping of each device, the loop is passive up to a result of 1. Source: Colgate & Schenkel 1994, for one
/// axis. The curl of a settled force has no bound, and is left out: see turnOf(). Empty if `response` is empty. [any thread]
std::optional<double> passivityLoad (std::span<const Jacobian> response, std::span<const DeviceNumbers* const> axes, std::span<const double> weights,
                                     double period_s);

/// The antisymmetric part of the settled slopes, a curl, as a share of the whole. 0 if the slopes are those of an energy, and so symmetric.
double turnOf (const Jacobian& settled) noexcept;

/// The largest radius of the loop, without a hand and with the usual ones. Empty if loopRadius() is. [any thread]
std::optional<double> largestRadius (std::span<const double> response, const DeviceNumbers&, double period_s);
std::optional<double> largestRadius (std::span<const Jacobian> response, std::span<const DeviceNumbers* const> axes, double period_s);

/// The largest radius of a loop that rests. A tool that nothing holds has an eigenvalue of 1.
inline constexpr double at_rest = 1.0 + 1e-7;

/// True if the loop comes to rest without a hand and with each of the usual ones; false also if loopRadius() is empty. [any thread]
bool comesToRest (std::span<const double> response, const DeviceNumbers&, double period_s);
bool comesToRest (std::span<const Jacobian> response, std::span<const DeviceNumbers* const> axes, double period_s);

/// The factor by which a response can grow before its loop swings, within a thousandth. `rests (factor)` tells whether the loop rests if the response
/// is that many times as large. The result is above 1 if the loop rests now, and below 1 if it swings; 0 if it swings even at a thousandth of the
/// response. At most 1024.
template <typename Rests>
double roomToGrow (Rests&& rests)
{
    constexpr double most = 1024.0;
    double low = 1.0, high = 1.0;   // rests, swings
    if (rests (1.0))
        for (high = 2.0; high <= most && rests (high); high *= 2.0)
            low = high;
    else
    {
        for (low = 0.5; low > 1.0 / most && ! rests (low); low *= 0.5)
            high = low;
        if (! (low > 1.0 / most)) return 0.0;
    }
    if (high > most) return most;
    while (high > 1.001 * low)
        (rests (0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
    return low;
}

/// The response of a graph along a direction in which a node's own force changes, as for loopRadius().
struct NodeResponse
{
    std::size_t node = 0;
    std::vector<double> response {};
    std::array<double, 3> direction {};   ///< a unit vector

    double mayGrow (const DeviceNumbers&, double period_s) const;         ///< roomToGrow(); mass and damping must be known
    double passivityLoad (const DeviceNumbers&, double period_s) const;   ///< of this loop alone, in N s/m
};

/// The responses at a place, those of the steepest node first. A node whose direction another one has, such as a mixer, is left out: the steeper one stands
/// for both, or the first one. `response` is that of the role in its three axes, at this place. [any thread]
std::vector<NodeResponse> nodeResponses (const Slope&, std::span<const Jacobian> response);

/// The loop of each node at a place that is nearest to swinging, the weakest first.
struct NodeLoop
{
    NodeResponse along {};
    double may_grow = 0.0;
};

/// As nodeResponses(). Empty if mass or damping of the device are not known. [any thread]
std::vector<NodeLoop> nodeLoops (const Slope&, std::span<const Jacobian> response, const DeviceNumbers&, double period_s);

}   // namespace tactus::check
