// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/device.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace tactus
{

/// The part of a reading that every device has, as numbers in the order of reading_fields. A double holds each of these values
/// exactly.
inline constexpr std::size_t reading_size = 23;
using ReadingNumbers = std::array<double, reading_size>;

struct ReadingField
{
    std::string_view key;   ///< key in a log
    std::size_t first, size;
};

inline constexpr ReadingField reading_fields[] {
    { "position", 0, 3 },
    { "rotation", 3, 3 },
    { "pressure", 6, 1 },
    { "buttons", 7, 1 },
    { "age", 8, 1 },
    { "valid", 9, 1 },
    { "true_position", 10, 3 },
    { "true_velocity", 13, 3 },
    { "fault", 16, 1 },
    { "unrendered_force", 17, 3 },
    { "unrendered_torque", 20, 3 },
};
static_assert (sizeof (Reading) == (reading_size - 1) * sizeof (double) + 2 * sizeof (Channels),   // buttons and fault share eight bytes
               "a new field of a reading must be added to the log too");

/// A complete reading, as in a log.
struct LoggedReading
{
    ReadingNumbers numbers {};
    Channels axes {}, signals {};
};

inline std::span<const double> valuesOf (const Channels& channels) noexcept { return { channels.begin(), channels.end() }; }

/// The parts of a reading whose size depends on the device.
struct ChannelField
{
    std::string_view key;
    Channels LoggedReading::*value;
};

inline constexpr ChannelField channel_fields[] {
    { "axes", &LoggedReading::axes },
    { "signals", &LoggedReading::signals },
};

inline ReadingNumbers toNumbers (const Reading& r) noexcept
{
    const auto &p = r.position, &w = r.rotation, &x = r.true_position, &v = r.true_velocity, &f = r.unrendered_force, &t = r.unrendered_torque;
    return { p.x(), p.y(), p.z(), w.x(), w.y(), w.z(), r.pressure, static_cast<double> (r.buttons), r.age, r.valid ? 1.0 : 0.0,
             x.x(), x.y(), x.z(), v.x(), v.y(), v.z(), static_cast<double> (r.fault), f.x(), f.y(), f.z(), t.x(), t.y(), t.z() };
}

inline LoggedReading toLogged (const Reading& r) noexcept { return { toNumbers (r), r.axes, r.signals }; }

/// Numbers that a reading cannot hold are replaced: 0.5 for `valid` becomes true, and `buttons` or a `fault` out of range become 0.
inline Reading toReading (const LoggedReading& logged) noexcept
{
    const auto& n = logged.numbers;
    const auto vector = [&] (std::size_t i) { return Vec3 (n[i], n[i + 1], n[i + 2]); };
    constexpr double all_buttons = 4294967295.0;
    return {
        .position = vector (0),
        .rotation = vector (3),
        .pressure = n[6],
        .buttons = n[7] >= 0.0 && n[7] <= all_buttons ? static_cast<std::uint32_t> (n[7]) : 0u,
        .fault = n[16] >= 0.0 && n[16] < static_cast<double> (reading_faults.size()) ? static_cast<ReadingFault> (static_cast<std::uint32_t> (n[16]))
                                                                                     : ReadingFault::none,
        .age = n[8],
        .valid = n[9] != 0.0,
        .true_position = vector (10),
        .true_velocity = vector (13),
        .unrendered_force = vector (17),
        .unrendered_torque = vector (20),
        .axes = logged.axes,
        .signals = logged.signals,
    };
}

}   // namespace tactus
