// SPDX-License-Identifier: MIT
#pragma once

#include "judge.hpp"
#include "sampled_loop.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

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

/// The same for `stiffness` and `coupling`: passive or broken.
inline void decideContact (Condition& c, double value, double limit, const std::string& remedy)
{
    decide (c, value, limit, Strict::no, 1.0, remedy);
    if (c.verdict == Verdict::holds) c.verdict = Verdict::passive;
}

/// True if two responses differ by less than the error of a measurement.
template <typename Response>
bool isLike (const Response& a, const Response& b)
{
    constexpr double rounding = 1e-6;   // relative
    const auto size = [] (const auto& v) {
        if constexpr (std::is_arithmetic_v<std::decay_t<decltype (v)>>)
            return std::abs (v);
        else
            return v.norm();
    };
    if (a.size() != b.size()) return false;
    double most = 0.0, apart = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k)
    {
        most = std::max (most, size (a[k]));
        const auto difference = a[k] - b[k];
        apart = std::max (apart, size (difference));
    }
    return apart <= rounding * most;
}

inline void noLoop (Condition& c) { c.text += "; the sampled loop is not known at every place"; }

/// Judges the sampled loops of contacts that are not passive, each with a largest radius (empty if it is not known), and whether it rests if its response
/// is several times as large. The one that is nearest to swinging comes first.
template <typename Place, typename Radius, typename Rests>
void closeLoops (Condition& c, std::vector<Place>& places, Radius&& radius, Rests&& rests)
{
    std::vector<std::pair<double, Place>> sorted;
    for (const auto& place : places)
    {
        const std::optional<double> at = radius (place);
        if (! at) return noLoop (c);
        sorted.emplace_back (*at, place);
    }
    std::ranges::stable_sort (sorted, std::ranges::greater {}, &std::pair<double, Place>::first);
    for (std::size_t i = 0; i < places.size(); ++i)
        places[i] = sorted[i].second;
    constexpr std::size_t closest = 4;
    const auto some = std::min (places.size(), closest);
    c.may_grow = roomToGrow ([&] (double factor) {
        return std::all_of (places.begin(), places.begin() + static_cast<std::ptrdiff_t> (some), [&] (const Place& p) { return rests (p, factor); });
    });
    const bool swings = sorted.front().first > at_rest;
    c.verdict = swings ? Verdict::unstable : Verdict::stable;
    if (swings)
        c.text += "; the sampled loop swings, and would rest with " + text (c.may_grow) + " times this response";
    else
        c.text += "; not passive, but the sampled loop comes to rest without a hand and with usual ones, up to " + text (c.may_grow) + " times this response";
    c.remedy = "for a contact that is passive, whatever the hand does: " + c.remedy;
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

/// True if a device is slower than the graph: a force may then be held for several ticks, and the sampled loop is not known.
inline bool isSlow (const Demand& demand, const DeviceNumbers& n) noexcept { return periodOf (demand, n) > (1.0 + 1e-9) / demand.rate_hz; }

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
