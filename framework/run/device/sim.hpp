// SPDX-License-Identifier: MIT
#pragma once

#include "flexible_tool.hpp"
#include "path.hpp"
#include "rigid_tool.hpp"
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

    double mass = 0.1;                  ///< kg, > 0
    double damping = 1.0;               ///< of the mechanics, in N s/m
    double quantum = 0.0;               ///< resolution of the position, in m; 0: exact
    double force_quantum = 0.0;         ///< resolution of the force, in N; 0: exact
    int delay = 0;                      ///< delay of the force in ticks
    double coulomb = 0.0;               ///< Coulomb friction of the mechanics, in N
    double first_mode = 0.0;            ///< first resonance of the structure, in Hz; 0: a rigid tool
    double first_mode_damping = 0.05;   ///< damping ratio of the first resonance
    double end_mass = 0.0;              ///< part of the mass that is at the tool, on the far side of the structure, in kg, < mass; 0: half of it
    double brake = 0.0;                 ///< largest damping of a brake on a rigid tool, in N s/m; 0: no brake
    double brake_time = 0.0;            ///< time constant with which the brake follows what it is asked for, in s
    Vec3 position = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
    Vec3 rotation = Vec3::Zero();     ///< constant; torque is accepted but has no effect
    Vec3 hand_force = Vec3::Zero();   ///< constant, in N
    Hand hand {};
    std::vector<Axis> axes {};   ///< at most Channels::most
    int signal_outputs = 0;      ///< channels that are accepted but have no effect
};

/// In ticks. A longer delay would last for seconds, and must be a mistake.
inline constexpr int longest_delay = 10'000;

/// In Hz. With a higher resonance, the tool would move like a rigid one.
inline constexpr double highest_first_mode = 1e6;

/// The mass at the tool if the structure bends, in kg.
inline double endMassOf (const Simulation& sim) noexcept { return sim.end_mass > 0.0 ? sim.end_mass : 0.5 * sim.mass; }

/// A tool of mass M with viscous damping B and Coulomb friction, pushed by the graph's force and by a hand. Both forces are held
/// from tick to tick, as by an amplifier, and the motion in between is solved exactly (RigidTool), so energy changes only through
/// the physics of a sampled loop, not through integration errors.
///
/// With a `first_mode`, the tool is a structure that bends (FlexibleTool): the graph's force acts on the motor, where the sensor is
/// and where damping and friction act; the hand acts on the end, and true position and velocity are those of the end. Without a
/// `first_mode`, motor and end are the same.
///
/// On each tick, read() reports the position, rounded half up to the quantum. write() takes the guarded force, rounds it to the
/// force quantum, and moves the tool by one tick under the force from `delay` ticks ago (0 at first) and that of the hand. The brake
/// damps by what it was asked for `delay` ticks ago, at most `brake`, with the lag of its coil (brake_time). The
/// hand's force is not delayed, because the hand is at the tool. It is computed from the true motion at the tick.
///
/// Good to know
///  - A force that is not a number counts as 0. The state stays finite as long as the loop is stable.
///  - The forces of the hand's spring and damper are held for a tick, like any force, so a hand with damping > 2M/T - B makes the
///    tool oscillate on its own. A hand of infinite stiffness takes the tool exactly along its path, whatever the force.
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

    bool serialize (StateArchive&) override;

    const Simulation& simulation() const noexcept { return what; }

private:
    struct MovingAxis
    {
        HeldStep step;
        double x, v = 0.0;
    };

    struct Sent
    {
        Vec3 force = Vec3::Zero();   // N
        double brake = 0.0;          // N s/m
    };

    Sent delayed (const Sent&) noexcept;
    Vec3 handForce() const noexcept;

    bool bends() const noexcept { return what.first_mode > 0.0; }
    Vec3 motor() const noexcept { return bends() ? flexible.motor() : rigid.position(); }
    Vec3 end() const noexcept { return bends() ? flexible.end() : rigid.position(); }
    Vec3 endVelocity() const noexcept { return bends() ? flexible.endVelocity() : rigid.velocity(); }

    Simulation what;
    double dt = 1e-3;
    RigidTool rigid { 1.0, 0.0, 0.0, dt };
    FlexibleTool flexible;          // used instead of `rigid` if there is a first mode
    std::vector<MovingAxis> axes;   // in the order of what.axes
    std::vector<Sent> on_the_way;   // what was sent in the last `delay` ticks
    double braking = 0.0;           // damping of the brake, in N s/m
    double brake_share = 1.0;       // how much of the way to what it was asked for the brake goes in a tick
    std::size_t oldest = 0;
    std::int64_t tick = 0;
};

}   // namespace tactus
