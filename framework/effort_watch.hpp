// SPDX-License-Identifier: MIT
#pragma once

#include "device.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace tactus
{

/// How fast a tool moves, from the positions that its device measures: a difference through a low-pass,
///
///     v += (x - x' - v s)/(tau + s)        s: between the two readings
///
/// so that one quantum q more or less makes at most q/tau (10 um: 2 mm/s), and a speed V is seen as V (1 - e^(-t/tau)).
/// A device that is slower than the tick and does not tell the age of its readings shows a speed that goes up and down by
/// s/tau of itself.
class SpeedWatch
{
public:
    static constexpr double tau = 0.005;   ///< s

    /// How far it has moved since the reading before; 0 for the first. Readings are finite. [tick thread]
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

    /// The device had nothing to say: where it is next is no way that it has gone since.
    void forget() noexcept { known = false; }

    /// m/s; inf for what is out of all bounds.
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

/// The integral of |force| over the last `window`, in parts of a sixteenth of it: what is counted is never of less than the
/// window, and never of more than 17/16 of it and 17 ticks.
class ImpulseWatch
{
public:
    /// A window that is not finite never ends. [main thread]
    void prepare (double window_s, double dt_s) noexcept
    {
        *this = {};
        const double ticks = std::ceil (window_s / dt_s / parts);
        ticks_in_part = ticks < 1e15 ? std::max (std::uint64_t { 1 }, static_cast<std::uint64_t> (ticks)) : ~std::uint64_t { 0 };
    }

    /// N s within the window, with this one. [tick thread]
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

/// How much energy a device has given to the hand beyond what it may:
///
///     D = max (0, D + f.dx - P T)        P = most/window; f: what was on the device while it moved by dx
///
/// D > most exactly if there was a stretch of time, of whatever length L, over which it gave more than most (1 + L/window).
/// So a spring that stores no more than `most` never gets there, however it is pressed and let go, nor does anything else
/// that only gives back; a loop that gives power for good does, if it is more than P. Energy that the hand has put in and
/// that is gone, as by friction, is no credit.
///
/// After the passivity observer of Hannaford & Ryu 2002, which forgets nothing: there, a brake of ten minutes lets a loop
/// be active for as long.
class EnergyWatch
{
public:
    /// A window that is not finite never ends. [main thread]
    void prepare (double most_j, double window_s, double dt_s) noexcept
    {
        delivered = 0.0;
        allowed_per_tick = std::isfinite (window_s) ? most_j / window_s * dt_s : 0.0;
        if (! std::isfinite (allowed_per_tick)) allowed_per_tick = 0.0;
    }

    /// J. [tick thread]
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
