// SPDX-License-Identifier: GPL-3.0-or-later
#include "device_trial.hpp"

#include <tactus/graph/endpoint_text.hpp>

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace tactus::host
{

namespace
{
graph::Node trialNode (std::string name, std::string type, std::initializer_list<std::pair<const char*, Json>> params)
{
    graph::Node n;
    n.name = std::move (name);
    n.type = std::move (type);
    for (const auto& [key, value] : params)
        n.params[key] = value;
    return n;
}
}   // namespace

std::optional<DeviceTrial> DeviceTrial::of (const graph::Graph& of, const RoleNeeds& needs)
{
    DeviceTrial trial;
    trial.is_force = needs.parts.force;
    if (! trial.is_force && needs.parts.others.signal_outputs < 1) return {};
    auto& g = trial.graph;
    g.name = "Test of " + needs.role;
    g.rate_hz = of.rate_hz;
    g.folder = of.folder;
    if (const auto* description = of.device (needs.role)) g.devices.emplace_back (needs.role, *description);
    auto& nodes = g.root.nodes;
    nodes.push_back (trialNode ("start", "signal.constant", { { "value", Json (0.0) } }));
    nodes.push_back (trialNode ("level", "signal.constant", { { "value", trial.is_force ? Json ("0 N") : Json (0.0) } }));
    const Json half (0.5 * length_s);
    nodes.push_back (trialNode ("shape", "signal.envelope", { { "attack", half }, { "decay", half }, { "sustain", Json (0.0) } }));
    nodes.push_back (trialNode ("pulse", "signal.multiply", {}));
    nodes.back().settings["inputs"] = trial.is_force ? 2 : 3;
    auto motor = trialNode ("motor", trial.is_force ? "device.force" : "device.signal_out", {});
    motor.role = needs.role;
    nodes.push_back (std::move (motor));
    if (! trial.is_force) nodes.push_back (trialNode ("tone", "signal.lfo", { { "frequency", Json ("150 Hz") }, { "amplitude", Json (1.0) } }));
    for (const char* w : { "start.out -> shape.gate", "shape.out -> pulse.in[0]", "level.out -> pulse.in[1]" })
        g.root.wires.push_back (graph::parseWire (w).value());
    if (! trial.is_force) g.root.wires.push_back (graph::parseWire ("tone.out -> pulse.in[2]").value());
    g.root.wires.push_back (graph::parseWire (trial.is_force ? "pulse.out -> motor.force.z" : "pulse.out -> motor.in").value());
    return trial;
}

double DeviceTrial::level (std::optional<double> max_force_N, std::optional<double> max_signal) const noexcept
{
    if (is_force) return max_force_N ? std::min (share * *max_force_N, most_force_N) : 0.0;
    return max_signal ? share * *max_signal : unguarded_signal;
}

}   // namespace tactus::host
