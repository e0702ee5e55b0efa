// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_feed.hpp"

#include <host/app/model/message_text.hpp>
#include <host/app/problems/fixes.hpp>

#include <cmath>

namespace tactus::host
{

void LiveFeed::refresh()
{
    Live live;
    showStates (live);
    if (shows_costs) showCosts (live);
    showProblems (live);
    if (limits != nullptr) showLimits (live);
    canvas.showLive (std::move (live));
}

void LiveFeed::showStates (Live& live)
{
    std::vector<std::string> ports;
    const auto watch = [&] (const std::string& port) {
        const auto full_name = canvas.address (port);
        if (ports.size() < most_ports && std::ranges::count (ports, full_name) == 0) ports.push_back (full_name);
        const auto traces = probes.of (full_name);
        return traces.size() == 1 && traces[0]->begin() < traces[0]->end() ? traces[0] : nullptr;
    };
    for (const auto& n : canvas.scene().nodes())
        if (n.face->find (Role::output, "state") != nullptr && ! n.bypass)
            if (const auto trace = watch (n.name + ".state"); trace && live_run.isRunning())
                if (const double state = trace->at (trace->end() - 1); std::isfinite (state)) live.states[n.id] = static_cast<int> (state);

    for (const auto& w : canvas.scene().wires())
        if (w.quantity == Quantity::hit && w.start >= 0)
            if (const auto trace = watch (canvas.scene().nodes()[static_cast<std::size_t> (w.start)].name + '.' + w.out))
            {
                const auto span = static_cast<std::uint64_t> (hit_travels_s * trace->rate());
                for (auto tick = trace->end(); tick-- > trace->begin() && trace->end() - tick < span;)
                    if (trace->at (tick) > 0.0)
                    {
                        live.hits[w.id] = static_cast<double> (trace->end() - tick) / static_cast<double> (span);
                        break;
                    }
            }
    probes.want (std::move (ports));
}

/// The node on the canvas that a path of the graph leads to or through; null if there is none.
const SceneNode* LiveFeed::nodeOf (const std::string& path) const
{
    const auto inside = canvas.address ({});
    if (! path.starts_with (inside)) return nullptr;
    const auto name = path.substr (inside.size());
    for (const auto& n : canvas.scene().nodes())
        if (name == n.name || name.starts_with (n.name + '/') || name.starts_with (n.name + '[')) return &n;
    return nullptr;
}

void LiveFeed::showCosts (Live& live)
{
    if (++since_costs >= refreshes_per_cost)
    {
        since_costs = 0;
        latest_costs.clear();
        for (const auto& cost : live_run.costs())
            if (const auto* node = nodeOf (cost.node)) latest_costs[node->id] += cost.mean_s * live_run.rate();
    }
    live.costs = latest_costs;
}

void LiveFeed::showProblems (Live& live) const
{
    for (const auto& m : live_run.messages())
    {
        if (m.severity != Message::Severity::error) continue;
        const auto culprit = culpritOf (canvas.edited().graph(), m);
        if (culprit.id != 0 && culprit.patch == canvas.patch()) live.problems[culprit.id] = messageText (m);
    }
}

/// Broken limits come first in the list, so they also come first in the text of a light.
void LiveFeed::showLimits (Live& live) const
{
    for (const auto& l : limits->list().limits)
        for (const auto& path : l.nodes)
            if (const auto* node = nodeOf (path))
            {
                auto& light = live.limits[node->id];
                light.is_broken = light.is_broken || l.is_broken;
                const auto text = l.text + (l.remedy.empty() ? "." : ".\nWould help: " + l.remedy + ".");
                if (light.text.find (text) == std::string::npos) light.text += (light.text.empty() ? "" : "\n\n") + text;
            }
}

}   // namespace tactus::host
