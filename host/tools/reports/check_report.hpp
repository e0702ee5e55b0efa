// SPDX-License-Identifier: MIT
#pragma once

#include "checked_graph.hpp"

#include <tactus/check/report.hpp>
#include <tactus/check/trials/trials.hpp>

#include <vector>

namespace tactus::host
{

struct CheckOptions
{
    bool sweep = false;        ///< the devices sweep their workspaces instead of following the hands
    double duration_s = 0.0;   ///< of the motion; 0: as long as the longest path of a hand
    check::JudgeOptions judge {};
};

/// The conditions of a graph on its devices, as `tactus check` reports them.
class CheckReport
{
public:
    /// Throws Refusal. Uses all processors.
    CheckReport (CheckedGraph&, const CheckOptions&);

    CheckReport (const CheckReport&) = delete;   // `judge` points to `trials`
    CheckReport& operator= (const CheckReport&) = delete;

    /// The JSON of `tactus check --json`.
    Json json() const { return check::toJson (demand, devices, conditions, judge); }

    check::Demand demand;
    std::vector<check::RoleDevice> devices;
    check::Trials trials;
    check::JudgeOptions judge;
    std::vector<check::Condition> conditions;
};

}   // namespace tactus::host
