// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "limit_watch.hpp"
#include "live_run.hpp"

#include <host/app/canvas/canvas.hpp>

namespace tactus::host
{

/// Shows the run on a canvas: the states of nodes, hits as they travel along wires, problems, broken limits, and optionally what each
/// node costs.
class LiveFeed
{
public:
    LiveFeed (Canvas& c, LiveRun& r) : canvas (c), live_run (r), probes (r.traces()) {}

    void refresh();   ///< call many times a second

    bool shows_costs = false;
    const LimitWatch* limits = nullptr;   ///< whose list to show; null for none

private:
    void showStates (Live&);
    void showCosts (Live&);
    void showProblems (Live&) const;
    void showLimits (Live&) const;
    const SceneNode* nodeOf (const std::string& path) const;

    static constexpr std::size_t most_ports = 12;   ///< how many ports this probes at most; the rest of the probe capacity is left for the scopes
    static constexpr double hit_travels_s = 0.25;
    static constexpr int refreshes_per_cost = 30;

    Canvas& canvas;
    LiveRun& live_run;
    Traces::Client probes;
    std::map<graph::Id, double> latest_costs;
    int since_costs = refreshes_per_cost;
};

}   // namespace tactus::host
