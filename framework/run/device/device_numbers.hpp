// SPDX-License-Identifier: MIT
#pragma once

#include "sim.hpp"
#include <tactus/run/guard.hpp>
#include <tactus/text/object_reader.hpp>
#include <tactus/text/quantity.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tactus
{

/// One property of a device, in SI units.
struct DeviceNumber
{
    double value = 0.0;
    std::string source {};   ///< where the number comes from
    bool guess = false;      ///< true if nobody has published or measured the number

    bool operator== (const DeviceNumber&) const = default;
};

/// The box that the tool can reach, in m.
struct DeviceReach
{
    Vec3 min = Vec3::Zero(), max = Vec3::Zero();
    std::string source {};
    bool guess = false;

    bool operator== (const DeviceReach&) const = default;
};

/// What a device is like for the hand and for the control loop: the numbers in the conditions of stability and in Table 1 of
/// Hayward, "Physically-Based Haptic Synthesis". An empty number is unknown. The names are the keys of profiles ("physics") and,
/// as far as they are properties of a simulated device, of its description.
struct DeviceNumbers
{
    using Number = std::optional<DeviceNumber>;

    Number mass {};                 ///< M, as felt at the tool, in kg, > 0
    Number damping {};              ///< B, viscous damping of the mechanics, in N s/m, >= 0
    Number coulomb {};              ///< f_f, Coulomb friction of the mechanics, in N, >= 0
    Number quantum {};              ///< delta, resolution of the position, in m, >= 0
    Number force_quantum {};        ///< b, resolution of the force, in N, >= 0
    Number delay {};                ///< d, delay of the force in whole ticks, in addition to the hold
    Number first_mode {};           ///< F_0, first resonance of the structure, in Hz, > 0; infinite for a rigid simulated device
    Number first_mode_damping {};   ///< damping ratio of the first resonance, 0 to 1
    Number end_mass {};             ///< part of the mass beyond the compliance, at the tool, in kg, > 0 and less than mass
    Number peak_force {};           ///< largest force at the tool, in N, > 0
    Number rate {};                 ///< 1/T, ticks per second, in Hz, > 0
    std::optional<DeviceReach> workspace {};

    bool operator== (const DeviceNumbers&) const = default;
};

/// A row of the table of all numbers but the workspace.
struct DeviceNumberRow
{
    std::string_view id;
    Unit unit;
    Bounds bounds;
    DeviceNumbers::Number DeviceNumbers::*member;
    bool is_whole = false;
    bool is_simulated = true;   ///< true if the id is also a key of the description of a simulated device
};

std::span<const DeviceNumberRow> deviceNumberRows() noexcept;

/// True if not a single number is known.
bool isEmpty (const DeviceNumbers&);

/// The numbers of a simulated device. All are known but the rate, which is that of the run, and the workspace, which has no bounds.
/// The peak force is the guard's max_force, if it has one. [main thread]
DeviceNumbers numbersOf (const Simulation&, const GuardLimits& = {});

}   // namespace tactus
