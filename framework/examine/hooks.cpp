// SPDX-License-Identifier: MIT
#include "parts.hpp"

#include <cmath>

namespace tactus::examine
{

namespace
{
std::string ask (const NodeType& type, double rate_hz)
{
    Stage::enter ("create");
    const auto node = type.make();
    const Setup setup { .rate_hz = rate_hz };
    const DeviceState state;
    if (type.cost)
    {
        Stage::enter ("cost");
        const auto cost = type.cost (node.get());
        if (! (cost.work >= 0.0 && cost.memory >= 0.0)) return say ("its cost is ", cost.work, " and ", cost.memory, " bytes");
    }
    if (type.problem)
    {
        Stage::enter ("problem");
        if (const auto problem = type.problem (node.get()); ! problem.empty()) return "it has a problem with its defaults: " + problem;
    }
    if (type.missing)
    {
        Stage::enter ("missing");
        type.missing (node.get(), DeviceLayout {});
    }
    if (type.bind)
    {
        Stage::enter ("bind");
        bindFirst (type, node.get(), state);
    }
    if (type.learn)
    {
        Stage::enter ("learn");
        type.learn (node.get(), DeviceMechanics {});
    }
    if (type.warning)
    {
        Stage::enter ("warning");
        type.warning (node.get(), setup);
    }
    if (type.prepare)
    {
        Stage::enter ("prepare");
        type.prepare (node.get(), setup);
    }
    if (type.claims)
    {
        Stage::enter ("claims");
        const auto claims = type.claims (node.get());
        for (const double v : { claims.stiffness, claims.damping, claims.spatial_frequency, claims.amplitude })
            if (std::isnan (v)) return "one of its claims is not a number";
    }
    if (type.delay)
    {
        Stage::enter ("delay");
        if (const int ticks = type.delay (node.get()); ticks < 1) return say ("its delay is ", ticks, " ticks");
    }
    Stage::enter ("destroy");
    return {};
}
}   // namespace

std::string hookFault (const NodeType& type, unsigned)
{
    for (const double rate_hz : { 100.0, 1000.0, 4000.0, 48000.0 })
        if (auto fault = ask (type, rate_hz); ! fault.empty()) return say (fault, " (at ", rate_hz, " Hz)");
    return {};
}

}   // namespace tactus::examine
