// SPDX-License-Identifier: MIT
#include "sim.hpp"

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

/// (1 - e^-h)/h, accurate to the last digits even if h is tiny or 0.
double firstOrder (double h) noexcept { return h == 0.0 ? 1.0 : -std::expm1 (-h) / h; }

/// (h - (1 - e^-h))/h^2. The difference loses as many digits as h has leading zeros, so a small h uses the series 1/2! - h/3! +
/// h^2/4! - ...; at h = 1/4, both are accurate to the second-to-last digit.
double secondOrder (double h) noexcept
{
    if (h > 0.25) return (h + std::expm1 (-h)) / (h * h);

    double sum = 0.0;
    for (int n = 14; n >= 2; --n)
        sum = (1.0 - h * sum) / n;
    return sum;
}
}   // namespace

SimulatedDevice::Step::Step (double mass, double damping, double dt_s) noexcept
{
    const double h = damping * dt_s / mass;
    x_per_v = dt_s * firstOrder (h);
    x_per_f = dt_s * dt_s / mass * secondOrder (h);
    v_loss = std::expm1 (-h);
    v_per_f = dt_s / mass * firstOrder (h);
}

SimulatedDevice::SimulatedDevice (Simulation simulation) : what (std::move (simulation)) { prepare (dt); }

void SimulatedDevice::prepare (double dt_s)
{
    dt = dt_s;

    step = Step (what.mass, what.damping, dt);
    axes.clear();
    for (const auto& axis : what.axes)
        axes.push_back ({ Step (axis.mass, axis.damping, dt), axis.position });
    on_the_way.assign (static_cast<std::size_t> (what.delay), Vec3::Zero());
    oldest = 0;
    x = what.position;
    v = what.velocity;
    tick = 0;
}

Reading SimulatedDevice::read() noexcept
{
    Reading reading;
    reading.position = rounded (x, what.quantum);
    reading.rotation = what.rotation;
    reading.valid = isFinite (x, v);
    reading.true_position = x;
    reading.true_velocity = v;
    for (std::size_t i = 0; i < axes.size(); ++i)
        reading.axes.set (static_cast<int> (i), axes[i].x);
    return reading;
}

void SimulatedDevice::write (const Effort& guarded) noexcept
{
    Vec3 sent = rounded (guarded.force, what.force_quantum);
    if (! isFinite (sent)) sent.setZero();
    const Vec3 force = delayed (sent) + handForce();

    step (x, v, force);
    for (std::size_t i = 0; i < axes.size(); ++i)
    {
        const auto& axis = what.axes[i];
        auto& [moves, at, speed] = axes[i];
        moves (at, speed, finiteOrZero (guarded.axes[static_cast<int> (i)]) + axis.hand_force - axis.stiffness * (at - axis.position));
    }
    ++tick;
}

DeviceLayout SimulatedDevice::layout() const
{
    DeviceLayout has { .signal_outputs = what.signal_outputs, .mass = what.mass, .damping = what.damping };
    for (const auto& axis : what.axes)
        has.axes.push_back (axis.name);
    has.efforts = has.axes;
    return has;
}

Vec3 SimulatedDevice::delayed (const Vec3& force) noexcept
{
    if (on_the_way.empty()) return force;

    const Vec3 due = std::exchange (on_the_way[oldest], force);
    oldest = (oldest + 1) % on_the_way.size();
    return due;
}

Vec3 SimulatedDevice::handForce() const noexcept
{
    if (! what.hand.path) return what.hand_force;

    const auto [position, velocity] = what.hand.path->at (static_cast<double> (tick) * dt);
    return what.hand_force + what.hand.stiffness * (position - x) + what.hand.damping * (velocity - v);
}

}   // namespace tactus
