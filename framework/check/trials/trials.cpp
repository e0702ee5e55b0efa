// SPDX-License-Identifier: MIT
#include "trials.hpp"
#include "free_tool.hpp"
#include "trial_starts.hpp"

#include <tactus/check/bench.hpp>
#include <tactus/check/side_by_side.hpp>
#include <tactus/run/engine.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
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
constexpr double least_decay = 0.005;               // per second; near the limit of a contact, a swing dies hardly faster than this
constexpr double steady = 0.9;                      // of the swing: one that was smaller in the stretch before grows
constexpr double window_s = 0.125;
constexpr double far_m = 1.0;
constexpr double beside = 5e-3;        // m outside the motion: too far to count for it
constexpr std::size_t most_over = 4;   // times the planned ticks

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
    bool dies (double stretch_s) const noexcept { return stretch.swing() < (1.0 - least_decay * stretch_s) * stretch_before.swing(); }
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
            tried.known.push_back (is_known);
            DeviceNumbers numbers = at != devices.end() ? at->numbers : DeviceNumbers {};
            if (! is_known) numbers.mass = numbers.damping = DeviceNumber { .value = 1.0 };
            const auto* simulated = at != devices.end() && at->simulated ? &*at->simulated : nullptr;
            auto layout = role.layout;
            if (simulated != nullptr) layout.brake = simulated->brake;
            tools.push_back (std::make_unique<FreeTool> (numbers, layout, simulated, m.rate_hz));
            GuardLimits limits;
            if (numbers.peak_force) limits.max_force = numbers.peak_force->value;
            engine->attach (role.role, *tools.back(), limits);
            tried.numbers.push_back (numbers);
            found.are_dry = found.are_dry || (is_known && numbers.coulomb && numbers.coulomb->value > 0.0);
            for (int i = 0; i < 3; ++i)
                thresholds.push_back (std::max (least_swing, 2.0 * (numbers.quantum ? numbers.quantum->value : 0.0)));
        }
        for (const auto& role : demand.roles)
        {
            found.by_role.push_back ({ .role = role.role, .axis = role.axis });
            tried.owners.push_back (ownerOf (role));
        }
    }

    /// The places of the motion at which the tools are let go, as ticks, in order. Empty if no tool is free.
    std::vector<std::size_t> places() const
    {
        for (std::size_t d = 0; d < tried.owners.size(); ++d)
            if (motion.ticks > 0 && tried.isFree (d)) return starts.places();
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
        for (std::size_t d = 0; d < tried.owners.size(); ++d)
            found.by_role[d].is_tried = tried.isFree (d) && (found.by_role[d].swings || ! is_over);
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
    TriedTools tried {};
    TrialStarts starts { motion, demand, tried, effort };
    std::vector<double> thresholds;
    Trials found {};
    std::size_t ticks = 0;
    bool is_over = false;          // no ticks are left
    std::vector<bool> silent {};   // by node; empty if none is

    TriedTools::Owner ownerOf (const RoleDemand& d) const
    {
        TriedTools::Owner o;
        while (o.tool < motion.roles.size() && motion.roles[o.tool].role != d.role)
            ++o.tool;
        if (d.axis.empty()) return o;
        o.axis = indexOf (motion.roles[o.tool].layout.axes, d.axis);
        if (o.axis < 0 || ! tools[o.tool]->moves (static_cast<std::size_t> (o.axis))) o.axis = -2;
        return o;
    }

    /// The trial of a coordinate of a tool; null if nothing is judged there.
    Trial* trialOf (std::size_t tool, int axis)
    {
        for (std::size_t d = 0; d < tried.owners.size(); ++d)
            if (tried.owners[d].tool == tool && tried.owners[d].axis == axis && tried.isFree (d)) return &found.by_role[d];
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

    void tryAt (std::size_t at)
    {
        ++found.places;
        for (std::size_t k = 0; static_cast<double> (k) < 0.1 * motion.rate_hz; ++k)   // until blows on the way no longer ring
            holdAt (at);
        std::vector<Vec3> pushes, outwards, velocities;
        std::vector<std::vector<double>> axis_pushes;
        for (std::size_t r = 0; r < tools.size(); ++r)
        {
            const Vec3 v = starts.speedAt (r, at), f = tools[r]->effort().force;
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
        for (const auto& plan : starts.releasesAt (at))
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
                                   .moves = tried.known[r],
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
            const double stretch_s = static_cast<double> (end - late) / motion.rate_hz;
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
                    seen.push_back ({ r, axis, left ? far_m : one.stretch.range(), swings, one.dies (stretch_s), one.grows(), ! swings && (left || goes_on) });
            });
            // A tool that only moves on may come to rest later, for example if it falls from a crest into a valley.
            const bool is_clear = std::ranges::none_of (seen, [] (const Seen& s) { return s.goes_on || s.dies || (s.grows && ! s.swings); });
            if (is_away || is_clear || static_cast<double> (2 * end) > (longest_s + 1e-3) * motion.rate_hz)
            {
                found.driven_away += std::ranges::count (lost, true) > 0 ? 1 : 0;
                eachCoordinate ([&] (std::size_t c, std::size_t r, int, double, double, double) {
                    // A tool that hardly swung on its way shows no loop that swings.
                    const bool swung = all[c].swung > 0.5 * std::max (near_off, plan.off());
                    for (std::size_t d = 0; d < tried.owners.size() && lost[r] && swung; ++d)
                        if (tried.owners[d].tool == r) found.by_role[d].is_lost = true;
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

namespace
{
Trials tryEach (const Subject& subject, const HandMotion& motion, const Demand& demand, std::span<const RoleDevice> devices, const TrialEffort& effort)
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
}   // namespace

Trials tryLoops (const Subject& subject, const HandMotion& motion, const Demand& demand, std::span<const RoleDevice> devices, const TrialEffort& effort)
{
    const auto rests = [] (const Trial& t) { return ! t.swings && ! t.is_doubtful && ! t.is_lost; };
    auto tried = tryEach (subject, motion, demand, devices, effort);
    if (demand.modulated.empty() || std::ranges::all_of (tried.by_role, rests)) return tried;

    auto quiet = demand;
    std::ranges::copy (demand.modulated, std::back_inserter (quiet.players));
    const auto without = tryEach (subject, motion, quiet, devices, effort);
    for (std::size_t r = 0; r < tried.by_role.size(); ++r)
        tried.by_role[r].rests_without = ! rests (tried.by_role[r]) && without.by_role[r].is_tried && rests (without.by_role[r]);
    return tried;
}

}   // namespace tactus::check
