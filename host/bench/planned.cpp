// SPDX-License-Identifier: GPL-3.0-or-later
#include "planned.hpp"

#include <stdexcept>

namespace tactus::bench
{

Planned::Planned (const graph::Graph& g, const CompileOptions& options, const Catalogue& types)
{
    auto compiled = compile (g, types, options);
    if (! compiled.plan) throw std::logic_error (compiled.messages.empty() ? "no plan" : compiled.messages.front().text);
    plan = std::move (compiled.plan);
    if (! plan->roles().empty()) device = plan->roles().front().state.get();
}

void Planned::tick (const double* in) noexcept
{
    if (device)
        device->reading.position = { in[0], in[1], in[2] };
    else
        plan->feeds().front() = in[0];
    plan->tick();
}

std::vector<double> Planned::outputs() const
{
    if (device)
    {
        const auto& sink = plan->roles().front().sinks.front();
        const Vec3 f = sink.effort (sink.node).force;
        return { f.x(), f.y(), f.z() };
    }
    std::vector<double> values;
    for (const auto& tap : plan->taps())
        values.push_back (*tap.value);
    return values;
}

}   // namespace tactus::bench
