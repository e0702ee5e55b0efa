// SPDX-License-Identifier: MIT
#pragma once

/// The reports between a board and Tactus: 64 bytes each way, little-endian, without a report id. docs/devices.md of Tactus describes them.
/// And who drives the motors: Tactus, or the board's own graph.

#include <tactus/run/generated/exported_graph.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace tactus::board
{

using Report = std::array<std::uint8_t, 64>;

/// The state of the board, in addition to its reading.
struct State
{
    bool is_homed = false;      ///< the position is known
    bool is_driven = false;     ///< the motors do what the host asks, within the limits of the guard
    bool is_released = false;   ///< the watchdog has released the motors
    bool is_hot = false;
    std::uint32_t number = 0;   ///< of this report; one more in each
    std::uint32_t us = 0;       ///< when the position was sampled
};

/// A request from the host.
struct Asked
{
    bool is_valid = false, drives = false;
    std::uint32_t answers = 0;   ///< the number of the report that this one answers
    Effort effort {};
};

inline void put (Report& r, std::size_t at, std::uint32_t value) noexcept
{
    for (std::size_t i = 0; i < 4; ++i)
        r[at + i] = static_cast<std::uint8_t> (value >> (8 * i));
}

inline std::uint32_t get (const Report& r, std::size_t at) noexcept
{
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value |= static_cast<std::uint32_t> (r[at + i]) << (8 * i);
    return value;
}

/// A number as 32 bits in units of which there are `per_one` in 1, at the limit if it is too large. A float has fewer bits, so a position is added
/// from two parts.
inline void put (Report& r, std::size_t at, Fine value, double per_one) noexcept
{
    using std::floor;
    constexpr double most = 2147483520.0;
    Fine rounded = floor (value * per_one + 0.5);
    if (! (rounded < most)) rounded = most;
    if (! (rounded > -most)) rounded = -most;
    const double first = static_cast<double> (rounded), second = static_cast<double> (rounded - first);
    put (r, at, static_cast<std::uint32_t> (static_cast<std::int32_t> (first) + static_cast<std::int32_t> (second)));
}

inline double get (const Report& r, std::size_t at, double unit) noexcept { return static_cast<double> (static_cast<std::int32_t> (get (r, at))) * unit; }

/// CRC-32 (IEEE) of bytes 0 to 59.
inline std::uint32_t crcOf (const Report& r) noexcept
{
    std::uint32_t crc = 0xffffffff;
    for (std::size_t i = 0; i < 60; ++i)
    {
        crc ^= r[i];
        for (int bit = 0; bit < 8; ++bit)
            crc = crc >> 1 ^ (0xedb88320 & (0u - (crc & 1u)));
    }
    return ~crc;
}

inline Report reportOf (const Reading& reading, const State& state) noexcept
{
    constexpr double nano = 1e9, micro = 1e6;
    Report r {};
    r[0] = 0x54;
    r[1] = 1;
    r[2] = static_cast<std::uint8_t> ((state.is_homed ? 1 : 0) | (state.is_driven ? 2 : 0) | (state.is_released ? 4 : 0) | (state.is_hot ? 8 : 0));
    put (r, 4, state.number);
    put (r, 8, state.us);
    for (int c = 0; c < 3; ++c)
    {
        put (r, 12 + 4 * static_cast<std::size_t> (c), reading.position[c], nano);
        put (r, 24 + 4 * static_cast<std::size_t> (c), reading.rotation[c], micro);
    }
    put (r, 36, reading.pressure, micro);
    put (r, 40, reading.buttons);
    for (int a = 0; a < 4; ++a)
        put (r, 44 + 4 * static_cast<std::size_t> (a), reading.axes[a], micro);
    return r;
}

inline Asked askedBy (const Report& r) noexcept
{
    constexpr double micro = 1e-6;
    Asked all;
    all.is_valid = r[0] == 0x54 && r[1] == 1 && get (r, 60) == crcOf (r);
    if (! all.is_valid) return all;
    all.drives = (r[2] & 1) != 0;
    all.answers = get (r, 4);
    for (int c = 0; c < 3; ++c)
    {
        all.effort.force[c] = get (r, 8 + 4 * static_cast<std::size_t> (c), micro);
        all.effort.torque[c] = get (r, 20 + 4 * static_cast<std::size_t> (c), micro);
    }
    for (int a = 0; a < 4; ++a)
        all.effort.axes.set (a, get (r, 32 + 4 * static_cast<std::size_t> (a), micro));
    return all;
}

/// A button of which only presses count. A button that is held at a reset, is stuck or only bounces does not count.
class Button
{
public:
    /// True once for each press: the button was up for 20 ms, may have bounced, and is down for 20 ms. Of the time of a late tick, only 2 ms count.
    bool isPressed (std::uint32_t now_us, bool is_down) noexcept
    {
        const auto passed = now_us - seen_us;
        seen_us = now_us;
        if (is_down != was_down)
        {
            was_down = is_down;
            steady_us = 0;
            return false;
        }
        if (steady_us >= settles_us) return false;
        steady_us += passed < most_us ? passed : most_us;
        if (steady_us < settles_us) return false;
        const bool counts = is_down && was_up;
        was_up = ! is_down;
        return counts;
    }

private:
    static constexpr std::uint32_t settles_us = 20000, most_us = 2000;
    bool was_down = true, was_up = false;   // as if it were held since before the reset
    std::uint32_t seen_us = 0, steady_us = settles_us;
};

/// Decides who drives the motors. The board's own graph drives until a host has sent its first valid report, whatever that asks for. From then
/// on, only the host drives: when it stops driving or falls silent, the board rests. The board's own graph returns only when the arm input is
/// pressed while no host sends reports, or after a reset. All forces pass the guard of the role, and each change goes through zero: the guard
/// brings the force there as in every stop, and the next force rises along the ramp.
///
/// Times are compared by their differences, so a clock that wraps does no harm, and a host that is silent stays so until its next report.
class Authority
{
public:
    static constexpr std::uint32_t watchdog_us = 20000;

    explicit Authority (exported::Role& driven) noexcept : role (driven) {}
    Authority (const Authority&) = delete;
    Authority& operator= (const Authority&) = delete;

    /// Takes a report from the host. One that is not valid is ignored.
    void hear (const Report& report, std::uint32_t now_us) noexcept
    {
        const auto now = askedBy (report);
        if (! now.is_valid) return;
        if (is_there && now_us - heard_us > watchdog_us) was_silent = true;   // the board itself was late
        asked = now;
        heard_us = now_us;
        has_host = is_there = true;
        has_timed_out = false;
    }

    /// Decides for this tick. Call it on every tick, after hear() and before the graph ticks.
    void decide (std::uint32_t now_us, bool is_arm_down) noexcept
    {
        if (is_there && now_us - heard_us > watchdog_us)
        {
            is_there = false;
            has_timed_out = asked.drives;
        }
        auto& guard = role.guard;
        if (arm.isPressed (now_us, is_arm_down))
        {
            guard.rearm();
            if (! is_there) has_host = false;
        }
        const bool is_asked = ! has_host || (is_there && asked.drives && ! was_silent);
        was_silent = false;
        const Effort* const source = has_host ? &asked.effort : nullptr;
        if (role.instead != source && guard.stop() != Guard::Stop::none && guard.isAtRest()) role.instead = source;
        if (is_asked && role.instead == source)
            guard.resume();
        else
            guard.halt();
    }

    /// Whether the motors do what the host asks. Call this and the next one after the graph has ticked.
    bool isDriven() const noexcept { return is_there && asked.drives && role.instead == &asked.effort && role.guard.stop() == Guard::Stop::none; }

    /// Whether the motors were released because the host fell silent while it drove.
    bool hasTimedOut() const noexcept { return has_timed_out; }

private:
    exported::Role& role;
    Button arm;
    Asked asked;
    std::uint32_t heard_us = 0;
    bool has_host = false;     // a host has spoken since the reset or since the arm input was pressed
    bool is_there = false;     // and not fallen silent since
    bool was_silent = false;   // between its last two reports
    bool has_timed_out = false;
};

}   // namespace tactus::board
