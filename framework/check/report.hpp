// SPDX-License-Identifier: MIT
#pragma once

#include "judge.hpp"

#include <tactus/text/json.hpp>

namespace tactus::check
{

/// The report of `tactus check --json`, as docs/check.md describes it. Numbers that are not finite are null.
Json toJson (const Demand&, std::span<const RoleDevice>, std::span<const Condition>, const JudgeOptions&);

/// The first line of a report: the motion, and the numbers of places and trials.
std::string scopeOf (const Demand&, const JudgeOptions&, std::string_view motion);

/// Something that has no verdict.
struct NotJudged
{
    std::string role;   ///< empty: about the graph as a whole
    std::string what, why;
};

/// The things that have no verdict, with reasons. Reports print them before the conditions, so that no row seems to bless them.
std::vector<NotJudged> notJudged (const Demand&, std::span<const Condition>, const JudgeOptions&);

/// "M 0.1 kg, B 0.05 N*s/m, …": the known numbers of a device, with their symbols.
std::string describe (const DeviceNumbers&);

/// "1.0004 of 1": a value and its limit with three digits, or as many as it takes to tell the two apart, up to nine.
std::string describe (double value, double limit);

}   // namespace tactus::check
