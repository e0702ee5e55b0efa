// SPDX-License-Identifier: MIT
#include "check_report.hpp"

#include <tactus/check/measure.hpp>

#include <algorithm>
#include <thread>

namespace tactus::host
{

CheckReport::CheckReport (CheckedGraph& graph, const CheckOptions& options) : judge (options.judge)
{
    const auto motion = options.sweep ? graph.sweep (options.duration_s) : graph.motion (options.duration_s);
    const std::size_t threads = std::max (1u, std::thread::hardware_concurrency());
    demand = check::measure (graph.subject, motion, { .ticks = check::affordableTicks (*graph.plan), .threads = threads });
    for (const auto& r : graph.roles)
        devices.push_back (r.device);
    trials = check::tryLoops (graph.subject, motion, demand, devices, { .ticks = check::affordableTicks (*graph.plan) / 2, .threads = threads });
    judge.trials = &trials;
    conditions = check::judge (demand, devices, judge);
}

}   // namespace tactus::host
