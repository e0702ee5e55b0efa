// SPDX-License-Identifier: MIT
#pragma once

#include "path.hpp"
#include <tactus/node/device.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tactus
{

/// Properties of a simulated device, in SI units. The names are the same as in a device description.
struct Simulation
{
    /// A hand that follows a path and holds the tool by a spring and a damper.
    struct Hand
    {
        double stiffness = 0.0;   ///< N/m
        double damping = 0.0;     ///< N s/m
        std::shared_ptr<const Path> path;
    };

    /// An axis in addition to the tool, such as a trigger that slides against a spring.
    struct Axis
    {
        std::string name;
        double mass = 0.05;        ///< kg, > 0
        double damping = 1.0;      ///< N s/m
        double stiffness = 0.0;    ///< of a spring that is relaxed at the start position, in N/m
        double position = 0.0;     ///< at the start, in m
        double hand_force = 0.0;   ///< constant, in N
    };

    double mass = 0.1;            ///< kg, > 0
    double damping = 1.0;         ///< of the mechanics, in N s/m
    double quantum = 0.0;         ///< resolution of the position, in m; 0: exact
    double force_quantum = 0.0;   ///< resolution of the force, in N; 0: exact
    int delay = 0;                ///< delay of the force in ticks
    double first_mode = 0.0;      ///< first resonance of the structure, in Hz; 0: unknown. For information only: it is not simulated
    Vec3 position = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
    Vec3 rotation = Vec3::Zero();     ///< constant; torque is accepted but has no effect
    Vec3 hand_force = Vec3::Zero();   ///< constant, in N
    Hand hand {};
    std::vector<Axis> axes {};   ///< at most Channels::most
    int signal_outputs = 0;      ///< channels that are accepted but have no effect
};

/// A tool of mass M with viscous damping B, pushed by the graph's force and by a hand. The total force F is held from tick to
/// tick, as by an amplifier, and the motion in between is solved exactly:
///
///     a = e^(-B T/M)     g = M (1 - a)/B
///     x += g v + (T - g)/B F
///     v += (a - 1) v + (1 - a)/B F
///
/// so energy changes only through the physics of a sampled loop, not through integration errors.
///
/// On each tick, read() reports the position, rounded half up to the quantum. write() takes the guarded force, rounds it to the
/// force quantum, holds the force from `delay` ticks ago (0 before the first one) plus the force of the hand, and steps. The
/// hand's force is not delayed, because the hand is at the tool. It is computed from the true motion at the tick.
///
/// Good to know
///  - A force that is not a number counts as 0. The state stays finite as long as the loop is stable.
///  - The forces of the hand's spring and damper are held for a tick, like any force, so a hand with damping > 2M/T - B makes the
///    tool oscillate on its own.
///  - Axes in addition to the tool follow the same law, with their own mass and damping; their efforts are neither delayed nor
///    rounded.
///  - duration() is the duration of the hand's path, or 0 without one.
class SimulatedDevice final : public Device
{
public:
    explicit SimulatedDevice (Simulation);

    void prepare (double dt_s) override;   // resets the motion to its start   [main thread]
    Reading read() noexcept override;
    void write (const Effort& guarded) noexcept override;
    DeviceLayout layout() const override;
    double duration() const noexcept override { return what.hand.path ? what.hand.path->duration() : 0.0; }

    const Simulation& simulation() const noexcept { return what; }

private:
    /// How a force that is held for one tick moves a mass; see above.
    struct Step
    {
        Step (double mass, double damping, double dt_s) noexcept;

        template <typename T>
        void operator() (T& position, T& velocity, const T& force) const noexcept
        {
            position += x_per_v * velocity + x_per_f * force;
            velocity += v_loss * velocity + v_per_f * force;
        }

        double x_per_v, x_per_f, v_loss, v_per_f;   // g, (T - g)/B, a - 1, (1 - a)/B
    };

    struct MovingAxis
    {
        Step step;
        double x, v = 0.0;
    };

    Vec3 delayed (const Vec3& force) noexcept;
    Vec3 handForce() const noexcept;

    Simulation what;
    double dt = 1e-3;
    Step step { 1.0, 0.0, dt };
    std::vector<MovingAxis> axes;   // in the order of what.axes
    std::vector<Vec3> on_the_way;   // forces of the last `delay` ticks
    std::size_t oldest = 0;
    Vec3 x = Vec3::Zero(), v = Vec3::Zero();
    std::int64_t tick = 0;
};

}   // namespace tactus
