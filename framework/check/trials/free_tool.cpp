// SPDX-License-Identifier: MIT
#include "free_tool.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace tactus::check
{

namespace
{
double valueOf (const DeviceNumbers::Number& n) noexcept { return n ? n->value : 0.0; }

double rounded (double v, double quantum) noexcept { return quantum > 0.0 ? quantum * std::floor (v / quantum + 0.5) : v; }

/// A speed after dry friction, which lowers it by at most this much.
double slowed (double v, double by) noexcept
{
    return v > by ? v - by : v < -by ? v + by
                                     : 0.0;
}
}   // namespace

FreeTool::FreeTool (const DeviceNumbers& n, const DeviceLayout& layout_of, const Simulation* simulated, double rate_hz)
    : numbers (n), has (layout_of), period_s (1.0 / rate_hz), dry (valueOf (n.coulomb)), quantum (valueOf (n.quantum)),
      force_quantum (valueOf (n.force_quantum)),
      bends (n.first_mode && std::isfinite (n.first_mode->value))
{
    has.mechanics = { n.mass->value, n.damping->value };
    on_the_way.resize (static_cast<std::size_t> (valueOf (n.delay)));
    free_axes.resize (has.axes.size());
    if (simulated == nullptr) return;
    if (simulated->brake_time > 0.0) brake_share = -std::expm1 (-period_s / simulated->brake_time);
    for (std::size_t i = 0; i < free_axes.size() && i < simulated->axes.size(); ++i)
    {
        const auto& axis = simulated->axes[i];
        free_axes[i] = { .mass = axis.mass, .damping = axis.damping, .stiffness = axis.stiffness, .rest = axis.position, .moves = true };
    }
}

void FreeTool::hold (const Reading& at) noexcept
{
    is_free = false;
    now = at;
    home = at.true_position;
    for (int i = 0; i < 3; ++i)
        now.position[i] = rounded (home[i], quantum);
    for (auto& track : moving)
        track = {};
    for (std::size_t i = 0; i < free_axes.size(); ++i)
        free_axes[i].x = free_axes[i].home = at.axes[static_cast<int> (i)];
    std::ranges::fill (on_the_way, got);
    braking = std::clamp (got.brake, 0.0, has.brake);
}

void FreeTool::letGo (const Start& s)
{
    start = s;
    is_free = true;
    for (int i = 0; i < 3 && s.moves; ++i)
        moving[static_cast<std::size_t> (i)] = { s.off[i], s.speed[i], s.off[i], s.speed[i] };
    for (std::size_t i = 0; i < free_axes.size(); ++i)
    {
        auto& axis = free_axes[i];
        axis.v = 0.0;
        axis.push = i < s.axis_push.size() ? s.axis_push[i] : 0.0;
        if (axis.moves) axis.x = axis.home + s.axis_off;
    }
    if (! bends)
    {
        const double loss = (numbers.damping->value + s.hand.damping + has.brake) / (numbers.mass->value + s.hand.mass) * period_s;
        parts = std::clamp (static_cast<int> (std::ceil (8.0 * loss)), dry > 0.0 || s.hand.stiffness > 0.0 ? 4 : 1, 32);
        return;
    }
    parts = std::max (dry > 0.0 ? 8 : 1, static_cast<int> (std::ceil (16.0 * numbers.first_mode->value * period_s)));
    if (dry == 0.0) parts = 1;
    const double part_s = period_s / parts;
    slips = heldMotion (numbers, part_s, s.hand);
    const double end = numbers.end_mass ? numbers.end_mass->value : 0.5 * numbers.mass->value, turn = 2.0 * std::numbers::pi * numbers.first_mode->value;
    constexpr double usual_ratio = 0.05;
    k = turn * turn * end;
    c = 2.0 * (numbers.first_mode_damping ? numbers.first_mode_damping->value : usual_ratio) * turn * end;
    DeviceNumbers alone;
    alone.mass = DeviceNumber { .value = end };
    alone.damping = DeviceNumber { .value = c };
    auto hand = s.hand;
    hand.stiffness += k;
    sticks = heldMotion (alone, part_s, hand);
}

Reading FreeTool::read() noexcept
{
    if (! is_free) return now;
    for (int i = 0; i < 3; ++i)
    {
        const auto& track = moving[static_cast<std::size_t> (i)];
        now.position[i] = rounded (home[i] + track.x, quantum);
        now.true_position[i] = home[i] + track.y;
        now.true_velocity[i] = track.w;
    }
    for (std::size_t i = 0; i < free_axes.size(); ++i)
        now.axes.set (static_cast<int> (i), free_axes[i].x);
    now.valid = isFinite (now.position);
    return now;
}

void FreeTool::write (const Effort& sent) noexcept
{
    got = sent;
    for (int i = 0; i < 3; ++i)
        got.force[i] = std::isfinite (sent.force[i]) ? rounded (sent.force[i], force_quantum) : 0.0;
    if (! is_free) return;
    Effort due = got;
    if (! on_the_way.empty())
    {
        due = std::exchange (on_the_way[oldest], got);
        oldest = (oldest + 1) % on_the_way.size();
    }
    arrived = due;
    arrived.axes = got.axes;   // neither late nor rounded, as in a simulated device
    braking += brake_share * (std::clamp (std::isfinite (due.brake) ? due.brake : 0.0, 0.0, has.brake) - braking);
    for (int i = 0; i < 3 && start.moves; ++i)
    {
        auto& track = moving[static_cast<std::size_t> (i)];
        bends ? moveBending (track, due.force[i] + start.push[i]) : moveRigid (track, due.force[i], start.push[i]);
    }
    for (std::size_t i = 0; i < free_axes.size(); ++i)
        if (free_axes[i].moves) moveAxis (free_axes[i], arrived.axes[static_cast<int> (i)]);
}

/// Velocity Verlet with an implicit damper. Its error in a loop is of second order in a part of a tick.
void FreeTool::moveRigid (Track& t, double force, double push) const noexcept
{
    const double h = period_s / parts, mass = numbers.mass->value + start.hand.mass, b = numbers.damping->value + start.hand.damping + braking;
    const double heavy = mass + 0.5 * h * b, light = mass - 0.5 * h * b;
    for (int i = 0; i < parts; ++i)
    {
        const double middle = t.x + 0.5 * h * t.v;
        t.v = slowed ((light * t.v + h * (force + push - start.hand.stiffness * middle)) / heavy, h * dry / heavy);
        t.x = middle + 0.5 * h * t.v;
    }
    t.y = t.x;
    t.w = t.v;
}

/// Moves motor and end. The end counts from where the constant push alone would hold it, so the push may act at the motor.
void FreeTool::moveBending (Track& t, double force) const noexcept
{
    for (int i = 0; i < parts; ++i)
    {
        const double pulls = force + k * (t.y - t.x) + c * t.w;
        if (dry > 0.0 && t.v == 0.0 && std::abs (pulls) <= dry)
        {
            const Eigen::Vector3d before { t.y, t.w, k * t.x };
            const Eigen::Vector2d after = sticks * before;
            t.y = after[0];
            t.w = after[1];
            continue;
        }
        const double way = t.v != 0.0 ? t.v : pulls;
        Eigen::Matrix<double, 5, 1> before;
        before << t.x, t.v, t.y, t.w, force - std::copysign (dry, way);
        const Eigen::Vector4d after = slips * before;
        t = { after[0], after[1], after[2], after[3] };
        if (dry > 0.0 && t.v * way < 0.0) t.v = 0.0;
    }
}

void FreeTool::moveAxis (Axis& axis, double force) const noexcept
{
    const double f = std::isfinite (force) ? force : 0.0;
    constexpr int fine = 4;
    const double h = period_s / fine, heavy = axis.mass + 0.5 * h * axis.damping, light = axis.mass - 0.5 * h * axis.damping;
    for (int i = 0; i < fine; ++i)
    {
        const double middle = axis.x + 0.5 * h * axis.v;
        axis.v = (light * axis.v + h * (f + axis.push - axis.stiffness * (middle - axis.rest))) / heavy;
        axis.x = middle + 0.5 * h * axis.v;
    }
}

}   // namespace tactus::check
