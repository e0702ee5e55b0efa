// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/device.hpp>
#include <host/devices/path.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tactus::host
{

/// What a simulated device is made of. SI; the words are those of a device description.
struct Simulation
{
    /// Holds the tool by a spring and a damper, at their other end a hand that follows a path.
    struct Hand
    {
        double stiffness = 0.0;   ///< N/m
        double damping = 0.0;     ///< N s/m
        std::shared_ptr<const Path> path;
    };

    /// Beside the tool, something that slides against a spring, as a trigger does.
    struct Axis
    {
        std::string name;
        double mass = 0.05;        ///< kg, > 0
        double damping = 1.0;      ///< N s/m
        double stiffness = 0.0;    ///< N/m, of a spring that is at rest where the axis starts
        double position = 0.0;     ///< m, at the start
        double hand_force = 0.0;   ///< N, constant
    };

    double mass = 0.1;            ///< kg, > 0
    double damping = 1.0;         ///< N s/m of the mechanics
    double quantum = 0.0;         ///< m, resolution of the position; 0: none
    double force_quantum = 0.0;   ///< N, resolution of the force; 0: none
    int delay = 0;                ///< ticks that a force is late
    double first_mode = 0.0;      ///< Hz, of the structure, for the checks that ask what it leaves to feel; 0: none. Not simulated
    Vec3 position = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
    Vec3 rotation = Vec3::Zero();     ///< kept: torque is accepted and not felt
    Vec3 hand_force = Vec3::Zero();   ///< N, constant
    Hand hand {};
    std::vector<Axis> axes {};   ///< at most Channels::most
    int signal_outputs = 0;      ///< channels that are accepted and not felt
};

/// A tool of mass M with viscous damping B, pushed by the graph's force and by a hand. The total F is held from tick
/// to tick, as an amplifier does, and the motion in between is solved exactly:
///
///     a = e^(-B T/M)     g = M (1 - a)/B
///     x += g v + (T - g)/B F
///     v += (a - 1) v + (1 - a)/B F
///
/// so energy comes and goes only as the physics of a sampled loop says, and not by the integrator's error.
///
/// Per tick: read() tells the position, rounded half up to the quantum; write() takes the guarded force, rounds it to
/// the force quantum, holds that of `delay` ticks ago (0 before the first) together with the hand's, and steps. The
/// hand is not delayed: it is where the tool is. What it does is computed from the true motion at the tick.
///
/// Good to know
///  - A force that is not a number counts as 0; the state stays finite as long as the loop is stable.
///  - The hand's spring and damper are held like any force: a hand with damping > 2M/T - B makes the tool swing by itself.
///  - Axes beside the tool move by the same law, with their own mass and damping; their efforts are neither delayed nor
///    rounded.
///  - duration() is that of the hand's path, 0 without one.
class SimulatedDevice final : public Device
{
public:
    explicit SimulatedDevice (Simulation);

    void prepare (double dt_s) override;   // [main thread] and back to the start
    Reading read() noexcept override;
    void write (const Effort& guarded) noexcept override;
    DeviceLayout layout() const override;
    double duration() const noexcept override { return what.hand.path ? what.hand.path->duration() : 0.0; }

    const Simulation& simulation() const noexcept { return what; }

private:
    /// How a tick of a held force moves a mass, see above.
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
    std::vector<MovingAxis> axes;   // as what.axes
    std::vector<Vec3> on_the_way;   // forces of the last `delay` ticks
    std::size_t oldest = 0;
    Vec3 x = Vec3::Zero(), v = Vec3::Zero();
    std::int64_t tick = 0;
};

}   // namespace tactus::host
