// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/kit/math/math.hpp>
#include <tactus/kit/threads/snapshot.hpp>
#include <tactus/run/device/path.hpp>

namespace tactus::host
{

/// The position of the mouse or pen as a path. The system reports it about 60 times a second, so it is smoothed: the hand follows it
/// like a critically damped spring, solved exactly from tick to tick.
class PointerPath final : public Path
{
public:
    /// The rate at which the hand follows: it almost arrives within a twentieth of a second.
    static constexpr double follow_rate = 80.0;   // 1/s

    /// The highest speed of the hand. A mouse can leave the surface and enter it at the far side. This must not look as if the tool were torn away:
    /// the guards of presets stop a tool at 2 m/s.
    static constexpr double top_speed = 1.0;   // m/s

    /// Starts at rest.
    explicit PointerPath (const Vec3& start) : target (Target { { start.x(), start.y(), start.z() } }), goal (start), now { start, Vec3::Zero() } {}

    Vec3 place() const noexcept { return now.position; }   ///< of the hand; call when the run is over   [main thread]

    void moveTo (const Vec3& p) noexcept { target.store ({ { p.x(), p.y(), p.z() } }); }   ///< [main thread]

    /// Call with increasing times. [tick thread]
    Point at (double t) const noexcept override
    {
        const double dt = t - last;
        last = t;
        if (! (dt > 0.0)) return now;
        const auto [wanted] = target.load();
        const Vec3 way = Vec3 (wanted.data()) - goal;
        const double length = way.norm(), most = top_speed * dt;
        goal = length > most ? Vec3 (goal + most / length * way) : Vec3 (wanted.data());
        // x = (a + b t) e^(-w t) about the goal.
        const Vec3 offset = now.position - goal, b = now.velocity + follow_rate * offset;
        const double decay = math::exp (-follow_rate * dt);
        now.position = goal + decay * (offset + b * dt);
        now.velocity = decay * (b - follow_rate * (offset + b * dt));
        return now;
    }

    double duration() const noexcept override { return 0.0; }

private:
    struct Target
    {
        std::array<double, 3> position {};   // m
    };

    Snapshot<Target> target;
    mutable Vec3 goal;   // [tick thread] on the way to the target
    mutable Point now;   // [tick thread]
    mutable double last = 0.0;
};

}   // namespace tactus::host
