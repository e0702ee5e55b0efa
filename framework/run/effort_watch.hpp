// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node/device.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace tactus
{

/// The speed of a tool, from the positions measured by its device: a low-pass filtered difference,
///
///     v += (x - x' - v s)/(tau + s)        s: time between the two readings
///
/// so an error of one quantum q adds at most q/tau (10 um: 2 mm/s), and a speed V is measured as V (1 - e^(-t/tau)). If a
/// device is slower than the tick and does not report the age of its readings, the speed fluctuates by a fraction s/tau.
class SpeedWatch
{
public:
    static constexpr double tau = 0.005;   ///< s

    /// The distance moved since the last reading; 0 for the first. Readings are finite. [tick thread]
    Vec3 operator() (const Reading& reading, double now_s) noexcept
    {
        const double at = now_s - reading.age;
        const Vec3 moved = known ? Vec3 (reading.position - before) : Vec3 (Vec3::Zero());
        const double elapsed = known ? std::max (0.0, at - before_at) : 0.0;
        velocity += (moved - elapsed * velocity) / (tau + elapsed);
        before = reading.position;
        before_at = at;
        known = true;
        return moved;
    }

    /// The device had no reading, so the distance to its next position does not count as motion.
    void forget() noexcept { known = false; }

    /// The speed in m/s; inf if it is out of range.
    double speed() const noexcept
    {
        const double v = velocity.norm();
        return v == v ? v : inf;
    }

private:
    static constexpr double inf = std::numeric_limits<double>::infinity();

    Vec3 velocity = Vec3::Zero(), before = Vec3::Zero();
    double before_at = 0.0;
    bool known = false;
};

/// The integral of |force| over the last `window`, stored in sixteenths of the window. It covers at least the window, and at
/// most 17/16 of it plus 17 ticks.
class ImpulseWatch
{
public:
    /// A window that is not finite lasts for ever. [main thread]
    void prepare (double window_s, double dt_s) noexcept
    {
        *this = {};
        const double ticks = std::ceil (window_s / dt_s / parts);
        ticks_in_part = ticks < 1e15 ? std::max (std::uint64_t { 1 }, static_cast<std::uint64_t> (ticks)) : ~std::uint64_t { 0 };
    }

    /// The impulse within the window in N s, including this sample. [tick thread]
    double operator() (double newton_seconds) noexcept
    {
        if (ticks_in_now == ticks_in_part)
        {
            full[oldest] = now;
            oldest = (oldest + 1) % parts;
            in_full = 0.0;
            for (const double part : full)
                in_full += part;
            now = 0.0;
            ticks_in_now = 0;
        }
        ++ticks_in_now;
        now += newton_seconds;
        return in_full + now;
    }

private:
    static constexpr std::size_t parts = 16;

    std::uint64_t ticks_in_part = 1, ticks_in_now = 0;
    std::array<double, parts> full {};
    std::size_t oldest = 0;
    double now = 0.0, in_full = 0.0;
};

/// Energy that a device has given to the hand beyond its allowance:
///
///     D = max (0, D + f.dx - P T)        P = most/window; f: the effort on the device while it moved by dx
///
/// D > most if and only if, over some stretch of time of any length L, the device gave more than most (1 + L/window). So a
/// spring that stores no more than `most` never exceeds it, however it is pressed and released, and neither does any passive
/// load; a loop that continuously gives more than the power P does. Energy that the hand has put in and that was dissipated,
/// for example by friction, does not count as credit.
///
/// After the passivity observer of Hannaford & Ryu 2002, which never forgets: there, ten minutes of braking would allow a loop
/// to be active for just as long.
class EnergyWatch
{
public:
    /// A window that is not finite lasts for ever. [main thread]
    void prepare (double most_j, double window_s, double dt_s) noexcept
    {
        delivered = 0.0;
        allowed_per_tick = std::isfinite (window_s) ? most_j / window_s * dt_s : 0.0;
        if (! std::isfinite (allowed_per_tick)) allowed_per_tick = 0.0;
    }

    /// D in J. [tick thread]
    double operator() (const Vec3& force, const Vec3& moved) noexcept
    {
        const double sum = delivered + force.dot (moved) - allowed_per_tick;
        if (sum != sum) return std::numeric_limits<double>::infinity();
        return delivered = std::max (0.0, sum);
    }

private:
    double delivered = 0.0, allowed_per_tick = 0.0;
};

}   // namespace tactus
