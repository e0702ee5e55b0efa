// SPDX-License-Identifier: MIT
#pragma once

// A watch over a simulated board: it knows who may drive, and checks every force that reaches the motors. Include it after the sketch.

#include "Arduino.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

inline constexpr int motor_pins[] { 3, 5, 6 }, direction_pins[] { 7, 8, 9 };
inline constexpr double newtons_per_count = 1.0 / 50.0;
inline constexpr std::uint64_t second = 1000000, wrap = std::uint64_t { 1 } << 32;

struct Limits
{
    double force = 0.0, slew = 0.0, ramp = 0.0;
};

inline Limits limits;

[[noreturn]] inline void fail (const char* what, double value = 0.0)
{
    std::printf ("at %.6f s: %s (%g)\n", 1e-6 * static_cast<double> (RawHID.now_us), what, value);
    std::exit (1);
}

inline void check (bool is_right, const char* what, double value = 0.0)
{
    if (! is_right) fail (what, value);
}

inline std::array<double, 3> forceNow()
{
    std::array<double, 3> f {};
    for (std::size_t c = 0; c < 3; ++c)
        f[c] = newtons_per_count * RawHID.duty[static_cast<std::size_t> (motor_pins[c])]
               * (RawHID.level[static_cast<std::size_t> (direction_pins[c])] == LOW ? -1 : 1);
    return f;
}

inline double sizeOf (const std::array<double, 3>& f) { return std::hypot (f[0], f[1], f[2]); }

/// Knows who may drive, by what the board has read, and checks every force that reaches the motors.
class Watch
{
public:
    /// [from SimulatedBoard]
    void read (const SimulatedBoard::Sent& sent)
    {
        const bool is_valid = sent.size == 64 && sent.bytes[0] == 0x54 && sent.bytes[1] == 1
                              && tactus::board::get (sent.bytes, 60) == tactus::board::crcOf (sent.bytes);
        if (! is_valid) return;
        has_host = true;
        drives = (sent.bytes[2] & 1) != 0;
        heard_us = RawHID.now_us;
    }

    /// Advances the clock, passes through loop() once, and checks what the motors do.
    void pass (std::uint64_t us)
    {
        RawHID.now_us += us;
        const auto before = sizeOf (forceNow());
        const auto last = RawHID.ticks;
        lookAtButton (us);
        loop();
        longest_us = std::max (us, longest_us);
        const auto driver = driverNow();
        if (driver != last_driver)
        {
            changed_us = RawHID.now_us;
            at_change = before;
            longest_us = 0;
            ticks = 0;
        }
        else if (RawHID.ticks != last)
            ++ticks;
        last_driver = driver;
        checkForce (driver);
        checkSlew();
    }

    double pushed_s[3] {};   ///< for how long each driver has pushed

private:
    enum Driver
    {
        nobody,
        board,
        host
    };

    bool isSilent() const { return RawHID.now_us - heard_us > 20000; }

    Driver driverNow() const
    {
        if (! has_host) return board;
        return drives && ! isSilent() ? host : nobody;
    }

    /// A press counts if the button was up and then, when it no longer bounced, down for 20 ms, give or take some passes. Of a pass that is
    /// late, 2 ms count.
    void lookAtButton (std::uint64_t us)
    {
        constexpr std::uint64_t longest = 2000, may_count = 15000, has_counted = 30000;
        steady_us = RawHID.is_button_down == was_down ? steady_us + std::min (us, longest) : 0;
        was_down = RawHID.is_button_down;
        if (! was_down && steady_us >= may_count) was_up = true;
        if (was_down && steady_us > has_counted) was_up = false;
        if (was_down && steady_us >= may_count && was_up && has_host && isSilent()) has_host = false;
    }

    void checkForce (Driver driver)
    {
        const auto force = sizeOf (forceNow());
        check (force <= limits.force + 1e-9, "more than the limit, in N", force);
        const double since = 1e-6 * static_cast<double> (RawHID.now_us - changed_us);
        const double stop = std::max (0.005, at_change / limits.slew) + 3e-6 * static_cast<double> (std::max<std::uint64_t> (longest_us, 1000));
        if (since <= stop) return;
        if (driver != nobody && static_cast<double> (ticks) * tick_s <= stop) return;   // what is left falls by ticks, as it is no stop
        if (driver == nobody) check (force == 0.0, "a force that nobody asks for, in N", force);
        const double ramp = (since + 1e-6 * static_cast<double> (longest_us)) / limits.ramp;
        check (force <= limits.force * ramp + newtons_per_count, "a force above the ramp, in N", force);
        if (force > 0.0) pushed_s[driver] += 1e-6 * static_cast<double> (RawHID.now_us - last_us);
        last_us = RawHID.now_us;
    }

    void checkSlew()
    {
        past.push_back ({ RawHID.now_us, forceNow() });
        for (std::size_t lag = 1; lag < past.size() && lag <= 4096; lag *= 2)
        {
            const auto& earlier = past[past.size() - 1 - lag];
            for (std::size_t c = 0; c < 3; ++c)
            {
                const double change = std::abs (past.back().force[c] - earlier.force[c]), s = 1e-6 * static_cast<double> (RawHID.now_us - earlier.us);
                check (change <= limits.slew * (s + tick_s) + newtons_per_count + 1e-9, "a step beyond the slew, in N", change);
            }
        }
        if (past.size() > 20000) past.erase (past.begin(), past.begin() + 10000);
    }

    struct Sample
    {
        std::uint64_t us;
        std::array<double, 3> force;
    };

    static constexpr double tick_s = 1e-6 * static_cast<double> (period_us);   // a tick may come at the end of one pass and at the start of another
    std::vector<Sample> past;
    bool has_host = false, drives = false, was_down = true, was_up = false;
    Driver last_driver = board;
    std::uint64_t heard_us = 0, changed_us = RawHID.now_us, longest_us = 0, ticks = 0, steady_us = 0, last_us = RawHID.now_us;
    double at_change = 0.0;
};
