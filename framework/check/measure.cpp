// SPDX-License-Identifier: MIT
#include "measure.hpp"
#include "bench.hpp"
#include "players.hpp"
#include "slopes.hpp"
#include "stretches.hpp"
#include "textures.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

namespace tactus::check
{

namespace
{
constexpr double speed_window_s = 5e-3;   // speeds are means over this time; over one tick, a recording that holds samples would give peaks

/// The velocity of a tool at a tick, in m/s.
Vec3 velocityAt (const HandMotion& motion, std::size_t role, std::size_t tick)
{
    const auto half = static_cast<std::size_t> (std::max (1.0, std::round (0.5 * speed_window_s * motion.rate_hz)));
    const auto& readings = motion.roles[role].readings;
    const auto first = tick > half ? tick - half : 0, last = std::min (tick + half, readings.size() - 1);
    if (last == first) return Vec3::Zero();
    return (readings[last].position - readings[first].position) * (motion.rate_hz / static_cast<double> (last - first));
}

/// The nodes on a path from a source of a role to a sink of the same role; if the role is empty, from a source to a sink of any roles.
std::vector<bool> nodesOf (const Plan& plan, const std::string& role)
{
    const auto& flat = plan.flat();
    const auto reached = [&] (bool forwards) {
        std::vector<std::vector<int>> next (flat.nodes.size());   // by node
        for (const auto& w : flat.wires)
            if (w.from) next[static_cast<std::size_t> (forwards ? w.from->node : w.to.node)].push_back (forwards ? w.to.node : w.from->node);
        std::vector<bool> is (flat.nodes.size(), false);
        std::vector<int> open;
        for (int n = 0; n < flat.nodeCount(); ++n)
        {
            const auto& node = flat.node (n);
            if (node.runs() && (role.empty() || node.role == role) && node.type->bind != nullptr
                && (node.type->effort == nullptr) == forwards) open.push_back (n);
        }
        while (! open.empty())
        {
            const int n = open.back();
            open.pop_back();
            if (is[static_cast<std::size_t> (n)]) continue;
            is[static_cast<std::size_t> (n)] = true;
            std::ranges::copy (next[static_cast<std::size_t> (n)], std::back_inserter (open));
        }
        return is;
    };
    auto both = reached (true);
    const auto back = reached (false);
    for (std::size_t n = 0; n < both.size(); ++n)
        both[n] = both[n] && back[n] && flat.nodes[n].runs();
    return both;
}

std::vector<StretchWatch> stretchesIn (const Plan& plan)
{
    std::vector<StretchWatch> all;
    for (std::size_t n = 0; n < plan.flat().nodes.size(); ++n)
        if (auto watch = StretchWatch::of (plan, n)) all.push_back (std::move (*watch));
    return all;
}

/// Does the work of measure().
class Survey
{
public:
    Survey (const Subject& s, const HandMotion& m) : subject (s), plan (compiled (s, m)), motion (withAxes (m, *plan)) {}

    Demand measure (const Thoroughness& how)
    {
        demand.rate_hz = motion.rate_hz;
        demand.lasts_s = static_cast<double> (motion.ticks) / motion.rate_hz;
        for (const auto& node : plan->flat().nodes)
            demand.nodes.push_back ({ node.path, std::string (node.type->info.id) });
        followMotion();
        for (std::size_t r = 0; r < motion.roles.size(); ++r)
            addRole (r);
        addGiven();
        addSlopes (how);
        textures.addTo (demand, { subject, motion, forces, velocities, directions, between }, how);
        return std::move (demand);
    }

private:
    const Subject& subject;
    std::shared_ptr<Plan> plan;   // never runs; each bench compiles its own plan
    HandMotion motion;            // with axes
    Demand demand {};
    Forces forces {};
    Textures textures {};
    std::vector<Directions> directions {};          // by role, then node
    std::vector<std::vector<bool>> between {};      // by role, then node: the nodes between its sources and its sinks
    std::vector<std::vector<Vec3>> velocities {};   // of the tools, by role, then tick, in m/s

    static std::shared_ptr<Plan> compiled (const Subject& s, const HandMotion& m)
    {
        auto options = s.options;
        options.rate_hz = m.rate_hz;
        return compile (s.graph, s.catalogue, options).plan;
    }

    /// Runs the graph once along the motion.
    void followMotion()
    {
        std::vector<StretchWatch> stretches;
        PlayerSearch players (motion.ticks);
        const auto striking = strikers (plan->flat());   // silent where players are looked for: a node that only rings after a hit is none
        std::size_t ticks = 0;
        forces = forcesAlong (subject, motion, {}, [&] (const Plan& running) {
            if (ticks == 0)
            {
                stretches = stretchesIn (running);
                textures.find (running);
            }
            if (striking.empty()) players.poll (running);
            for (auto& w : stretches)
                w.poll (running, ticks);
            textures.poll (running, ticks);
            ++ticks;
        });
        if (! striking.empty()) forcesAlong (subject, motion, striking, [&] (const Plan& running) { players.poll (running); });
        demand.players = players.found();
        demand.modulated = modulatedPlayers (subject, plan->flat(), motion, forces);
        for (std::size_t r = 0; r < motion.roles.size(); ++r)
        {
            const auto& role = motion.roles[r];
            const auto& its = between.emplace_back (nodesOf (*plan, role.role));
            for (const auto& w : stretches)
            {
                if (! its[w.node()] || role.axis) continue;
                if (w.shortest() < inf)
                    demand.stretches.push_back ({ w.node(), role.role, w.shortest(), w.teeth(), fastestAt (r, w.feltTicks()), w.softer() });
                else if (! w.wasFelt())
                    demand.unreached.push_back ({ w.node(), role.role, false });
            }
        }
    }

    /// The largest speed of the tool at these ticks, in m/s.
    double fastestAt (std::size_t r, const std::vector<std::size_t>& ticks) const
    {
        double most = 0.0;
        for (const auto k : ticks)
            most = std::max (most, velocityAt (motion, r, k).norm());
        return most;
    }

    void addRole (std::size_t r)
    {
        const auto& role = motion.roles[r];
        RoleDemand d { .role = role.role, .axis = role.axis ? role.axis->name : "" };
        for (const auto& path : plan->delays())
            if (belongs (path.source, role.role) && belongs (path.sink, role.role))
                d.longest = std::max (d.longest, path.longest);
        auto& velocity = velocities.emplace_back();
        for (std::size_t k = 0; k < motion.ticks; ++k)
        {
            velocity.push_back (velocityAt (motion, r, k));
            d.peak_force = std::max (d.peak_force, forces[r][k].norm());
            if (k > 0) d.fastest_force = std::max (d.fastest_force, (forces[r][k] - forces[r][k - 1]).norm() * motion.rate_hz);
            d.speed = std::max (d.speed, velocity.back().norm());
        }
        if (! role.axis) d.others = otherSinks (role.role);
        lookAtClaims (d, between[r]);
        demand.roles.push_back (std::move (d));
    }

    /// The energy that the graph has taken so far, and the most that it has given beyond that, both in J.
    struct Energy
    {
        double taken = 0.0, given = 0.0;

        void add (double more) noexcept
        {
            taken += more;
            given = std::max (given, -taken);
        }
    };

    /// The work of the hand on the graph since the tick before, by the mean of the two forces, in J.
    double takenAt (const Forces& of, std::size_t r, std::size_t k) const
    {
        const auto& readings = motion.roles[r].readings;
        return -0.5 * (of[r][k - 1] + of[r][k]).dot (Vec3 (readings[k].position - readings[k - 1].position));
    }

    /// Fills in the energy that the graph gave to each hand, and to all together. It is 0 if the graph already pushes when the motion begins, because then
    /// energy is stored in it.
    void addGiven()
    {
        const auto fill = [&] (const Forces& of) {
            Energy all;
            std::vector<Energy> own (motion.roles.size());
            for (std::size_t k = 1; k < motion.ticks; ++k)
            {
                double more = 0.0;
                for (std::size_t r = 0; r < own.size(); ++r)
                {
                    own[r].add (takenAt (of, r, k));
                    more += takenAt (of, r, k);
                }
                all.add (more);
            }
            const auto isClosed = [&] (std::size_t r) { return of[r].front().norm() <= 1e-3; };
            demand.given_together = all.given;
            for (std::size_t r = 0; r < own.size(); ++r)
            {
                demand.roles[r].given = isClosed (r) ? own[r].given : 0.0;
                if (! isClosed (r)) demand.given_together = 0.0;
            }
        };
        fill (forces);
        const bool is_any = demand.given_together > 0.0 || std::ranges::any_of (demand.roles, [] (const RoleDemand& d) { return d.given > 0.0; });
        if (is_any && ! demand.players.empty()) fill (forcesAlong (subject, motion, demand.players, [] (const Plan&) {}));
    }

    /// Lists the nodes between hand and motor that do not claim to be passive. A claim counts only if no wire drives a param of the node, its position is
    /// that of the tool, and its force goes straight to the tool, times a positive gain.
    void lookAtClaims (RoleDemand& d, const std::vector<bool>& its) const
    {
        const auto& flat = plan->flat();
        for (std::size_t n = 0; n < its.size(); ++n)
        {
            const auto& node = flat.nodes[n];
            if (! its[n] || node.type->bind != nullptr) continue;   // a source or a sink
            const auto claims = node.type->claims != nullptr ? node.type->claims (plan->instances()[n].node.get()) : Claims {};
            double gain = 1.0;
            std::optional<double> onward;   // of the damping
            bool counts = claims.passive && node.section == 0;
            for (const auto& w : flat.wires)
            {
                if (w.to.node == static_cast<int> (n))
                {
                    const bool is_input = w.to.role == Role::input;
                    const auto& id = is_input ? node.type->inputs[at (w.to.port)].id : std::string_view();
                    const bool is_position = id == "position" && w.from && flat.node (*w.from).type->bind != nullptr;
                    if (! (is_position && w.gain == 1.0 && w.delay == 0 && w.to.component < 0) && id != "normal_force") counts = false;
                }
                if (w.from && w.from->node == static_cast<int> (n) && its[at (w.to.node)])
                {
                    const bool is_load = flat.node (w.to).type->bind == nullptr && w.to.role == Role::input
                                         && flat.node (w.to).type->inputs[at (w.to.port)].id == "normal_force";
                    if (is_load) continue;
                    onward = std::max (onward.value_or (0.0), std::abs (w.gain));
                    if (flat.node (w.to).type->bind == nullptr || ! (w.gain > 0.0) || w.delay != 0 || w.to.component >= 0 || w.gain_dimension) counts = false;
                    gain = std::max (gain, w.gain);
                }
            }
            d.dampers += onward.value_or (1.0) * claims.damping;
            if (counts)
            {
                d.claimed_stiffness += gain * claims.stiffness;
                d.claimed_damping += gain * claims.damping;
            }
            else
                d.claims_nothing.push_back (node.path);
        }
        for (const auto& w : flat.wires)   // a wire from a source to a sink is a law of its own
            if (w.from && its[at (w.from->node)] && its[at (w.to.node)] && flat.node (*w.from).type->bind != nullptr && flat.node (w.to).type->bind != nullptr)
                d.claims_nothing.push_back ("the wire to " + flat.node (w.to).path);
    }

    /// Lists the walls of hold.deadbeat, and adds them to the demand. Their response to a shift of a resting tool is not a slope.
    std::vector<std::size_t> findDeadbeats()
    {
        std::vector<std::size_t> all;
        const auto& nodes = plan->flat().nodes;
        for (std::size_t n = 0; n < nodes.size(); ++n)
            if (nodes[n].runs() && nodes[n].type->info.id == "hold.deadbeat") all.push_back (n);
        for (const auto& role : plan->roles())
        {
            const auto its = nodesOf (*plan, role.name);
            for (const auto n : all)
                if (its[n]) demand.deadbeats.push_back (deadbeatAt (n, role.name));
        }
        return all;
    }

    Deadbeat deadbeatAt (std::size_t n, const std::string& role) const
    {
        Deadbeat wall { .node = n,
                        .role = role,
                        .mass = valueInFile (*plan, n, "mass", 0.0),
                        .damping = valueInFile (*plan, n, "damping", 0.0),
                        .stiffness = valueInFile (*plan, n, "stiffness", 0.0) };
        wall.delay = settingInFile (*plan, n, "delay", 0.0);
        bool is_first = true;
        for (const auto& path : plan->delays())
            if (belongs (path.source, role) && belongs (path.sink, role))
            {
                wall.shortest = is_first ? path.shortest : std::min (wall.shortest, path.shortest);
                wall.longest = std::max (wall.longest, path.longest);
                is_first = false;
            }
        return wall;
    }

    /// Measures the slopes of all roles, if the force of any role depends on the position of any role.
    void addSlopes (const Thoroughness& how)
    {
        directions.resize (motion.roles.size());
        if (! hasLoop ("")) return;
        std::vector<SlopeWork> works { { .without = struckNodes() } };
        auto& work = works.front();
        for (const auto& path : plan->delays())
            work.longest_delay = std::max (work.longest_delay, path.longest);
        std::ranges::copy (findDeadbeats(), std::back_inserter (work.without));
        if (how.at_s)
        {
            const double tick = std::clamp (*how.at_s * motion.rate_hz, 0.0, static_cast<double> (motion.ticks) - 1.0);
            work.spots = { { tick, tick } };
        }
        else
            work.spots = chooseSpots (subject, motion, placesWithin (how), work.without, how.ticks / 32);
        if (! textures.areNone())
        {
            auto nominal = work;
            nominal.looks_for_jumps = false;
            std::ranges::copy (textures.nodes(), std::back_inserter (nominal.without));
            works.push_back (std::move (nominal));
        }
        auto found = measureSlopes (subject, motion, works, how.threads);
        auto& all = found.front();
        demand.linked = std::move (all.linked);
        demand.jumps = std::move (all.jumps);
        directions = std::move (all.directions);
        for (std::size_t r = 0; r < motion.roles.size(); ++r)
            if (auto& role = demand.roles[r]; hasLoop (role.role) && (! role.axis.empty() || hasForce (role.role)))
            {
                role.slopes = std::move (all.by_role[r]);
                if (! textures.areNone()) role.nominal = std::move (found.back().by_role[r]);
            }
    }

    /// The number of places for which half of the ticks suffice, but at least least_places.
    std::size_t placesWithin (const Thoroughness& how) const
    {
        constexpr std::size_t least_places = 8, ticks_per_place = 1'600;
        const auto surveys = textures.areNone() ? 1u : 2u;
        return std::min (how.places, std::max (least_places, how.ticks / 2 / (ticks_per_place * surveys * motion.roles.size())));
    }

    std::vector<std::size_t> struckNodes() const
    {
        std::vector<std::size_t> all;
        for (int n = 0; n < plan->flat().nodeCount(); ++n)
            if (isStruck (plan->flat(), n)) all.push_back (at (n));
        return all;
    }

    bool belongs (const std::string& path, const std::string& role) const
    {
        const auto at = std::ranges::find (plan->flat().nodes, path, &plan::FlatNode::path);
        return at != plan->flat().nodes.end() && at->role == role;
    }

    bool hasLoop (const std::string& role) const
    {
        return std::ranges::count (nodesOf (*plan, role), true) > 0;
    }

    /// The efforts of this role that are not judged, for example a torque: all but a force (an input in N with three components), the brake, and axes that
    /// the graph also reads.
    std::vector<std::string> otherSinks (const std::string& role) const
    {
        std::vector<std::string> all;
        hasSink (role, [&] (const plan::FlatNode& node, const PortSheet& row) {
            if (isForce (row) || node.type->info.id == "device.brake") return false;
            const bool is_other = std::ranges::none_of (motion.roles, [&] (const RoleMotion& m) {
                return m.axis && m.role == role && std::ranges::any_of (node.settings, [&] (const auto& value) {
                           const auto* name = std::get_if<std::string> (&value);
                           return name != nullptr && *name == m.axis->name;
                       });
            });
            const auto what = std::string (row.id) + " of '" + node.path + "'";
            if (is_other && std::ranges::count (all, what) == 0) all.push_back (what);
            return false;
        });
        return all;
    }

    bool hasForce (const std::string& role) const
    {
        return hasSink (role, [] (const plan::FlatNode&, const PortSheet& row) { return isForce (row); });
    }

    static bool isForce (const PortSheet& row) { return row.width == 3 && row.unit.unit.symbol == "N"; }

    template <typename Is>
    bool hasSink (const std::string& role, Is&& is) const
    {
        const auto& flat = plan->flat();
        return std::ranges::any_of (flat.wires, [&] (const plan::FlatWire& w) {
            const auto& node = flat.node (w.to);
            return node.runs() && node.role == role && node.type->effort != nullptr && w.to.role == Role::input && is (node, flat.sheet (w.to));
        });
    }
};
}   // namespace

std::size_t affordableTicks (const Plan& plan)
{
    constexpr std::size_t steps_of_nodes = 100'000'000;   // of about 25 ns
    constexpr std::size_t steps_of_search = 400;          // of a node that looks for the place of the tool on a mesh
    std::size_t steps = 0;
    for (const auto& node : plan.flat().nodes)
        steps += node.runs() && node.type->info.id == "deform.surface" ? steps_of_search : 1;
    return steps_of_nodes / std::max<std::size_t> (1, steps);
}

Demand measure (const Subject& subject, const HandMotion& motion, const Thoroughness& how) { return Survey (subject, motion).measure (how); }

}   // namespace tactus::check
