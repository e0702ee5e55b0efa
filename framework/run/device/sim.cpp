// SPDX-License-Identifier: MIT
#include "sim.hpp"

#include <tactus/kit/math/math.hpp>
#include <tactus/kit/state_archive.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus
{
namespace
{
Vec3 rounded (const Vec3& value, double quantum) noexcept
{
    if (quantum == 0.0) return value;
    return quantum * (value / quantum + Vec3::Constant (0.5)).array().floor().matrix();
}

FlexibleTool::Properties structureOf (const Simulation& sim)
{
    const double end_mass = endMassOf (sim);
    return { .motor_mass = sim.mass - end_mass,
             .end_mass = end_mass,
             .damping = sim.damping,
             .coulomb = sim.coulomb,
             .first_mode_hz = sim.first_mode,
             .first_mode_damping = sim.first_mode_damping };
}
}   // namespace

SimulatedDevice::SimulatedDevice (Simulation simulation) : what (std::move (simulation)) { prepare (dt); }

void SimulatedDevice::prepare (double dt_s)
{
    dt = dt_s;

    rigid = RigidTool (what.mass, what.damping, what.coulomb, dt);
    rigid.start (what.position, what.velocity);
    if (bends()) flexible = FlexibleTool (structureOf (what), dt);
    flexible.start (what.position, what.velocity);
    axes.clear();
    for (const auto& axis : what.axes)
        axes.push_back ({ HeldStep (axis.mass, axis.damping, dt), axis.position });
    on_the_way.assign (static_cast<std::size_t> (what.delay), Sent {});
    braking = 0.0;
    brake_share = what.brake_time > 0.0 ? -math::expm1 (-dt / what.brake_time) : 1.0;
    oldest = 0;
    tick = 0;
}

Reading SimulatedDevice::read() noexcept
{
    Reading reading;
    reading.true_position = end();
    reading.true_velocity = endVelocity();
    reading.position = rounded (motor(), what.quantum);
    reading.rotation = what.rotation;
    reading.valid = isFinite (motor(), reading.true_position, reading.true_velocity);
    for (std::size_t i = 0; i < axes.size(); ++i)
        reading.axes.set (static_cast<int> (i), axes[i].x);
    return reading;
}

void SimulatedDevice::write (const Effort& guarded) noexcept
{
    Vec3 sent = rounded (guarded.force, what.force_quantum);
    if (! isFinite (sent)) sent.setZero();
    const auto [from_graph, asked] = delayed ({ sent, std::clamp (finiteOrZero (guarded.brake), 0.0, what.brake) });
    const bool is_led = what.hand.path && std::isinf (what.hand.stiffness);
    const Vec3 from_hand = is_led ? Vec3 (Vec3::Zero()) : handForce();
    braking += brake_share * (asked - braking);

    if (bends())
        flexible.step (from_graph, from_hand);
    else
        rigid.step (from_graph + from_hand, braking);
    for (std::size_t i = 0; i < axes.size(); ++i)
    {
        const auto& axis = what.axes[i];
        auto& [moves, at, speed] = axes[i];
        moves (at, speed, finiteOrZero (guarded.axes[static_cast<int> (i)]) + axis.hand_force - axis.stiffness * (at - axis.position));
    }
    ++tick;
    if (! is_led) return;
    const auto [position, velocity] = what.hand.path->at (static_cast<double> (tick) * dt);
    rigid.start (position, velocity);
    flexible.start (position, velocity);
}

DeviceLayout SimulatedDevice::layout() const
{
    DeviceLayout has { .signal_outputs = what.signal_outputs, .mechanics = { what.mass, what.damping }, .brake = what.brake };
    for (const auto& axis : what.axes)
        has.axes.push_back (axis.name);
    has.efforts = has.axes;
    return has;
}

SimulatedDevice::Sent SimulatedDevice::delayed (const Sent& now) noexcept
{
    if (on_the_way.empty()) return now;

    const Sent due = std::exchange (on_the_way[oldest], now);
    oldest = (oldest + 1) % on_the_way.size();
    return due;
}

Vec3 SimulatedDevice::handForce() const noexcept
{
    if (! what.hand.path) return what.hand_force;

    const auto [position, velocity] = what.hand.path->at (static_cast<double> (tick) * dt);
    return what.hand_force + what.hand.stiffness * (position - end()) + what.hand.damping * (velocity - endVelocity());
}

bool SimulatedDevice::serialize (StateArchive& archive)
{
    archive (rigid, flexible, braking, on_the_way, tick);
    archive.index (oldest, std::max (on_the_way.size(), std::size_t { 1 }));
    archive.expect (axes.size());
    for (auto& axis : axes)
        archive (axis.x, axis.v);
    if (tick < 0) archive.refuse ("has a device that has not begun");
    return true;
}

}   // namespace tactus
