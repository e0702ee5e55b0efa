// SPDX-License-Identifier: MIT
#include "engine.hpp"

#include <algorithm>
#include <stdexcept>

namespace tactus
{

namespace
{
std::size_t indexOf (const Plan& plan, std::string_view role)
{
    const auto at = std::ranges::find (plan.roles, role, &Plan::RoleUse::name);
    if (at == plan.roles.end()) throw std::out_of_range ("the plan has no role '" + std::string (role) + "'");
    return static_cast<std::size_t> (at - plan.roles.begin());
}

/// What all sinks of a role ask for together, whatever their order.
Effort total (const Plan::RoleUse& role, double* scratch) noexcept
{
    if (role.sinks.size() == 1) return role.sinks[0].effort (role.sinks[0].node);

    Effort sum;
    for (int c = 0; c < 6; ++c)
    {
        int n = 0;
        for (const auto& sink : role.sinks)
        {
            const auto e = sink.effort (sink.node);
            scratch[n++] = c < 3 ? e.force[c] : e.torque[c - 3];
        }
        (c < 3 ? sum.force[c] : sum.torque[c - 3]) = plan::sum (scratch, n);
    }
    return sum;
}
}   // namespace

Engine::Engine (std::shared_ptr<Plan> p) : current (std::move (p)), attached (current->roles.size())
{
    for (std::size_t i = 0; i < attached.size(); ++i)
    {
        attached[i].guard.prepare ({}, 1.0 / current->rate_hz);
        attached[i].scratch.resize (current->roles[i].sinks.size());
    }
}

void Engine::attach (std::string_view role, Device& device, const GuardLimits& limits)
{
    auto& a = attached[indexOf (*current, role)];
    a.device = &device;
    a.guard.prepare (limits, 1.0 / current->rate_hz);
    device.prepare (1.0 / current->rate_hz);
}

void Engine::tick() noexcept
{
    for (std::size_t i = 0; i < attached.size(); ++i)
        if (attached[i].device) current->roles[i].state->reading = attached[i].device->read();

    current->tick();

    for (std::size_t i = 0; i < attached.size(); ++i)
    {
        auto& role = current->roles[i];
        role.state->applied = attached[i].guard (total (role, attached[i].scratch.data()), role.state->reading);
        if (attached[i].device) attached[i].device->write (role.state->applied);
    }
    ++ticks;
}

void Engine::halt() noexcept
{
    for (auto& a : attached)
        a.guard.halt();
}

bool Engine::isAtRest() const noexcept
{
    return std::ranges::all_of (attached, [] (const Attached& a)
                                { return a.guard.isAtRest(); });
}

const Guard& Engine::guardOf (std::string_view role) const { return attached[indexOf (*current, role)].guard; }

}   // namespace tactus
