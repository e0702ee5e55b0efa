// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/math/math.hpp>
#include <tactus/node/device.hpp>

#include <algorithm>
#include <cmath>

namespace tactus
{

/// Keeps the effort on a device free of steps when another plan takes over. The wanted effort e becomes
///
///     e + (e0 - e1) w(t)        w = (1 + cos (pi t / F)) / 2 for 0 <= t <= F, then 0
///
/// where e0 is the last effort before the switch and e1 the first one after it. So the first effort is e0 again, and each tick adds at most
/// |e0 - e1| pi T / (2 F) to the steps of e. No component becomes larger than in both e0 and e, and no force or torque longer: the fade
/// into a vibration that begins at a crest would add to the next crests, beyond any ceiling. Unlike a crossfade, this does not tick the
/// nodes twice. F is fall_s if the effort only falls: no component of force and torque, and no axis, becomes larger or turns around. Else
/// it is rise_s: within fall_s, a preset that is added under a pressed tool kicks.
/// If nodes begin with the plan, the device gets e0 for settle_s first: a wall that begins around the tool takes some ticks to push it out.
class Bumpless
{
public:
    static constexpr double fall_s = 0.010, rise_s = 0.100, settle_s = 0.005;

    void prepare (double dt_s) noexcept   // [main thread]
    {
        const auto ticks = [dt_s] (double s) { return std::max (1, static_cast<int> (std::lround (s / dt_s))); };
        fall = ticks (fall_s);
        settle = ticks (settle_s);
        now = length = rise = ticks (rise_s);
    }

    void begin (bool has_new_nodes) noexcept   // [tick thread]
    {
        if (has_new_nodes && now >= settle) waits = settle;   // so edits that come all the time do not keep the effort where it is
        now = 0;
    }

    const Effort& operator() (const Effort& wanted) noexcept   // [tick thread]
    {
        if (waits > 0)
        {
            --waits;
            return last;
        }
        return now == length ? last = wanted : fade (wanted);
    }

    /// The guard has applied a different effort to the device, so there is nothing left to fade. [tick thread]
    void stop (const Effort& applied) noexcept
    {
        waits = 0;
        now = length;
        last = applied;
    }

    void serialize (auto& archive)
    {
        archive (difference, before, last);
        archive.index (length, static_cast<std::size_t> (rise) + 1);
        archive.index (now, static_cast<std::size_t> (length) + 1);
        archive.index (waits, static_cast<std::size_t> (settle) + 1);
    }

private:
    static constexpr double pi = 3.14159265358979323846;

    const Effort& fade (const Effort& wanted) noexcept
    {
        if (now == 0)
        {
            before = last;
            difference = { last.force - wanted.force, last.torque - wanted.torque, sum (last.axes, -1.0, wanted.axes),
                           sum (last.signals, -1.0, wanted.signals), last.brake - wanted.brake };
            if (! isFinite (difference.force, difference.torque, difference.axes, difference.signals, difference.brake))
            {
                now = length;
                return last = wanted;
            }
            length = falls (last, wanted) ? fall : rise;
            ++now;
            return last;   // no step at all: wanted + (last - wanted) would round
        }
        const double w = 0.5 + 0.5 * math::cos (pi * now / length);
        ++now;
        last = { within (wanted.force + w * difference.force, before.force, wanted.force),
                 within (wanted.torque + w * difference.torque, before.torque, wanted.torque),
                 within (sum (wanted.axes, w, difference.axes), before.axes, wanted.axes),
                 within (sum (wanted.signals, w, difference.signals), before.signals, wanted.signals), wanted.brake + w * difference.brake };
        return last;
    }

    static bool falls (const Effort& from, const Effort& to) noexcept
    {
        const auto falls = [] (double a, double b) { return std::abs (b) <= std::abs (a) && a * b >= 0.0; };
        for (int i = 0; i < 3; ++i)
            if (! falls (from.force[i], to.force[i]) || ! falls (from.torque[i], to.torque[i])) return false;
        for (int i = 0; i < std::max (from.axes.size(), to.axes.size()); ++i)
            if (! falls (from.axes[i], to.axes[i])) return false;
        return true;
    }

    /// The value, limited to the larger one of two others.
    static double within (double v, double a, double b) noexcept
    {
        const double most = std::max (std::abs (a), std::abs (b));
        return std::clamp (v, -most, most);
    }

    static Vec3 within (const Vec3& v, const Vec3& a, const Vec3& b) noexcept
    {
        const Vec3 each { within (v.x(), a.x(), b.x()), within (v.y(), a.y(), b.y()), within (v.z(), a.z(), b.z()) };
        const double longest = std::max (a.norm(), b.norm()), now = each.norm();
        return now > longest ? Vec3 (each * (longest / now)) : each;
    }

    static Channels within (Channels v, const Channels& a, const Channels& b) noexcept
    {
        for (int i = 0; i < v.size(); ++i)
            v.set (i, within (v[i], a[i], b[i]));
        return v;
    }

    /// a + w b
    static Channels sum (const Channels& a, double w, const Channels& b) noexcept
    {
        Channels all;
        for (int i = 0; i < std::max (a.size(), b.size()); ++i)
            all.set (i, a[i] + w * b[i]);
        return all;
    }

    int fall = 1, rise = 1, settle = 1;   // in ticks
    int waits = 0;                        // ticks until the fade begins
    int length = 1, now = length;         // duration of the fade, and time since it began, in ticks; equal if there is no fade
    Effort difference, before;            // e0 - e1, and e0
    Effort last;
};

}   // namespace tactus
