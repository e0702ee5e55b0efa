// SPDX-License-Identifier: MIT
#include "trial_starts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tactus::check
{

Vec3 TrialStarts::speedAt (std::size_t role, std::size_t k) const
{
    const auto& readings = motion.roles[role].readings;
    const auto half = std::max<std::size_t> (1, static_cast<std::size_t> (2.5e-3 * motion.rate_hz));
    const auto from = k > half ? k - half : 0, to = std::min (k + half, readings.size() - 1);
    if (from == to) return Vec3::Zero();
    return (readings[to].position - readings[from].position) * motion.rate_hz / static_cast<double> (to - from);
}

std::size_t TrialStarts::tickOf (double t_s) const
{
    return std::min (static_cast<std::size_t> (std::max (0.0, std::round (t_s * motion.rate_hz))), motion.ticks - 1);
}

std::vector<std::size_t> TrialStarts::places() const
{
    struct Candidate
    {
        std::size_t place;
        double weight;
    };
    std::vector<Candidate> candidates;
    std::vector<std::size_t> ticks_of;
    std::vector<std::size_t> picked;   // places
    const auto weigh = [&] (std::size_t i) {
        const auto& l = demand.linked[i];
        double most = 0.0;
        for (const auto& response : l.responses)
            most = std::max (most, response.norm());
        return std::max (most, l.settled.norm()) + l.excess.norm() * motion.rate_hz;
    };
    double heaviest = 0.0;
    for (std::size_t i = 0; i < demand.linked.size(); ++i)
    {
        candidates.push_back ({ i, weigh (i) });
        heaviest = std::max (heaviest, candidates.back().weight);
    }
    std::ranges::stable_sort (candidates, std::ranges::greater {}, &Candidate::weight);
    const auto differs = [&] (std::size_t a, std::size_t b) {
        const auto& x = demand.linked[a];
        const auto& y = demand.linked[b];
        const double most = std::max ({ x.settled.norm(), y.settled.norm(), 1e-3 * heaviest }), b_most = std::max (x.excess.norm(), y.excess.norm());
        return (x.settled - y.settled).norm() > 0.2 * most || (x.excess - y.excess).norm() > 0.2 * std::max (b_most, 1e-3 * heaviest / motion.rate_hz);
    };
    const auto each = static_cast<std::size_t> (8.0 * 0.6 * motion.rate_hz);   // ticks that the trials at a place usually take
    auto most_places = std::clamp<std::size_t> (effort.ticks / each, 2, std::max<std::size_t> (2, effort.places));
    const auto pick = [&] (std::size_t place) {
        if (picked.size() < most_places && std::ranges::count (picked, place) == 0) picked.push_back (place);
    };
    std::vector<std::size_t> unlike;   // one of each kind of response
    for (const auto& c : candidates)
        if (std::ranges::all_of (unlike, [&] (std::size_t u) { return differs (u, c.place); })) unlike.push_back (c.place);
    constexpr std::size_t most_loops = 16;
    if (unlike.size() > most_loops) unlike.resize (most_loops);
    std::size_t nearest = candidates.empty() ? 0 : candidates.front().place;
    double largest = 0.0;
    for (const auto u : unlike)
        if (const double radius = isCalm (u) ? 0.0 : worstHand (u).second; radius > largest)
        {
            largest = radius;
            nearest = u;
        }
    const bool swings = largest > at_rest;   // so the trials must show that something calms the tool
    if (swings) most_places *= 3;
    if (! candidates.empty()) pick (nearest);
    if (! candidates.empty()) pick (candidates.front().place);
    // The places with the largest force, a small one, and the largest speed.
    for (std::size_t r = 0; r < demand.roles.size(); ++r)
    {
        const auto& slopes = demand.roles[r].slopes;
        if (slopes.size() != demand.linked.size() || slopes.empty() || tools.owners[r].axis != -1) continue;
        const auto forceOf = [] (const Slope& s) { return s.force.norm(); };
        const auto speedOf = [&] (const Slope& s) { return speedAt (tools.owners[r].tool, tickOf (s.t_s)).norm(); };
        pick (static_cast<std::size_t> (std::ranges::max_element (slopes, {}, forceOf) - slopes.begin()));
        std::size_t fastest = 0, lightest = slopes.size();
        const double light = 0.3 * forceOf (*std::ranges::max_element (slopes, {}, forceOf));   // a tool that is hardly pressed takes long to settle
        for (std::size_t i = 0; i < slopes.size(); ++i)
        {
            if (speedOf (slopes[i]) > speedOf (slopes[fastest])) fastest = i;
            if (slopes[i].force.norm() > light && (lightest == slopes.size() || forceOf (slopes[i]) < forceOf (slopes[lightest]))) lightest = i;
        }
        pick (fastest);
        if (lightest < slopes.size()) pick (lightest);
    }
    for (const auto& c : candidates)
        if (std::ranges::all_of (picked, [&] (std::size_t p) { return differs (p, c.place); })) pick (c.place);
    const auto more = swings ? most_places : 0;
    for (std::size_t i = 0; i < more; ++i)   // evenly along the motion, where something is felt
    {
        const auto place = (2 * i + 1) * demand.linked.size() / (2 * more);
        if (weigh (place) > 0.0) pick (place);
    }
    for (const auto p : picked)
        ticks_of.push_back (tickOf (demand.linked[p].t_s));
    if (ticks_of.empty())   // nothing has a slope: evenly along the motion
        for (std::size_t i = 0; i < effort.places; ++i)
            ticks_of.push_back ((2 * i + 1) * motion.ticks / (2 * effort.places));
    std::ranges::sort (ticks_of);
    ticks_of.erase (std::unique (ticks_of.begin(), ticks_of.end()), ticks_of.end());
    return ticks_of;
}

/// The hand that makes the loops of the tools swing most at a place, and the largest radius with it.
std::pair<HeldHand, double> TrialStarts::worstHand (std::size_t place) const
{
    std::pair<HeldHand, double> worst { usualHands()[2], 0.0 };
    for (std::size_t r = 0; r < demand.roles.size(); ++r)
    {
        if (tools.owners[r].axis != -1 || ! tools.isFree (r)) continue;
        const auto first = static_cast<Eigen::Index> (3 * r);
        std::vector<Jacobian> own;
        for (const auto& m : demand.linked[place].responses)
            own.emplace_back (m.block (first, first, 3, 3));
        if (own.empty()) continue;
        const auto* device = &tools.numbers[tools.owners[r].tool];
        const std::array<const DeviceNumbers*, 3> axes { device, device, device };
        for (const auto& hand : usualHands())
            if (const auto radius = loopRadius (own, axes, 1.0 / motion.rate_hz, hand); radius && *radius > worst.second) worst = { hand, *radius };
    }
    return worst;
}

/// The ratio of the damping that the loop at a place needs to that of the device of a role; 0 if it needs none.
double TrialStarts::loadOf (std::size_t role, std::size_t place) const
{
    const auto& s = demand.roles[role].slopes[place];
    const auto& device = tools.numbers[tools.owners[role].tool];
    const double load = s.stiffness / motion.rate_hz * (0.5 + (device.delay ? device.delay->value : 0.0)) + s.lag + s.damping;
    return load > 0.0 ? load / (device.damping->value + s.brake) : 0.0;
}

bool TrialStarts::isLoopKnown (std::size_t role, std::size_t place) const
{
    return ! demand.roles[role].slopes[place].responses.empty() && ! demand.linked[place].responses.empty();
}

/// True if some place is not passive and its loop cannot be computed, as with a friction. Only the trials show then whether the tool rests.
bool TrialStarts::isLoopUnknown() const
{
    for (std::size_t r = 0; r < demand.roles.size(); ++r)
        for (std::size_t i = 0; i < demand.roles[r].slopes.size() && i < demand.linked.size() && tools.isFree (r) && tools.owners[r].axis == -1; ++i)
            if (! isLoopKnown (r, i) && loadOf (r, i) > 1.0) return true;
    return false;
}

/// True if the loops of all tools at a place are known, and would be passive with half of the device's damping, or with a quarter of it if a friction
/// slips. There, only a few trials are made.
bool TrialStarts::isCalm (std::size_t place) const
{
    if (place >= demand.linked.size()) return false;
    const double most = demand.linked[place].is_smooth ? 0.5 : 0.25;
    for (std::size_t r = 0; r < demand.roles.size(); ++r)
        if (! tools.isFree (r) || tools.owners[r].axis != -1 || place >= demand.roles[r].slopes.size() || ! isLoopKnown (r, place)
            || ! (loadOf (r, place) <= most))
            return false;
    return true;
}

std::vector<Release> TrialStarts::releasesAt (std::size_t at) const
{
    const double t_s = static_cast<double> (at) / motion.rate_hz;
    const auto place = std::ranges::min_element (demand.linked, {}, [&] (const Linked& l) { return std::abs (l.t_s - t_s); });
    auto worst = place != demand.linked.end() ? worstHand (static_cast<std::size_t> (place - demand.linked.begin())).first : usualHands()[2];
    if (worst.mass == 0.0) worst = usualHands()[2];   // without a hand, it is let go anyway
    const auto arm = usualHands().back();
    if (place != demand.linked.end() && isCalm (static_cast<std::size_t> (place - demand.linked.begin())))
        return { { .along = far_off },
                 { .along = -0.8 * far_off, .across = 0.48 * far_off, .third = 0.36 * far_off },
                 { .across = -far_off, .hand = worst },
                 { .along = 0.6 * near_off, .across = 0.64 * near_off, .third = 0.48 * near_off, .hand = worst } };
    double fastest = 0.0;
    for (std::size_t r = 0; r < motion.roles.size(); ++r)
        fastest = std::max (fastest, speedAt (r, at).norm());
    std::vector<Release> all {
        { .along = 0.6 * near_off, .across = 0.64 * near_off, .third = 0.48 * near_off },
        { .along = far_off },
        { .across = -far_off },
        { .along = -0.8 * far_off, .across = 0.48 * far_off, .third = 0.36 * far_off },
        { .along = 0.6 * near_off, .across = 0.64 * near_off, .third = 0.48 * near_off, .hand = worst },
        { .along = far_off, .hand = worst },
        { .across = -far_off, .hand = worst },
    };
    if (worst != arm) all.push_back ({ .along = 0.6 * far_off, .across = 0.64 * far_off, .third = 0.48 * far_off, .hand = arm });
    if (isLoopUnknown())   // so the worst hand is not known either
        for (const auto& hand : usualHands())
        {
            if (hand.mass == 0.0) continue;
            all.push_back ({ .across = -far_off, .hand = hand });
            all.push_back ({ .along = -0.8 * far_off, .across = 0.48 * far_off, .third = 0.36 * far_off, .hand = hand });
        }
    // To a damper, a start off its rest is a blow.
    if (place != demand.linked.end() && place->excess.norm() > 0.0)
        all.push_back ({ .along = 0.6 * hard_off, .across = 0.64 * hard_off, .third = 0.48 * hard_off });
    if (fastest > 0.05)
        for (const double way : { 1.0, -1.0 })
            all.push_back ({ .speed = way });
    return all;
}

}   // namespace tactus::check
