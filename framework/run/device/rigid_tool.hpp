// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/signal/held_step.hpp>
#include <tactus/kit/vec3.hpp>

namespace tactus
{

/// A rigid tool with viscous damping and Coulomb friction, solved exactly while the force is held:
///
///     M v' = F - (B + brake) v - f_f sgn (v)
///
/// Each axis is solved on its own, with its own dry friction, as if it had its own motor. With friction, an axis stops at most once
/// per tick, at a time that has a closed form, and then sticks (|F| <= f_f) or moves on in the direction of the force.
class RigidTool
{
public:
    /// The mass is in kg (> 0), the damping in N s/m, the Coulomb friction in N.
    RigidTool (double mass, double damping, double coulomb, double dt_s) noexcept
        : m (mass), b (damping), friction (coulomb), dt (dt_s), whole (mass, damping, dt_s)
    {
    }

    void start (const Vec3& position, const Vec3& velocity) noexcept
    {
        x = position;
        v = velocity;
    }

    /// Moves the tool by one tick under a held force, in N, and with a brake that damps by this much, in N s/m.
    void step (const Vec3& force, double brake = 0.0) noexcept;

    const Vec3& position() const noexcept { return x; }
    const Vec3& velocity() const noexcept { return v; }

    void serialize (auto& archive) { archive (x, v); }

private:
    void slide (double& position, double& velocity, double force, double damping, const HeldStep& whole_tick) const noexcept;

    double m, b, friction, dt;
    HeldStep whole;   // for a whole tick
    Vec3 x = Vec3::Zero(), v = Vec3::Zero();
};

}   // namespace tactus
