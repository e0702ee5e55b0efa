// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/geometry/rotation.hpp>
#include <tactus/kit/math/math.hpp>
#include <tactus/node/device.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace tactus
{

/// The motion of a tool and its axes between two readings of a device.
class MotionWatch
{
public:
    Vec3 moved = Vec3::Zero();   ///< motion of the tool since the last reading, in m; 0 for the first reading
    double elapsed = 0.0;        ///< time between the two readings, in s

    /// Takes a reading, which must be finite. A negative age counts as 0, because it would make the motion seem slow. turned() and axisMoved()
    /// refer to this reading until the next call. [tick thread]
    void begin (const Reading& reading, Fine now_s) noexcept
    {
        // A repeated reading whose age grows faster than the time is not an earlier one.
        const Fine at = known ? std::max (before_at, now_s - std::max (0.0, reading.age)) : now_s - std::max (0.0, reading.age);
        moved = known ? Vec3 (reading.position - position) : Vec3 (Vec3::Zero());
        elapsed = known ? static_cast<double> (at - before_at) : 0.0;
        position = reading.position;
        before_at = at;
        was_known = std::exchange (known, true);
    }

    /// The rotation since the last reading as a rotation vector, in rad. Call once for each reading. [tick thread]
    Vec3 turned (const Reading& reading) noexcept
    {
        // Most devices do not measure it.
        return was_known && reading.rotation == measured ? Vec3 (Vec3::Zero()) : turnedTo (reading);
    }

    /// The distance that axis i has moved since the last reading. Call this once for each axis and reading. [tick thread]
    double axisMoved (const Reading& reading, int i) noexcept
    {
        const double before = std::exchange (axes[static_cast<std::size_t> (i)], reading.axes[i]);
        return was_known ? reading.axes[i] - before : 0.0;
    }

    /// False if a device that is slower than the tick has returned its last reading again.
    bool isNew (double dt_s) const noexcept { return ! was_known || elapsed > 0.5 * dt_s || moved != Vec3::Zero(); }

    /// Forgets the last reading, so that the distance to the next one does not count as motion.
    void forget() noexcept { known = false; }

    void serialize (auto& archive) { archive (position, rotation, measured, axes, before_at, known, was_known); }

private:
    [[gnu::noinline]] Vec3 turnedTo (const Reading& reading) noexcept
    {
        const Quaternion now { rotationMatrix (reading.rotation) };
        const auto step = now * rotation.conjugate();
        rotation = now;
        measured = now.coeffs().allFinite() ? reading.rotation : Vec3 (Vec3::Constant (std::numeric_limits<double>::quiet_NaN()));
        if (! was_known) return Vec3::Zero();
        const double sine = step.vec().norm();
        if (sine == 0.0) return Vec3::Zero();
        if (! isFinite (sine)) return Vec3::Constant (std::numeric_limits<double>::infinity());   // no tool rotates by such an angle
        return step.vec() * (2.0 * math::atan2 (std::copysign (sine, step.w()), std::abs (step.w())) / sine);
    }

    Position position = Position::Zero();
    Quaternion rotation = Quaternion::Identity();
    Vec3 measured = Vec3::Zero();   // what `rotation` was computed from; not a number if that is not a rotation
    std::array<double, Channels::most> axes {};
    Fine before_at = 0.0;
    bool known = false, was_known = false;
};

/// The mean of the efforts that were on a device while it moved from one reading to the next.
class MeanEffort
{
public:
    bool isEmpty() const noexcept { return count == 0.0; }   ///< nothing has been added [tick thread]

    /// Adds an effort that was on the device for this many ticks, as the motors rendered it. [tick thread]
    void add (const Effort& effort, const Reading& reading, double ticks, bool with_axes) noexcept
    {
        count += ticks;
        forces += ticks * (effort.force - reading.unrendered_force);
        torques += ticks * (effort.torque - reading.unrendered_torque);
        if (! with_axes) return;
        for (int i = 0; i < effort.axes.size(); ++i)
            axes[static_cast<std::size_t> (i)] += ticks * effort.axes[i];
    }

    /// Valid once something has been added. [tick thread]
    Vec3 force() const noexcept { return forces / count; }
    Vec3 torque() const noexcept { return torques / count; }
    double axis (std::size_t i) const noexcept { return axes[i] / count; }

    void serialize (auto& archive) { archive (forces, torques, axes, count); }

private:
    Vec3 forces = Vec3::Zero(), torques = Vec3::Zero();   // sums over ticks
    std::array<double, Channels::most> axes {};
    double count = 0.0;
};

/// A low-pass filtered speed, from the distances x - x' between readings that are s apart in time:
///
///     v += (x - x' - v s)/(tau + s)
///
/// so an error of one quantum q adds at most q/tau (10 um: 2 mm/s), and a constant speed V is measured as V (1 - e^(-t/tau)). If a
/// device is slower than the tick and does not report the age of its readings, the speed fluctuates by a fraction s/tau.
class SpeedWatch
{
public:
    static constexpr double tau = 0.005;   ///< s

    /// The new velocity after a move, for vectors and for the axes of a device. [tick thread]
    template <typename T>
    static T filtered (const T& velocity, const T& moved, double elapsed_s) noexcept
    {
        return velocity + (moved - elapsed_s * velocity) / (tau + elapsed_s);
    }

    void operator() (const Vec3& moved, double elapsed_s) noexcept { velocity = filtered (velocity, moved, elapsed_s); }

    /// The speed in m/s or rad/s; inf if it is not a number.
    double speed() const noexcept
    {
        const double v = velocity.norm();
        return v == v ? v : std::numeric_limits<double>::infinity();
    }

    void serialize (auto& archive) { archive (velocity); }

private:
    Vec3 velocity = Vec3::Zero();
};

/// A watch that measures how long a position, or a part of it along which a force pushes, has stayed the same, to the last bit. Also for a rotation
/// and a torque.
///
/// A hand that holds against a force never stays still: it trembles at 8 to 12 Hz, by tens of micrometres. So a position that does not
/// change comes from a sensor that has stopped, if the sensor's quantum is finer than the tremor: at most about 10 um. If only one
/// coordinate does not change, its sensor has stopped while the others work. A coordinate that has never changed is not measured.
class StillWatch
{
public:
    /// Only a change resets a count. Without a force the counts are kept: if they were reset, a stop would end itself by taking the
    /// force away, and the force would push the hand again and again. [tick thread]
    void operator() (const Position& position, const Vec3& force, double least_force, double dt_s) noexcept
    {
        whole = position == before ? whole + (force.norm() >= least_force ? dt_s : 0.0) : 0.0;
        for (int i = 0; i < 3; ++i)
        {
            if (position[i] != before[i])
            {
                still[i] = 0.0;
                has_changed[i] = known;
            }
            else if (has_changed[i] && std::abs (force[i]) >= least_force)
                still[i] += dt_s;
        }
        before = position;
        known = true;
    }

    /// In s. The longest time of all.
    double time() const noexcept { return std::max (whole, still.maxCoeff()); }

    /// 0, 1 or 2 if only this coordinate has stopped; -1 if all have.
    int coordinate() const noexcept
    {
        int at = 0;
        return still.maxCoeff (&at) > whole ? at : -1;
    }

    void serialize (auto& archive) { archive (before, still, whole, has_changed, known); }

private:
    Position before = Position::Zero();
    Vec3 still = Vec3::Zero();   // by coordinate
    double whole = 0.0;
    bool has_changed[3] {};   // by coordinate, since the first reading
    bool known = false;
};

/// The integral of |force| over the last `window`, stored in sixteenths of the window. It covers at least the window, and at
/// most 17/16 of it plus 17 ticks.
class ImpulseWatch
{
public:
    /// A window that is not finite lasts forever. [main thread]
    void prepare (double window_s, double dt_s) noexcept
    {
        *this = {};
        part_s = (std::max (1.0, std::ceil (window_s / dt_s / parts)) - 0.5) * dt_s;   // so that rounding cannot add a tick to a part
    }

    /// Lengthens the window and keeps the counts. What has already left the shorter window is lost. [tick thread]
    void lengthen (double window_s, double dt_s) noexcept
    {
        ImpulseWatch longer;
        longer.prepare (window_s, dt_s);
        part_s = std::max (part_s, longer.part_s);
    }

    /// The impulse within the window in N s, including this sample, which lasts `passed_s`. [tick thread]
    double operator() (double newton_seconds, double passed_s) noexcept
    {
        if (now_s >= part_s)
        {
            full[oldest] = now;
            oldest = (oldest + 1) % parts;
            in_full = 0.0;
            for (const double part : full)
                in_full += part;
            now = now_s = 0.0;
        }
        now_s += passed_s;
        now += newton_seconds;
        return in_full + now;
    }

    void serialize (auto& archive)
    {
        archive (now_s, full, now, in_full);
        archive.index (oldest, parts);
    }

private:
    static constexpr std::size_t parts = 16;

    double part_s = 0.0, now_s = 0.0;   // how long a part is, and the latest one so far
    std::array<double, parts> full {};
    std::size_t oldest = 0;
    double now = 0.0, in_full = 0.0;
};

/// Energy that a device has given to the hand beyond its allowance:
///
///     D = max (0, D + f.dx - P T)        P = most/window; f: the effort on the device while it moved by dx,
///                                           torques and axes included
///
/// D > most if and only if, over some stretch of time of any length L, the device gave more than most (1 + L/window). So a
/// spring that stores no more than `most` never exceeds it, however it is pressed and released, and neither does any passive
/// load; a loop that continuously gives more than the power P exceeds it. Energy that the hand has put in and that was dissipated,
/// for example by friction, does not count as credit.
///
/// After the passivity observer of Hannaford & Ryu 2002, which never forgets: there, ten minutes of braking would allow a loop
/// to be active for just as long.
class EnergyWatch
{
public:
    /// A window that is not finite lasts forever. [main thread]
    void prepare (double most_j, double window_s) noexcept
    {
        delivered = 0.0;
        allow (most_j, window_s);
    }

    /// Changes the allowance, and keeps what was counted. [tick thread]
    void allow (double most_j, double window_s) noexcept
    {
        power = std::isfinite (window_s) ? most_j / window_s : 0.0;
        if (! std::isfinite (power)) power = 0.0;
    }

    /// D in J, after the device has done this work in this time. [tick thread]
    double operator() (double work_j, double elapsed_s) noexcept
    {
        const double sum = delivered + work_j - power * elapsed_s;
        if (sum != sum) return std::numeric_limits<double>::infinity();
        return delivered = std::max (0.0, sum);
    }

    void serialize (auto& archive) { archive (delivered); }

private:
    double delivered = 0.0, power = 0.0;   // in J and W
};

}   // namespace tactus
