// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/check/judge.hpp>
#include <tactus/check/sampled_loop.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/rounded_bound.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

/// The functions that judge.cpp and the judge_*.cpp share.
namespace tactus::check::judging
{

/// Three digits are enough: the numbers of a device are seldom known better.
inline std::string text (double v) { return roundedText (v, 3); }

inline std::string text (double v, std::string_view unit) { return text (v) + " " + std::string (unit); }

inline constexpr double slope_error = 1e-5;   // relative error of a measured slope

inline std::string atLeast (double v, std::string_view unit) { return "at least " + text (roundedBound (v, true, 0.5 * slope_error), unit); }
inline std::string atMost (double v, std::string_view unit) { return "at most " + text (roundedBound (v, false, 0.5 * slope_error), unit); }
inline std::string above (double v, std::string_view unit) { return "above " + text (roundedBound (v, true), unit); }
inline std::string below (double v, std::string_view unit) { return "below " + text (roundedBound (v, false), unit); }

/// "a, b, or c". Each of them would help alone.
inline std::string anyOf (const std::vector<std::string>& ways)
{
    std::string all;
    for (std::size_t i = 0; i < ways.size(); ++i)
        all += (i == 0 ? "" : i + 1 < ways.size() ? ", "
                                                  : ", or ")
               + ways[i];
    return all;
}

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
    const auto isWithin = [&] (double v) { return strict == Strict::yes ? v < limit : v <= (1.0 + slope_error) * limit; };
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
/// is several times as large; and whether a loop that does not rest only runs away, as on a crest. The place that is nearest to swinging comes first.
template <typename Place, typename Radius, typename Rests, typename Falls>
void closeLoops (Condition& c, std::vector<Place>& places, Radius&& radius, Rests&& rests, Falls&& falls)
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
    c.falls = swings && std::ranges::all_of (sorted, [&] (const auto& s) { return s.first <= at_rest || falls (s.second); });
    if (c.falls)
        c.text += "; the sampled loop runs away, as the graph pushes the tool off this place, but does not swing";
    else if (swings)
        c.text += "; the sampled loop swings" + (c.may_grow > 0.0 ? ", and would rest with " + text (c.may_grow) + " times this response" : std::string());
    else
        c.text += "; not passive, but the sampled loop comes to rest without a hand and with usual ones, up to " + text (c.may_grow) + " times this response";
    c.remedy = "for a contact that is passive, whatever the hand does: " + c.remedy;
}

inline void unknown (Condition& c, double value, std::string_view missing)
{
    c.value = value;
    c.remedy = "the device's " + std::string (missing) + " is not known: add it to \"physics\" in its profile";
    if (missing == "peak force") c.remedy += "; that of a simulated device is the max_force of its guard";
}

/// The tick period, in s. A device that is slower than the graph holds each force for longer.
inline double periodOf (const Demand& demand, const DeviceNumbers& n) noexcept
{
    const double own = n.rate && n.rate->value > 0.0 ? 1.0 / n.rate->value : 0.0;
    return std::max (own, 1.0 / demand.rate_hz);
}

/// True if the graph may tick that fast, and the device follows.
inline bool reaches (const DeviceNumbers& n, double rate_hz) noexcept { return ! n.rate || ! (n.rate->value > 0.0) || n.rate->value >= rate_hz; }

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

/// True if a node drags a tool along, as friction does. Its force is no spring for longer than its stretch.
inline bool drags (const Demand& demand, std::size_t node)
{
    return std::ranges::any_of (demand.stretches, [node] (const Stretch& s) { return s.node == node; });
}

/// The param that decides how stiff a friction is.
inline Stretch::Softer softer (const Demand& demand, std::size_t node)
{
    const auto at = std::ranges::find (demand.stretches, node, &Stretch::node);
    return at == demand.stretches.end() ? Stretch::Softer::unknown : at->softer;
}

inline constexpr std::string_view passive_law = "sup of T/2 Re[(1 - e^-jwT) H]/(1 - cos wT) <= B";

/// Changes the verdict on the slopes of a role, or of several linked roles, by three more facts: the claims of the nodes, the energy that the graph gave
/// along the motion, and the trials. `turns`: the slopes have a curl, so no energy belongs to them. `holds_as_claimed`: the condition holds for all that
/// the nodes claim, wherever the tool goes.
void weigh (const Demand&, const Trials*, Condition&, std::span<const RoleDemand* const> roles, bool turns, bool holds_as_claimed);

/// Sets the condition `deadbeat`.
void judgeDeadbeat (const Demand&, const Deadbeat&, const DeviceNumbers&, Condition&);

/// Sets the condition `scanning` for the teeth of stick-slip.
void judgeTeeth (const Demand&, const Stretch&, const DeviceNumbers&, const JudgeOptions&, Condition&);

/// Adds the conditions of Table 1 for a texture.
void judgeTexture (const Demand&, const Texture&, const DeviceNumbers&, const JudgeOptions&, std::vector<Condition>&);

/// The conditions `coupling` and `curl`, which need the slopes of several axes or roles at once.
void judgeLinks (const Demand&, std::span<const RoleDevice>, const JudgeOptions&, std::vector<Condition>&);

}   // namespace tactus::check::judging
