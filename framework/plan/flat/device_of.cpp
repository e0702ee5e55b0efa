// SPDX-License-Identifier: MIT
#include "device_of.hpp"
#include "grouped.hpp"

#include <tactus/text/object_reader.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

namespace tactus::plan
{

namespace
{
constexpr int none_found = -1;

/// For each node, the nearest device node from which `next` leads to it, or `none_found`. The search starts at all device nodes at once,
/// and follows one wire in each round.
std::vector<int> nearestDevice (const Flat& flat, const Grouped<int>& next)
{
    std::vector<int> nearest (flat.nodes.size(), none_found), front;
    for (int n = 0; n < flat.nodeCount(); ++n)
        if (flat.node (n).type->bind && flat.node (n).runs()) front.push_back (n);
    std::ranges::sort (front, {}, [&] (int n) -> const std::string& { return flat.node (n).path; });
    for (const int n : front)
        nearest[at (n)] = n;
    while (! front.empty())
    {
        std::vector<int> reached;
        for (const int n : front)
            for (const int m : next[at (n)])
                if (nearest[at (m)] == none_found)
                {
                    nearest[at (m)] = nearest[at (n)];
                    reached.push_back (m);
                }
        front = std::move (reached);
    }
    return nearest;
}
}   // namespace

void findDevices (Flat& flat)
{
    if (std::ranges::none_of (flat.nodes, [] (const FlatNode& n) { return n.type->learn != nullptr; })) return;

    const Grouped<int> onward (flat.nodes.size(), [&] (auto visit) {
        for (const auto& w : flat.wires)
            if (w.from) visit (w.from->node, w.to.node);
    });
    const Grouped<int> back (flat.nodes.size(), [&] (auto visit) {
        for (const auto& w : flat.wires)
            if (w.from) visit (w.to.node, w.from->node);
    });
    const auto before = nearestDevice (flat, onward), after = nearestDevice (flat, back);
    for (int n = 0; n < flat.nodeCount(); ++n)
        if (flat.node (n).type->learn)
            if (const int device = before[at (n)] != none_found ? before[at (n)] : after[at (n)]; device != none_found)
                flat.nodes[at (n)].role = flat.node (device).role;
}

DeviceMechanics describedDevice (const graph::Graph& graph, const std::string& role)
{
    const auto* description = graph.device (role);
    if (description == nullptr || ! description->is_object()) return {};

    Messages unheeded;   // makeDevice() reports the same problems
    ObjectReader in (*description, {}, unheeded);
    return { .mass = in.number ("mass", unit::kilogram, Bounds::positive(), 0.0), .damping = in.number ("damping", unit::damping, Bounds::notNegative(), 0.0) };
}

void warnOfDeviceDelay (Flat& flat, const FlatNode& n, const graph::Graph& graph)
{
    const auto setting = std::ranges::find (n.type->settings, "delay", &SettingSheet::id);
    const auto* description = graph.device (n.role);
    if (n.type->learn == nullptr || setting == n.type->settings.end() || description == nullptr || ! description->is_object()) return;

    Messages unheeded;   // makeDevice() reports the same problems
    const double device = ObjectReader (*description, {}, unheeded).number ("delay", unit::count, Bounds::notNegative(), 0.0);
    const auto place = at (setting - n.type->settings.begin());
    const auto* value = place < n.settings.size() ? std::get_if<double> (&n.settings[place]) : nullptr;
    const double compensated = (value != nullptr ? *value : 0.0) * flat.ticksOf (n.section);
    if (! (compensated < device)) return;
    flat.warn ("rate/device_delay", n.origin,
               "'" + n.path + "' (" + std::string (n.type->info.id) + ") compensates a delay of " + std::to_string (std::lround (compensated))
                   + " ticks, but the device '" + n.role + "' alone delays the force by " + std::to_string (std::lround (device)),
               "set its \"delay\" to the delay of the device plus that of the wires and nodes between hand and motor");
}

}   // namespace tactus::plan
