// SPDX-License-Identifier: MIT
#include "trials.hpp"
#include "bench.hpp"
#include "free_tool.hpp"
#include "side_by_side.hpp"

#include <tactus/run/engine.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

namespace tactus::check
{

namespace
{
constexpr double lasts_s = 3.0, longest_s = 24.0;   // doubled, up to the longest, while it is not clear whether the tool comes to rest
constexpr double least_swing = 1e-6;                // m, or rad
constexpr double doubtful = 0.6;                    // of the least swing; from another start, the tool may swing
constexpr double little = 0.2;                      // of the least swing; less is none, unless it grows
constexpr double steady = 0.9;                      // of the swing in the stretch before: a smaller swing dies, and one larger by the inverse grows
constexpr double window_s = 0.125;
constexpr double far_m = 1.0;
constexpr double beside = 5e-3;                                      // m outside the motion: too far to count for it
constexpr std::size_t most_over = 4;                                 // times the planned ticks
constexpr double near_off = 2e-4, far_off = 2e-3, hard_off = 3e-3;   // m

/// The range of a coordinate, and its largest rise and fall.
struct Reached
{
    double low = 1e300, high = -1e300, rise = 0.0, fall = 0.0;

    void to (double z) noexcept
    {
        low = std::min (low, z);
        high = std::max (high, z);
        rise = std::max (rise, z - low);
        fall = std::max (fall, high - z);
    }
    double range() const noexcept { return high > low ? high - low : 0.0; }
    double swing() const noexcept { return std::min (rise, fall); }
};

/// A coordinate of a tool, or one of its axes.
struct Coordinate
{
    double threshold = least_swing;
    Reached window {}, window_before {};
    double swung = 0.0;   // m; the most in a window, except the first two
    Reached stretch {}, stretch_before {};
    double of_graph = 0.0, of_hand = 0.0;   // work in the stretch, in J

    bool isQuiet() const noexcept { return std::max (window.range(), window_before.range()) <= little * threshold; }
    bool dies() const noexcept { return stretch.swing() < steady * stretch_before.swing(); }
    bool grows() const noexcept { return stretch.swing() > little * threshold && steady * stretch.swing() > stretch_before.swing(); }
};

/// True if a trial says more against a contact than another one.
bool isWorse (const Trial& a, const Trial& b)
{
    const auto rank = [] (const Trial& t) {
        if (! t.swings) return t.is_doubtful ? 1 : 0;
        return t.runs_away ? 2 : t.dies ? 3
                                        : 4;
    };
    return rank (a) != rank (b) ? rank (a) > rank (b) : rank (a) > 0 && a.range > b.range;
}

/// Adds the trials at another place.
void add (Trials& all, const Trials& more)
{
    all.places += more.places;
    all.runs += more.runs;
    all.driven_away += more.driven_away;
    for (std::size_t d = 0; d < all.by_role.size(); ++d)
    {
        auto& its = all.by_role[d];
        const bool is_lost = its.is_lost || more.by_role[d].is_lost, is_tried = its.is_tried && more.by_role[d].is_tried;
        if (isWorse (more.by_role[d], its)) its = more.by_role[d];
        its.is_lost = is_lost;
        its.is_tried = is_tried || its.swings;
    }
}

class TrialRun
{
public:
    TrialRun (const Subject& s, const HandMotion& m, const Demand& d, std::span<const RoleDevice> devices, const TrialEffort& e)
        : motion (m), demand (d), effort (e), stop (s.stop)
    {
        auto options = s.options;
        options.rate_hz = m.rate_hz;
        engine = std::make_unique<Engine> (compile (s.graph, s.catalogue, options).plan);
        for (const auto& role : m.roles)
        {
            const auto at = std::ranges::find (devices, role.role, &RoleDevice::role);
            const bool is_known = at != devices.end() && at->numbers.mass && at->numbers.damping && ! isSlow (at->numbers);
            known.push_back (is_known);
            DeviceNumbers numbers = at != devices.end() ? at->numbers : DeviceNumbers {};
            if (! is_known) numbers.mass = numbers.damping = DeviceNumber { .value = 1.0 };
            const auto* simulated = at != devices.end() && at->simulated ? &*at->simulated : nullptr;
            auto layout = role.layout;
            if (simulated != nullptr) layout.brake = simulated->brake;
            tools.push_back (std::make_unique<FreeTool> (numbers, layout, simulated, m.rate_hz));
            GuardLimits limits;
            if (numbers.peak_force) limits.max_force = numbers.peak_force->value;
            engine->attach (role.role, *tools.back(), limits);
            devices_of.push_back (numbers);
            found.are_dry = found.are_dry || (is_known && numbers.coulomb && numbers.coulomb->value > 0.0);
            for (int i = 0; i < 3; ++i)
                thresholds.push_back (std::max (least_swing, 2.0 * (numbers.quantum ? numbers.quantum->value : 0.0)));
        }
        for (const auto& role : demand.roles)
        {
            found.by_role.push_back ({ .role = role.role, .axis = role.axis });
            owners.push_back (ownerOf (role));
        }
    }

    /// The places of the motion at which the tools are let go, as ticks, in order. Empty if no tool is free.
    std::vector<std::size_t> places() const
    {
        for (std::size_t d = 0; d < owners.size(); ++d)
            if (motion.ticks > 0 && isFree (d)) return chosen();
        return {};
    }

    /// Follows the motion to a place, and makes the trials there. Called once.
    Trials at (std::size_t place)
    {
        silencePlayers();
        for (std::size_t now = 0; now <= place; ++now)
            holdAt (now);
        ticks = 0;   // the budget is for the trials
        tryAt (place);
        for (std::size_t d = 0; d < owners.size(); ++d)
            found.by_role[d].is_tried = isFree (d) && (found.by_role[d].swings || ! is_over);
        return std::move (found);
    }

    /// The result of no trials.
    const Trials& none() const noexcept { return found; }

private:
    const HandMotion& motion;
    const Demand& demand;
    TrialEffort effort;
    std::stop_token stop;
    std::unique_ptr<Engine> engine;
    std::vector<std::unique_ptr<FreeTool>> tools;
    std::vector<DeviceNumbers> devices_of;
    std::vector<bool> known;
    std::vector<double> thresholds;
    Trials found {};
    std::size_t ticks = 0;
    bool is_over = false;          // no ticks are left
    std::vector<bool> silent {};   // by node; empty if none is

    /// The tool of a role of the demand, and the number of its axis; -1: the tool itself, -2: an axis that is not known.
    struct Owner
    {
        std::size_t tool = 0;
        int axis = -1;
    };
    std::vector<Owner> owners {};   // in the order of the demand

    Owner ownerOf (const RoleDemand& d) const
    {
        Owner o;
        while (o.tool < motion.roles.size() && motion.roles[o.tool].role != d.role)
            ++o.tool;
        if (d.axis.empty()) return o;
        o.axis = indexOf (motion.roles[o.tool].layout.axes, d.axis);
        if (o.axis < 0 || ! tools[o.tool]->moves (static_cast<std::size_t> (o.axis))) o.axis = -2;
        return o;
    }

    bool isFree (std::size_t d) const { return owners[d].axis >= 0 || (owners[d].axis == -1 && known[owners[d].tool]); }

    /// The trial of a coordinate of a tool; null if nothing is judged there.
    Trial* trialOf (std::size_t tool, int axis)
    {
        for (std::size_t d = 0; d < owners.size(); ++d)
            if (owners[d].tool == tool && owners[d].axis == axis && isFree (d)) return &found.by_role[d];
        return nullptr;
    }

    bool isSlow (const DeviceNumbers& n) const { return n.rate && n.rate->value > 0.0 && n.rate->value < (1.0 - 1e-9) * motion.rate_hz; }

    void tick()
    {
        if (stop.stop_requested()) throw Stopped {};
        ++ticks;
        if (silent.empty()) return engine->tick();
        engine->tick ([this] (Plan& plan) noexcept { tickWithout (plan, silent); });
    }

    void silencePlayers()
    {
        if (demand.players.empty()) return;
        silent.assign (engine->newest().flat().nodes.size(), false);
        for (const auto n : demand.players)
            silent[n] = true;
    }

    void holdAt (std::size_t k)
    {
        for (std::size_t r = 0; r < tools.size(); ++r)
            tools[r]->hold (motion.roles[r].readings[k]);
        tick();
    }

    void settle (std::size_t k)
    {
        const auto wait = std::max<std::size_t> (32, static_cast<std::size_t> (0.012 * motion.rate_hz));
        for (std::size_t i = 0; i < wait; ++i)
            holdAt (k);
    }

    Vec3 speedAt (std::size_t role, std::size_t k) const
    {
        const auto& readings = motion.roles[role].readings;
        const auto half = std::max<std::size_t> (1, static_cast<std::size_t> (2.5e-3 * motion.rate_hz));
        const auto from = k > half ? k - half : 0, to = std::min (k + half, readings.size() - 1);
        if (from == to) return Vec3::Zero();
        return (readings[to].position - readings[from].position) * motion.rate_hz / static_cast<double> (to - from);
    }

    std::size_t tickOf (double t_s) const
    {
        return std::min (static_cast<std::size_t> (std::max (0.0, std::round (t_s * motion.rate_hz))), motion.ticks - 1);
    }

    /// The ticks at which the tools are let go, in order.
    std::vector<std::size_t> chosen() const
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
            if (slopes.size() != demand.linked.size() || slopes.empty() || owners[r].axis != -1) continue;
            const auto forceOf = [] (const Slope& s) { return s.force.norm(); };
            pick (static_cast<std::size_t> (std::ranges::max_element (slopes, {}, forceOf) - slopes.begin()));
            std::size_t fastest = 0, lightest = slopes.size();
            const double light = 0.3 * forceOf (*std::ranges::max_element (slopes, {}, forceOf));   // a tool that is hardly pressed takes long to settle
            for (std::size_t i = 0; i < slopes.size(); ++i)
            {
                if (speedAt (owners[r].tool, tickOf (slopes[i].t_s)).norm() > speedAt (owners[r].tool, tickOf (slopes[fastest].t_s)).norm()) fastest = i;
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

    /// The release of all tools at once.
    struct Release
    {
        double along = 0.0, across = 0.0, third = 0.0;   // m; out of the contact, sideways
        double speed = 0.0;                              // times that of the motion
        HeldHand hand {};
        double off() const noexcept { return std::sqrt (along * along + across * across + third * third); }
    };

    /// The hand that makes the loops of the tools swing most at a place, and the largest radius with it.
    std::pair<HeldHand, double> worstHand (std::size_t place) const
    {
        std::pair<HeldHand, double> worst { usualHands()[2], 0.0 };
        for (std::size_t r = 0; r < demand.roles.size(); ++r)
        {
            if (owners[r].axis != -1 || ! isFree (r)) continue;
            const auto first = static_cast<Eigen::Index> (3 * r);
            std::vector<Jacobian> own;
            for (const auto& m : demand.linked[place].responses)
                own.emplace_back (m.block (first, first, 3, 3));
            if (own.empty()) continue;
            const auto* device = &devices_of[owners[r].tool];
            const std::array<const DeviceNumbers*, 3> axes { device, device, device };
            for (const auto& hand : usualHands())
                if (const auto radius = loopRadius (own, axes, 1.0 / motion.rate_hz, hand); radius && *radius > worst.second) worst = { hand, *radius };
        }
        return worst;
    }

    /// The ratio of the damping that the loop at a place needs to that of the device of a role; 0 if it needs none.
    double loadOf (std::size_t role, std::size_t place) const
    {
        const auto& s = demand.roles[role].slopes[place];
        const auto& device = devices_of[owners[role].tool];
        const double load = s.stiffness / motion.rate_hz * (0.5 + (device.delay ? device.delay->value : 0.0)) + s.lag + s.damping;
        return load > 0.0 ? load / (device.damping->value + s.brake) : 0.0;
    }

    bool isLoopKnown (std::size_t role, std::size_t place) const
    {
        return ! demand.roles[role].slopes[place].responses.empty() && ! demand.linked[place].responses.empty();
    }

    /// True if some place is not passive and its loop cannot be computed, as with a friction. Only the trials show then whether the tool rests.
    bool isLoopUnknown() const
    {
        for (std::size_t r = 0; r < demand.roles.size(); ++r)
            for (std::size_t i = 0; i < demand.roles[r].slopes.size() && i < demand.linked.size() && isFree (r) && owners[r].axis == -1; ++i)
                if (! isLoopKnown (r, i) && loadOf (r, i) > 1.0) return true;
        return false;
    }

    /// True if the loops of all tools at a place are known, and would be passive with half of the device's damping, or with a quarter of it if a friction
    /// slips. There, only a few trials are made.
    bool isCalm (std::size_t place) const
    {
        if (place >= demand.linked.size()) return false;
        const double most = demand.linked[place].is_smooth ? 0.5 : 0.25;
        for (std::size_t r = 0; r < demand.roles.size(); ++r)
            if (! isFree (r) || owners[r].axis != -1 || place >= demand.roles[r].slopes.size() || ! isLoopKnown (r, place) || ! (loadOf (r, place) <= most))
                return false;
        return true;
    }

    std::vector<Release> releasesAt (std::size_t at) const
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
        for (std::size_t r = 0; r < tools.size(); ++r)
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

    void tryAt (std::size_t at)
    {
        ++found.places;
        for (std::size_t k = 0; static_cast<double> (k) < 0.1 * motion.rate_hz; ++k)   // until blows on the way no longer ring
            holdAt (at);
        std::vector<Vec3> pushes, outwards, velocities;
        std::vector<std::vector<double>> axis_pushes;
        for (std::size_t r = 0; r < tools.size(); ++r)
        {
            const Vec3 v = speedAt (r, at), f = tools[r]->effort().force;
            Vec3 push = -f;
            // A hand that stops pushes with a force between those that slide the tool forwards and backwards.
            if (v.norm() > 1e-3) push += 0.5 * f.dot (v.normalized()) * v.normalized();
            pushes.push_back (push);
            outwards.push_back (f.norm() > 1e-6 ? Vec3 (f.normalized()) : Vec3 (Vec3::UnitZ()));
            velocities.push_back (v);
            auto& axes = axis_pushes.emplace_back();
            for (std::size_t i = 0; i < tools[r]->axes(); ++i)
                axes.push_back (-tools[r]->effort().axes[static_cast<int> (i)]);
        }
        for (const auto& plan : releasesAt (at))
        {
            if (is_over) return;
            for (std::size_t r = 0; r < tools.size(); ++r)
            {
                const Vec3 out = outwards[r], aside = out.unitOrthogonal(), other = out.cross (aside);
                tools[r]->letGo ({ .off = plan.along * out + plan.across * aside + plan.third * other,
                                   .speed = plan.speed * velocities[r],
                                   .push = pushes[r],
                                   .axis_off = plan.off(),
                                   .axis_push = axis_pushes[r],
                                   .moves = known[r],
                                   .hand = plan.hand });
            }
            run (at, plan);
            settle (at);
            is_over = ticks / most_over >= effort.ticks / std::max<std::size_t> (1, effort.places);
        }
    }

    /// The coordinates of the tools that are free: three for each, then their axes.
    template <typename See>
    void eachCoordinate (See&& see) const
    {
        std::size_t c = 0;
        for (std::size_t r = 0; r < tools.size(); ++r)
        {
            const Vec3 p = tools[r]->motor();
            for (int i = 0; i < 3; ++i)
                see (c++, r, -1, p[i], tools[r]->acting().force[i], tools[r]->pushes().push[i]);
            for (std::size_t i = 0; i < tools[r]->axes(); ++i)
                see (c++, r, static_cast<int> (i), tools[r]->axis (i), tools[r]->acting().axes[static_cast<int> (i)],
                     i < tools[r]->pushes().axis_push.size() ? tools[r]->pushes().axis_push[i] : 0.0);
        }
    }

    void run (std::size_t at, const Release& plan)
    {
        ++found.runs;
        std::vector<Coordinate> all;
        std::vector<double> starts, last;
        std::vector<double> of_graph (tools.size(), 0.0), of_hand (tools.size(), 0.0);   // work in the stretch, in J
        struct Given
        {
            double now = 0.0, most = 0.0;

            void add (double more) noexcept { most = std::max (most, now += more); }
        };
        std::vector<Given> all_of_graph (tools.size()), all_of_hand (tools.size());   // since the start
        eachCoordinate ([&] (std::size_t, std::size_t r, int, double x, double, double) {
            all.emplace_back().threshold = thresholds[3 * r];
            starts.push_back (x);
            last.push_back (x);
        });
        const auto each = std::max<std::size_t> (1, static_cast<std::size_t> (window_s * motion.rate_hz));
        bool is_away = false, is_touched = false;
        int untouched = 0;   // windows
        Vec3 place = tools.front()->motor();
        // The movements in two stretches are compared: before and after the tick `late`.
        auto end = static_cast<std::size_t> (lasts_s * motion.rate_hz), early = end / 3, late = 2 * end / 3;
        const auto step = [&] (std::size_t k) {
            tick();
            eachCoordinate ([&] (std::size_t c, std::size_t r, int, double x, double force, double push) {
                auto& one = all[c];
                one.window.to (x);
                all_of_graph[r].add (force * (x - last[c]));
                all_of_hand[r].add (push * (x - last[c]));
                if (k >= late)
                {
                    one.stretch.to (x);
                    one.of_graph += force * (x - last[c]);
                    one.of_hand += push * (x - last[c]);
                    of_graph[r] += force * (x - last[c]);
                    of_hand[r] += push * (x - last[c]);
                }
                else if (k >= early)
                    one.stretch_before.to (x);
                last[c] = x;
                if (! (std::abs (x - starts[c]) < far_m)) is_away = true;
                is_touched = is_touched || force != 0.0;
            });
            if ((k + 1) % each != 0) return false;
            const auto window = k / each;
            const bool is_quiet = window > 0 && std::ranges::all_of (all, &Coordinate::isQuiet);
            for (auto& one : all)
            {
                if (window > 1) one.swung = std::max (one.swung, one.window.swing());
                one.window_before = std::exchange (one.window, {});
            }
            // A tool without a hand that has left the motion and the graph, and falls along the push, only goes farther.
            const Vec3 now = tools.front()->motor(), fell = now - std::exchange (place, now), push = tools.front()->pushes().push;
            untouched = std::exchange (is_touched, false) ? 0 : untouched + 1;
            if (all.size() == 3 && untouched >= 2 && plan.hand.mass == 0.0 && fell.dot (push) > 0.0
                && lostTools (all, true, [] (std::size_t) { return false; })[0])
            {
                is_away = true;
                all_of_hand[0].add (push.norm() * (far_m - (now - Vec3 (starts[0], starts[1], starts[2])).cwiseAbs().maxCoeff()));   // until it is far
            }
            return is_quiet;
        };
        struct Seen
        {
            std::size_t tool;
            int axis;
            double range;
            bool swings, dies, grows, goes_on;
        };
        std::vector<Seen> seen;
        for (std::size_t k = 0;;)
        {
            for (; k < end && ! is_away; ++k)
                if (step (k)) return;
            seen.clear();
            const auto lost = lostTools (all, is_away, [&] (std::size_t r) { return all_of_graph[r].most > all_of_hand[r].most; });
            eachCoordinate ([&] (std::size_t c, std::size_t r, int axis, double x, double, double) {
                const auto& one = all[c];
                if (lost[r]) return;
                const bool left = ! (std::abs (x - starts[c]) < far_m) && all_of_graph[r].most > all_of_hand[r].most;
                const bool goes_on = ! is_away && one.stretch.range() > one.threshold && one.stretch.range() >= 0.5 * one.stretch_before.range()
                                     && one.of_graph > std::max (0.0, one.of_hand) && of_graph[r] > std::max (0.0, of_hand[r]);
                const bool slides = of_hand[r] > 2.0 * tools[r]->pushes().push.norm() * one.stretch.swing() && of_graph[r] <= of_hand[r];   // over bumps
                const bool may_swing = ! is_away && ! slides;
                const bool swings = may_swing && one.stretch.swing() > one.threshold;
                const bool is_near = may_swing && (one.grows() || one.stretch.swing() > doubtful * one.threshold);
                if (left || swings || goes_on || is_near)
                    seen.push_back ({ r, axis, left ? far_m : one.stretch.range(), swings, one.dies(), one.grows(), ! swings && (left || goes_on) });
            });
            // A tool that only moves on may come to rest later, for example if it falls from a crest into a valley.
            const bool is_clear = std::ranges::none_of (seen, [] (const Seen& s) { return s.goes_on || s.dies || (s.grows && ! s.swings); });
            if (is_away || is_clear || static_cast<double> (2 * end) > (longest_s + 1e-3) * motion.rate_hz)
            {
                found.driven_away += std::ranges::count (lost, true) > 0 ? 1 : 0;
                eachCoordinate ([&] (std::size_t c, std::size_t r, int, double, double, double) {
                    // A tool that hardly swung on its way shows no loop that swings.
                    const bool swung = all[c].swung > 0.5 * std::max (near_off, plan.off());
                    for (std::size_t d = 0; d < owners.size() && lost[r] && swung; ++d)
                        if (owners[d].tool == r) found.by_role[d].is_lost = true;
                });
                break;
            }
            early = end;
            end *= 2;
            late = (early + end) / 2;
            for (auto& one : all)
            {
                one.stretch = one.stretch_before = {};
                one.of_graph = one.of_hand = 0.0;
            }
            std::ranges::fill (of_graph, 0.0);
            std::ranges::fill (of_hand, 0.0);
        }
        for (const auto& s : seen)
        {
            auto* const its = trialOf (s.tool, s.axis);
            const bool is_bad = s.swings || s.goes_on;
            if (its == nullptr) continue;
            const Trial now { .role = its->role,
                              .axis = its->axis,
                              .is_tried = true,
                              .swings = is_bad,
                              .runs_away = s.goes_on,
                              .dies = s.swings && s.dies,
                              .is_doubtful = ! is_bad,
                              .is_lost = its->is_lost,
                              .range = s.range,
                              .after_s = static_cast<double> (late) / motion.rate_hz,
                              .t_s = static_cast<double> (at) / motion.rate_hz,
                              .off = plan.off(),
                              .hand = plan.hand };
            if (isWorse (now, *its)) *its = now;
        }
    }

    /// The tools that the hand has driven away from the motion, for example over the edge of a surface. They count neither as at rest nor as running away.
    template <typename IsDriven>
    std::vector<bool> lostTools (const std::vector<Coordinate>& all, bool is_away, IsDriven&& isDrivenByGraph) const
    {
        std::vector<bool> lost (tools.size(), false);
        eachCoordinate ([&] (std::size_t c, std::size_t r, int axis, double x, double, double) {
            if (axis >= 0 || lost[r]) return;
            const auto i = static_cast<Eigen::Index> (c - firstOf (r));
            double low = 1e300, high = -1e300;
            for (const auto& reading : motion.roles[r].readings)
            {
                low = std::min (low, reading.true_position[i]);
                high = std::max (high, reading.true_position[i]);
            }
            const auto& lately = all[c].stretch;
            const bool is_outside = is_away ? x < low - beside || x > high + beside
                                            : lately.range() > 0.0 && (lately.high < low - beside || lately.low > high + beside);
            lost[r] = is_outside && ! isDrivenByGraph (r);
        });
        return lost;
    }

    std::size_t firstOf (std::size_t tool) const
    {
        std::size_t c = 0;
        for (std::size_t r = 0; r < tool; ++r)
            c += 3 + tools[r]->axes();
        return c;
    }
};
}   // namespace

Trials tryLoops (const Subject& subject, const HandMotion& motion, const Demand& demand, std::span<const RoleDevice> devices, const TrialEffort& effort)
{
    std::vector<std::unique_ptr<TrialRun>> runs;   // one for each place, so that a cut, or a motor that rang, does not last
    runs.push_back (std::make_unique<TrialRun> (subject, motion, demand, devices, effort));
    const auto places = runs.front()->places();
    if (places.empty()) return runs.front()->none();
    while (runs.size() < places.size())
        runs.push_back (std::make_unique<TrialRun> (subject, motion, demand, devices, effort));

    std::vector<Trials> found (places.size());
    sideBySide (places.size(), effort.threads, [&] (std::size_t i) { found[i] = runs[i]->at (places[i]); });
    for (std::size_t i = 1; i < found.size(); ++i)
        add (found.front(), found[i]);
    return std::move (found.front());
}

}   // namespace tactus::check
