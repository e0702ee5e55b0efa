// SPDX-License-Identifier: MIT
#pragma once

#include "judge.hpp"

#include <algorithm>
#include <cstdio>

/// What judge.cpp, judge_deadbeat.cpp and judge_links.cpp share.
namespace tactus::check::judging
{

/// Three digits are enough: the numbers of a device are seldom known better.
inline std::string text (double v)
{
    char buffer[32];
    return { buffer, static_cast<std::size_t> (std::snprintf (buffer, sizeof buffer, "%.3g", v)) };
}

inline std::string text (double v, std::string_view unit) { return text (v) + " " + std::string (unit); }

enum class Strict
{
    no,
    yes
};

/// Sets the verdict. `better`: the recommended factor between the value and the limit.
inline void decide (Condition& c, double value, double limit, Strict strict, double better, const std::string& remedy)
{
    c.value = value;
    c.limit = limit;
    constexpr double rounding = 1e-5;   // relative error of a measured slope
    const auto isWithin = [&] (double v) { return strict == Strict::yes ? v < limit : v <= (1.0 + rounding) * limit; };
    c.verdict = ! isWithin (value) ? Verdict::broken : isWithin (better * value) ? Verdict::holds
                                                                                 : Verdict::close;
    if (c.verdict == Verdict::broken || c.verdict == Verdict::close) c.remedy = remedy;
}

inline void unknown (Condition& c, double value, std::string_view missing)
{
    c.value = value;
    c.remedy = "the device's " + std::string (missing) + " is not known: add it to \"physics\" in its profile";
}

/// The tick period, in s. A device that is slower than the graph holds each force for longer.
inline double periodOf (const Demand& demand, const DeviceNumbers& n) noexcept
{
    const double own = n.rate && n.rate->value > 0.0 ? 1.0 / n.rate->value : 0.0;
    return std::max (own, 1.0 / demand.rate_hz);
}

inline double delayOf (const DeviceNumbers& n) noexcept { return n.delay ? n.delay->value : 0.0; }

/// The node whose own force is steepest at a place, with its stiffness; empty if no node has a force.
inline std::string steepestNode (const Demand& demand, const std::vector<double>& by_node)
{
    const auto most = std::ranges::max_element (by_node);
    if (most == by_node.end() || ! (*most > 0.0)) return "";
    const auto& node = demand.nodes[static_cast<std::size_t> (most - by_node.begin())];
    return "'" + node.path + "' (" + node.type + ", " + text (*most, "N/m") + ")";
}

/// Sets the condition `deadbeat`.
void judgeDeadbeat (const Demand&, const Deadbeat&, const DeviceNumbers&, Condition&);

/// The conditions `coupling` and `curl`, which need the slopes of several axes or roles at once.
void judgeLinks (const Demand&, std::span<const RoleDevice>, std::vector<Condition>&);

}   // namespace tactus::check::judging
