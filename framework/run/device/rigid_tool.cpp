// SPDX-License-Identifier: MIT
#include "rigid_tool.hpp"

#include <tactus/kit/math/math.hpp>

#include <cmath>
#include <limits>

namespace tactus
{
namespace
{
/// The time after which a constant force against the motion stops a mass: the zero of v(t), with z = B v/brake,
/// t = (M v/brake) ln (1 + z)/z. Infinite if the force does not brake.
double stoppingTime (double mass, double damping, double speed, double brake) noexcept
{
    if (! (brake > 0.0)) return std::numeric_limits<double>::infinity();
    const double z = damping * speed / brake;
    return mass * speed / brake * (z > 0.0 ? math::log1p (z) / z : 1.0);
}
}   // namespace

void RigidTool::step (const Vec3& force, double brake) noexcept
{
    const auto& tick = brake == 0.0 ? whole : HeldStep (m, b + brake, dt);
    if (friction == 0.0) return tick (x, v, force);
    for (int i = 0; i < 3; ++i)
        slide (x[i], v[i], force[i], b + brake, tick);
}

void RigidTool::slide (double& position, double& velocity, double force, double damping, const HeldStep& whole_tick) const noexcept
{
    double left = dt;
    if (velocity != 0.0)
    {
        const double way = velocity > 0.0 ? 1.0 : -1.0;
        const double stop = stoppingTime (m, damping, std::abs (velocity), friction - way * force);
        if (! (stop < dt)) return whole_tick (position, velocity, force - way * friction);
        HeldStep (m, damping, stop) (position, velocity, force - way * friction);
        velocity = 0.0;
        left -= stop;
    }
    if (std::abs (force) > friction) HeldStep (m, damping, left) (position, velocity, force > 0.0 ? force - friction : force + friction);
}

}   // namespace tactus
