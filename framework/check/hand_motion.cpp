// SPDX-License-Identifier: MIT
#include "hand_motion.hpp"

#include <tactus/run/engine.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace tactus::check
{

HandMotion recordMotion (std::shared_ptr<Plan> plan, std::span<const Hand> hands, std::size_t ticks)
{
    HandMotion motion { .rate_hz = plan->rateHz(), .ticks = ticks };
    for (const auto& role : plan->roles())
    {
        motion.roles.push_back ({ .role = role.name });
        motion.roles.back().readings.reserve (ticks);
    }
    Engine engine { std::move (plan) };
    for (const auto& hand : hands)
        if (const auto at = std::ranges::find (motion.roles, hand.role, &RoleMotion::role); at != motion.roles.end())
        {
            engine.attach (hand.role, hand.device);
            at->layout = hand.device.layout();
        }
    for (std::size_t k = 0; k < ticks; ++k)
    {
        engine.tick();
        for (std::size_t r = 0; r < motion.roles.size(); ++r)
            motion.roles[r].readings.push_back (engine.plan().roles()[r].state->reading);
    }
    return motion;
}

HandMotion atRate (const HandMotion& motion, double rate_hz)
{
    const auto ticks = static_cast<double> (motion.ticks) * rate_hz / motion.rate_hz;
    HandMotion other { .rate_hz = rate_hz, .ticks = std::max<std::size_t> (1, static_cast<std::size_t> (ticks)) };
    for (const auto& role : motion.roles)
    {
        auto& to = other.roles.emplace_back (RoleMotion { .role = role.role, .layout = role.layout });
        for (std::size_t k = 0; k < other.ticks; ++k)
        {
            const double tick = static_cast<double> (k) * motion.rate_hz / rate_hz;
            const auto before = std::min (static_cast<std::size_t> (tick), role.readings.size() - 1), after = std::min (before + 1, role.readings.size() - 1);
            auto reading = role.readings[before];
            const double part = tick - static_cast<double> (before);
            reading.position += part * (role.readings[after].position - reading.position);
            reading.true_position += part * (role.readings[after].true_position - reading.true_position);
            to.readings.push_back (std::move (reading));
        }
    }
    return other;
}

HandMotion withAxes (const HandMotion& motion, const Plan& plan)
{
    HandMotion all = motion;
    const auto& nodes = plan.flat().nodes;
    const auto uses = [&] (const std::string& role, std::string_view type, const std::string& axis) {
        return std::ranges::any_of (nodes, [&] (const plan::FlatNode& node) {
            return node.runs() && node.role == role && node.type->info.id == type && std::ranges::any_of (node.settings, [&] (const auto& value) {
                       const auto* name = std::get_if<std::string> (&value);
                       return name != nullptr && *name == axis;
                   });
        });
    };
    for (std::size_t r = 0; r < motion.roles.size(); ++r)
    {
        const auto& from = motion.roles[r];
        for (std::size_t i = 0; i < from.layout.axes.size(); ++i)
        {
            const auto& name = from.layout.axes[i];
            const int pushed = indexOf (from.layout.efforts, name);
            if (pushed < 0 || ! uses (from.role, "device.axis", name) || ! uses (from.role, "device.effort", name)) continue;
            RoleMotion axis { .role = from.role, .axis = DrivenAxis { .name = name, .owner = r, .read = static_cast<int> (i), .pushed = pushed } };
            for (const auto& reading : from.readings)
            {
                const Vec3 at { reading.axes[axis.axis->read], 0.0, 0.0 };
                axis.readings.push_back ({ .position = at, .true_position = at });
            }
            all.roles.push_back (std::move (axis));
        }
    }
    return all;
}

Messages divergence (const HandMotion& motion, std::span<const Reach> reaches)
{
    Messages all;
    for (const auto& role : motion.roles)
    {
        const auto reach = std::ranges::find (reaches, role.role, &Reach::role);
        const auto isAway = [&] (const Reading& reading) {
            const Vec3& p = reading.position;
            if (! p.allFinite()) return true;
            if (reach == reaches.end()) return (p - role.readings.front().position).norm() > farthest_m;
            const Vec3 inside = p.cwiseMax (reach->min).cwiseMin (reach->max);
            return (p - inside).norm() > (reach->max - reach->min).norm();
        };
        const auto at = std::ranges::find_if (role.readings, isAway);
        if (at == role.readings.end()) continue;
        char time[32];
        std::snprintf (time, sizeof time, "%.3g", static_cast<double> (at - role.readings.begin()) / motion.rate_hz);
        all.push_back (Message::error ("check/diverged", "/devices/" + role.role,
                                       "the tool of '" + role.role + "' runs away at " + time + " s, so slopes along its motion mean nothing",
                                       "the graph is unstable with this hand: make its forces weaker, or check it along --device " + role.role
                                           + "=gesture:NAME or --sweep"));
    }
    return all;
}

void SweepDevice::prepare (double dt_s)
{
    dt = dt_s;
    tick = 0;
}

Reading SweepDevice::read() noexcept
{
    // The number of periods of each axis in `lasts`. They have no common factor, so the curve closes only after `lasts` and crosses the box
    // along many lines.
    constexpr double periods[] { 13.0, 11.0, 8.0 };
    const double turn = 2.0 * std::numbers::pi * static_cast<double> (tick++) * dt / lasts;
    Reading reading;
    for (int i = 0; i < 3; ++i)
        reading.position[i] = 0.5 * (min[i] + max[i]) + 0.5 * (max[i] - min[i]) * std::cos (periods[i] * turn);
    reading.true_position = reading.position;
    return reading;
}

}   // namespace tactus::check
