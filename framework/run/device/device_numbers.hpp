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
    bool guess = false;      ///< true if the number is neither published nor measured

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

/// The properties of a device that matter to the hand and to the control loop: the numbers in the conditions of stability and in
/// Table 1 of Hayward, "Physically-Based Haptic Synthesis". An empty number is unknown. Profiles use the same names as keys of
/// "physics". The descriptions of simulated devices use those that have `is_simulated` in the table below.
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
    Number end_mass {};             ///< part of the mass that is at the tool, on the far side of the structure, in kg, > 0 and less than mass
    Number peak_force {};           ///< largest force at the tool, in N, > 0
    Number rate {};                 ///< 1/T, ticks per second, in Hz, > 0
    std::optional<DeviceReach> workspace {};

    bool operator== (const DeviceNumbers&) const = default;
};

/// A row of the table of all numbers except the workspace.
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

/// True if no number is known.
bool isEmpty (const DeviceNumbers&);

/// The numbers of a simulated device. The rate is left empty, because it is that of the run, and so is the workspace, because it has
/// no bounds. The peak force is the max_force of the guard, and empty without one. A rigid device has no first_mode_damping and no
/// end_mass. [main thread]
DeviceNumbers numbersOf (const Simulation&, const GuardLimits& = {});

}   // namespace tactus
