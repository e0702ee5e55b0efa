// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace tactus
{

/// Exponents of metre, kilogram and second. They are 0 for angles and ratios.
struct Dimension
{
    signed char m = 0, kg = 0, s = 0;

    constexpr bool operator== (const Dimension&) const = default;
};

/// An exponent, limited to ±100. The limit is beyond anything physical, and keeps a huge exponent from wrapping around to a
/// plausible one.
constexpr signed char exponent (int e) noexcept
{
    if (e > 100) return 100;
    return static_cast<signed char> (e < -100 ? -100 : e);
}

constexpr Dimension operator* (Dimension a, Dimension b) noexcept { return { exponent (a.m + b.m), exponent (a.kg + b.kg), exponent (a.s + b.s) }; }

constexpr Dimension operator/ (Dimension a, Dimension b) noexcept { return { exponent (a.m - b.m), exponent (a.kg - b.kg), exponent (a.s - b.s) }; }

/// The meaning of a number. Two quantities may share a dimension (torque and energy): a wire between them is a warning. A wire between different
/// dimensions is an error. `any` has only a dimension, and never causes a warning.
enum class Quantity
{
    any,
    length,
    angle,
    speed,
    force,
    torque,
    energy,
    hit,
    mass,
    stiffness,
    damping,
    frequency,
    rate,
    spatial_frequency,
    gain,
    state
};

constexpr std::string_view name (Quantity q) noexcept
{
    constexpr std::string_view names[] = { "any", "length", "angle", "speed", "force", "torque", "energy", "hit", "mass", "stiffness",
                                           "damping", "frequency", "rate", "spatial_frequency", "gain", "state" };
    return names[static_cast<int> (q)];
}

/// A quantity in its SI unit, as in a datasheet. Graphs use no other units.
struct Unit
{
    Quantity quantity = Quantity::any;
    Dimension dimension;
    std::string_view symbol = "1";

    constexpr bool operator== (const Unit&) const = default;
};

namespace unit
{
inline constexpr Unit metre { Quantity::length, { 1, 0, 0 }, "m" };
inline constexpr Unit radian { Quantity::angle, {}, "rad" };
inline constexpr Unit speed { Quantity::speed, { 1, 0, -1 }, "m/s" };
inline constexpr Unit newton { Quantity::force, { 1, 1, -2 }, "N" };
inline constexpr Unit torque { Quantity::torque, { 2, 1, -2 }, "N*m" };
inline constexpr Unit joule { Quantity::energy, { 2, 1, -2 }, "J" };
inline constexpr Unit hit { Quantity::hit, { 1, 0, -1 }, "m/s" };
inline constexpr Unit kilogram { Quantity::mass, { 0, 1, 0 }, "kg" };
inline constexpr Unit stiffness { Quantity::stiffness, { 0, 1, -2 }, "N/m" };
inline constexpr Unit damping { Quantity::damping, { 0, 1, -1 }, "N*s/m" };
inline constexpr Unit hertz { Quantity::frequency, { 0, 0, -1 }, "Hz" };
inline constexpr Unit per_second { Quantity::rate, { 0, 0, -1 }, "1/s" };
inline constexpr Unit per_metre { Quantity::spatial_frequency, { -1, 0, 0 }, "1/m" };
inline constexpr Unit gain { Quantity::gain, {}, "1" };
inline constexpr Unit state { Quantity::state, {}, "1" };
inline constexpr Unit second { Quantity::any, { 0, 0, 1 }, "s" };
inline constexpr Unit second_per_metre { Quantity::any, { -1, 0, 1 }, "s/m" };
inline constexpr Unit kilogram_per_metre { Quantity::any, { -1, 1, 0 }, "kg/m" };
inline constexpr Unit toughness { Quantity::any, { 0, 1, -2 }, "J/m2" };
inline constexpr Unit decibel { Quantity::any, {}, "dB" };
inline constexpr Unit count { Quantity::any, {}, "1" };
}   // namespace unit

}   // namespace tactus
