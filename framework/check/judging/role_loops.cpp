// SPDX-License-Identifier: MIT
#include "role_loops.hpp"

#include <algorithm>
#include <functional>

namespace tactus::check::judging
{

double RoleLoops::virtualDamping() const
{
    double most = 0.0;
    for (const auto& s : role.slopes)
        most = std::max (most, s.damping);
    return most;
}

double RoleLoops::steepest() const
{
    double most = 0.0;
    for (const auto& s : role.slopes)
        most = std::max (most, s.stiffness);
    return most;
}

Dampers RoleLoops::dampers() const
{
    return { role.dampers, std::ranges::find (demand.nodes, "hold.predictive", &MeasuredNode::type) != demand.nodes.end() };
}

RoleLoops::Load RoleLoops::loadAt (const Slope& s) const
{
    const double b = isOverdamped() ? 0.0 : s.damping, sum = s.stiffness * period_s * (0.5 + delay()) + s.lag + b;
    return { &s, b, sum, isOverdamped() ? sum : exactLoad (s).value_or (sum), (numbers.damping ? numbers.damping->value : 0.0) + s.brake };
}

const std::vector<Jacobian>& RoleLoops::responseAt (const Slope& s) const
{
    static const std::vector<Jacobian> none;
    const auto i = static_cast<std::size_t> (&s - role.slopes.data());
    if (role.slopes.empty() || std::less<> {}(&s, role.slopes.data()) || i >= role.slopes.size()) return none;
    if (own_responses.empty()) findResponses();
    return own_responses[i];
}

std::optional<double> RoleLoops::exactLoad (const Slope& s) const
{
    const auto& response = responseAt (s);
    if (response.empty() || isSlow (demand, numbers)) return std::nullopt;
    const auto i = static_cast<std::size_t> (&s - role.slopes.data());
    if (own_loads.empty()) own_loads.resize (role.slopes.size());
    for (std::size_t j = 0; j < i && ! own_loads[i]; ++j)   // many places have the same response
        if (own_loads[j] && isLike (own_responses[j], response)) own_loads[i] = own_loads[j];
    constexpr std::array<double, 3> whole { 1.0, 1.0, 1.0 };
    if (! own_loads[i]) own_loads[i] = passivityLoad (response, axesOf (numbers), whole, period_s);
    return own_loads[i];
}

void RoleLoops::findResponses() const
{
    own_responses.resize (role.slopes.size());
    const auto first = static_cast<Eigen::Index> (3 * (&role - demand.roles.data()));
    for (std::size_t i = 0; i < role.slopes.size() && i < demand.linked.size(); ++i)
        for (const auto& m : demand.linked[i].responses)
            own_responses[i].emplace_back (m.block (first, first, 3, 3));
}

DeviceNumbers RoleLoops::at (const Slope& s) const
{
    auto braked = numbers;
    if (braked.damping) braked.damping->value += s.brake;
    return braked;
}

}   // namespace tactus::check::judging
