// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/device.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace tactus::host
{

/// The part of a reading that every device has, as numbers, one after another as reading_fields has them. Every one of its
/// values is exact as a double.
inline constexpr std::size_t reading_size = 16;
using ReadingNumbers = std::array<double, reading_size>;

struct ReadingField
{
    std::string_view key;   ///< as a log has it
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
};
static_assert (sizeof (Reading) == reading_size * sizeof (double) + 2 * sizeof (Channels), "what is new in a reading belongs into the log as well");

/// All of a reading, as a log has it.
struct LoggedReading
{
    ReadingNumbers numbers {};
    Channels axes {}, signals {};
};

/// The parts of which there are as many as the device has.
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
    const auto &p = r.position, &w = r.rotation, &x = r.true_position, &v = r.true_velocity;
    return { p.x(), p.y(), p.z(), w.x(), w.y(), w.z(), r.pressure, static_cast<double> (r.buttons), r.age, r.valid ? 1.0 : 0.0, x.x(), x.y(), x.z(), v.x(), v.y(), v.z() };
}

inline LoggedReading toLogged (const Reading& r) noexcept { return { toNumbers (r), r.axes, r.signals }; }

/// Numbers that no reading has, as 0.5 for `valid`, become the nearest that one can have.
inline Reading toReading (const LoggedReading& logged) noexcept
{
    const auto& n = logged.numbers;
    const auto vector = [&] (std::size_t i)
    { return Vec3 (n[i], n[i + 1], n[i + 2]); };
    constexpr double most_buttons = 4294967295.0;
    return {
        .position = vector (0),
        .rotation = vector (3),
        .pressure = n[6],
        .buttons = n[7] >= 0.0 && n[7] <= most_buttons ? static_cast<std::uint32_t> (n[7]) : 0u,
        .age = n[8],
        .valid = n[9] != 0.0,
        .true_position = vector (10),
        .true_velocity = vector (13),
        .axes = logged.axes,
        .signals = logged.signals,
    };
}

}   // namespace tactus::host
