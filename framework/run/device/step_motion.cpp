// SPDX-License-Identifier: MIT
#include "step_motion.hpp"

#include <tactus/kit/geometry/rotation.hpp>

#include <algorithm>

namespace tactus
{

namespace
{
Quaternion quaternionOf (const Vec3& rotation) noexcept
{
    const double angle = math::hypot (rotation.x(), rotation.y(), rotation.z());
    if (angle == 0.0) return Quaternion { 1.0, 0.0, 0.0, 0.0 };
    const auto [sine, cosine] = math::sinCos (0.5 * angle);
    const Vec3 axis = sine / angle * rotation;
    return Quaternion { cosine, axis.x(), axis.y(), axis.z() };
}

/// The rotation vector of a unit quaternion; at most half a turn.
Vec3 rotationOf (const Quaternion& q) noexcept
{
    const double side = q.w() < 0.0 ? -1.0 : 1.0;
    const Vec3 axis = side * q.vec();
    const double sine = math::hypot (axis.x(), axis.y(), axis.z());
    if (sine == 0.0) return Vec3::Zero();
    return 2.0 * math::atan2 (sine, side * q.w()) / sine * axis;
}

/// This part of the shortest way from one rotation to another.
Vec3 turned (const Vec3& from, const Vec3& to, double part) noexcept
{
    if (from == to) return to;
    const auto start = quaternionOf (from);
    return rotationOf (quaternionOf (part * rotationOf (quaternionOf (to) * start.conjugate())) * start);
}
}   // namespace

void StepMotion::begin (std::size_t ticks_, double period_s) noexcept
{
    ticks = ticks_;
    period = period_s;
    at = taken = 0;
}

Reading StepMotion::move (const Reading& latest, bool is_new, const std::optional<Velocity>& given) noexcept
{
    silent = is_new ? 0.0 : silent + period;
    Reading aged = latest;
    aged.age += silent;
    return moveAged (aged, is_new, given);
}

Reading StepMotion::moveAged (const Reading& latest, bool is_new, const std::optional<Velocity>& given) noexcept
{
    const bool is_first = at == 0, knows_way = has_before && before.valid && latest.valid;
    if (is_first)
    {
        moves = is_new && latest.valid;
        age = latest.age;
        velocity = given.value_or (Velocity {});
        if (! given && knows_way && isInStep())
        {
            const double step_s = static_cast<double> (ticks) * period;
            velocity.linear = (latest.position - before.position) / step_s;
            velocity.angular = rotationOf (quaternionOf (latest.rotation) * quaternionOf (before.rotation).conjugate()) / step_s;
        }
    }
    Reading r = latest;
    if (isInStep() && moves && readings != Readings::hold)
    {
        r.age = age;   // each tick gets a new place of the tool, not a repeated one
        if (readings == Readings::by_velocity)
            lead (r);
        else if (knows_way && at + 1 < ticks)
            blend (r);
    }
    if (! isInStep() || at + 1 == ticks)
    {
        before = latest;
        has_before = true;
    }
    return r;
}

/// The way from the last reading to this one, as far as it has come on this tick.
void StepMotion::blend (Reading& r) const noexcept
{
    const double part = static_cast<double> (at + 1) / static_cast<double> (ticks);
    r.position = before.position + part * (r.position - before.position);
    r.rotation = turned (before.rotation, r.rotation, part);
    for (int i = 0; i < std::min (before.axes.size(), r.axes.size()); ++i)
        r.axes.set (i, before.axes[i] + part * (r.axes[i] - before.axes[i]));
}

/// Where this reading and the velocity lead until this tick.
void StepMotion::lead (Reading& r) const noexcept
{
    if (at == 0) return;
    const double ahead_s = static_cast<double> (at) * period;
    r.position += ahead_s * velocity.linear;
    r.rotation = rotationOf (quaternionOf (ahead_s * velocity.angular) * quaternionOf (r.rotation));
}

void StepMotion::take (const Effort& e) noexcept
{
    if (! isInStep()) taken = 0;
    const bool is_first = taken == 0;
    last = e;
    ++taken;
    if (isInStep()) ++at;
    if (efforts == Efforts::last) return;
    if (is_first)
    {
        sum = e;
        return;
    }
    sum.force += e.force;
    sum.torque += e.torque;
    sum.brake += e.brake;
    for (int i = 0; i < e.axes.size(); ++i)
        sum.axes.set (i, sum.axes[i] + e.axes[i]);
}

Effort StepMotion::effort() const noexcept
{
    if (efforts == Efforts::last || taken < 2) return last;
    const double share = static_cast<double> (taken);
    Effort mean = last;   // its signals
    mean.force = sum.force / share;
    mean.torque = sum.torque / share;
    mean.brake = sum.brake / share;
    for (int i = 0; i < sum.axes.size(); ++i)
        mean.axes.set (i, sum.axes[i] / share);
    return mean;
}

}   // namespace tactus
