// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "performance.hpp"

#include <host/app/canvas/canvas.hpp>

namespace tactus::host
{

/// Shows on a canvas what runs: the state of nodes that have one, hits on their way, what is wrong, and if one likes what
/// each node costs.
class LiveFeed
{
public:
    LiveFeed (Canvas& c, Performance& p) : canvas (c), performance (p), probes (p.traces()) {}

    void refresh();   ///< many times a second

    bool shows_costs = false;

private:
    void showStates (Live&);
    void showCosts (Live&);
    void showProblems (Live&) const;

    static constexpr std::size_t most_ports = 12;   ///< of the components that can be probed, the others are for scopes
    static constexpr double hit_travels_s = 0.25;
    static constexpr int refreshes_per_cost = 30;

    Canvas& canvas;
    Performance& performance;
    Traces::Client probes;
    std::map<graph::Id, double> latest_costs;
    int since_costs = refreshes_per_cost;
};

}   // namespace tactus::host
