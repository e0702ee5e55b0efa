// SPDX-License-Identifier: MIT
#include "role_loops.hpp"

#include <tactus/check/spring_and_damper.hpp>
#include <tactus/text/list_text.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <span>
#include <utility>

namespace tactus::check::judging
{

namespace
{
/// Judges whether a contact is passive and, if it is not, whether its loop comes to rest.
class ContactJudge
{
public:
    ContactJudge (const RoleLoops& l, const JudgeOptions& o) : loops (l), options (o) {}

    void judge (Condition& c) const
    {
        std::string left_out;
        const auto [s, b, sum, value, limit] = countedLoad (left_out);
        const double late = loops.delay() + (s->stiffness > 0.0 ? s->lag / (s->stiffness * loops.period_s) : 0.0);   // d, in ticks
        // A wall damps along its normal, where a friction is stiff along the surface: then b and sigma are of two directions.
        const double own_b = b > 0.0 && s->responses.size() > 1 ? std::max (0.0, springAndDamper (s->responses.front(), loops.period_s).damping) : b;
        const bool is_elsewhere = own_b < 0.5 * b;
        c.text = "sigma " + text (s->stiffness, "N/m") + ", b " + text (b, "N*s/m") + (is_elsewhere ? " along another direction" : "") + ", d "
                 + text (late) + ", T " + text (1e3 * loops.period_s, "ms") + left_out;
        c.damping = own_b;
        c.is_partial = ! left_out.empty();
        if (! loops.numbers.damping) return unknown (c, value, "damping");

        const double held = s->stiffness * loops.period_s;
        c.text += "; sigma T " + text (held, "N*s/m") + (held < own_b + limit ? " < " : " >= ") + "b + B " + text (own_b + limit, "N*s/m") + " (footnote 2"
                  + (is_elsewhere ? ", along sigma)" : ")");
        const auto* const worst = s;   // clang 14 does not capture structured bindings

        // Else the load is that without the textures.
        const bool has_all = std::ranges::any_of (loops.role.slopes, [worst] (const Slope& own) { return &own == worst; });
        auto broken = has_all ? brokenContacts (limit > 0.0 ? value / limit : inf) : std::vector<Contact> {};
        if (broken.empty())
        {
            const auto load = [ticks = 0.5 + late] (double k, double d, double T) { return k * ticks * T + d; };
            const auto node = steepest (*s);
            broken.push_back ({ {}, node ? softer (loops.demand, *node) : Stretch::Softer::unknown, s->stiffness, b, limit, load });
        }
        auto remedy = passiveRemedy (broken, value, loops.dampers(), loops.numbers, loops.period_s);
        if (const auto node = steepestNode (loops.demand, s->by_node); ! node.empty()) remedy += "; the steepest node is " + node;
        decideContact (c, value, limit, remedy);
        if (c.is_partial && ! c.isBroken())   // nothing is said of the whole contact
        {
            c.verdict = Verdict::unknown;
            c.remedy = loops.isOverdamped() ? "first what helps with 'damping', then check again" : "first what helps with 'gain', then check again";
            return;
        }
        if (c.verdict == Verdict::broken) closeLoop (c);
        const auto* const its = &loops.role;
        weigh (loops.demand, options.trials, c, { &its, 1 }, turns(), claimedLoad() <= limit);
        doubtDamper (c);
        blame (c);
    }

private:
    using Load = RoleLoops::Load;

    const RoleLoops& loops;
    const JudgeOptions& options;

    /// The damping that a passive contact needs by the claims of all nodes, wherever the tool goes, in N s/m. The measured load, if the nodes claim no
    /// more than was measured.
    double claimedLoad() const
    {
        constexpr double precision = 1e-3;
        double stiffest = 0.0, exact = 0.0;
        for (const auto& s : loops.role.slopes)
        {
            stiffest = std::max (stiffest, s.stiffness);
            exact = std::max (exact, loops.loadAt (s).total);
        }
        const auto isAbove = [] (double claimed, double measured) { return claimed > (1.0 + precision) * measured; };
        if (! isAbove (loops.role.claimed_stiffness, stiffest) && ! isAbove (loops.role.claimed_damping, loops.virtualDamping())) return exact;
        return loops.role.claimed_stiffness * loops.period_s * (0.5 + loops.delay()) + loops.role.claimed_damping;
    }

    /// True if the force field of this role has a curl at a place, so that no energy belongs to it. Places with friction do not count, because their slopes
    /// differ forwards and backwards.
    bool turns() const
    {
        constexpr double precision = 2e-3;
        const auto first = static_cast<Eigen::Index> (3 * (&loops.role - loops.demand.roles.data()));
        return std::ranges::any_of (loops.demand.linked, [&] (const Linked& place) {
            return place.is_smooth && turnOf (Jacobian (place.settled.block (first, first, 3, 3))) > precision;
        });
    }

    Load largestLoad (const std::vector<Slope>& slopes) const
    {
        auto most = loops.loadAt (slopes.front());
        for (const auto& s : slopes)
            if (const auto load = loops.loadAt (s); load.share() > most.share()) most = load;
        return most;
    }

    /// The load of the whole graph. If it is too large and a texture is too steep on its own, the load without the textures.
    Load countedLoad (std::string& left_out) const
    {
        auto load = largestLoad (loops.role.slopes);
        if (loops.isOverdamped()) left_out = ", without b, because b breaks 'damping'";
        if (! loops.numbers.damping || load.total <= load.limit || loops.role.nominal.empty()) return load;
        for (const auto& t : loops.demand.textures)
            if (t.role == loops.role.role && t.slope > loops.stiffestTexture())
            {
                left_out += ", without the textures, because '" + loops.demand.nodes[t.node].path + "' breaks 'gain'";
                return largestLoad (loops.role.nominal);
            }
        return load;
    }

    /// A place that no place before is like, and the responses of the nodes there, along the force of each.
    struct Place
    {
        const Slope* slope;
        std::vector<NodeResponse> nodes;
    };

    /// Empty if not all responses are known.
    std::vector<Place> places() const
    {
        std::vector<Place> all;
        for (const auto& s : loops.role.slopes)
        {
            const auto& response = loops.responseAt (s);
            if (loops.isOverdamped() || isSlow (loops.demand, loops.numbers) || (response.empty() && s.stiffness > 0.0)) return {};
            if (! all.empty() && all.back().slope->brake == s.brake && isLike (loops.responseAt (*all.back().slope), response)) continue;
            all.push_back ({ &s, nodeResponses (s, response) });
        }
        return all;
    }

    static bool areAtRightAngles (const std::vector<NodeResponse>& nodes)
    {
        constexpr double right = 0.05;   // cosine
        for (auto a = nodes.begin(); a != nodes.end(); ++a)
            for (auto b = nodes.begin(); b != a; ++b)
                if (std::abs (std::inner_product (a->direction.begin(), a->direction.end(), b->direction.begin(), 0.0)) > right) return false;
        return true;
    }

    /// Each node's contact that is not passive on its own, where it is worst, the worst one first. Empty if they do not explain the whole, of which
    /// `share` is the part of what the device has to dissipate to what it can; if they do not act at right angles; and if one pushes.
    std::vector<Contact> brokenContacts (double share) const
    {
        constexpr double explained = 1.05, together = 0.95;   // of the limit: nodes change each other a little, as a wall changes the load of a friction
        std::vector<Contact> all;
        double largest = 0.0;
        const auto known_places = places();
        std::set<std::size_t> acting;
        for (const auto& place : known_places)
            for (const auto& one : place.nodes)
                acting.insert (one.node);
        const bool are_several = acting.size() > 1;
        for (const auto& place : known_places)
        {
            if (! areAtRightAngles (place.nodes)) return {};
            const double own = loops.loadAt (*place.slope).limit, limit = (place.nodes.size() > 1 ? together : 1.0) * own;
            for (const auto& one : place.nodes)
            {
                const double its = one.passivityLoad (loops.numbers, loops.period_s);
                largest = std::max (largest, its / std::max (own, 1e-12));
                if (its <= limit) continue;
                const auto parts = springAndDamper (one.response, loops.period_s);
                if (parts.stiffness < 0.0 || parts.damping < 0.0) return {};
                const auto load = [this, n = one.node, parts] (double stiffness, double damping, double T) {
                    return NodeResponse { n, parts.response (stiffness, damping * loops.period_s / T) }.passivityLoad (loops.numbers, T);
                };
                const auto& path = loops.demand.nodes[one.node].path;
                Contact contact { are_several ? path : std::string(), softer (loops.demand, one.node), parts.stiffness, parts.damping, limit, load };
                const auto known = std::ranges::find (all, contact.node, &Contact::node);
                if (known == all.end())
                    all.push_back (std::move (contact));
                else if (contact.share (loops.period_s) > known->share (loops.period_s))
                    *known = std::move (contact);
            }
        }
        if (explained * largest < share) return {};
        std::ranges::stable_sort (all, std::ranges::greater {}, [&] (const Contact& c) { return c.share (loops.period_s); });
        return all;
    }

    /// Finds which nodes the verdict is about. One that only trials give, or that is not explained by the loops of single nodes, is about the whole.
    void blame (Condition& c) const
    {
        const bool grows = ! c.loops.empty();
        const bool is_passive = c.verdict == Verdict::passive || c.verdict == Verdict::passive_here;
        if (! grows && ! is_passive) return;
        auto nodes = passiveNodes();
        constexpr double explained = 1.05;   // else the steepest direction is no node's own, as in a corner of two walls
        if (! nodes.empty() && nodes.front().passive_up_to > explained * c.limit / c.value) nodes.clear();
        if (! grows)
        {
            c.loops = std::move (nodes);
            return;
        }
        for (auto& loop : c.loops)
            if (const auto at = std::ranges::find (nodes, loop.node, &Condition::Loop::node); at != nodes.end()) loop.passive_up_to = at->passive_up_to;
        if (c.verdict == Verdict::stable && ! nodes.empty()) std::ranges::stable_sort (c.loops, {}, &Condition::Loop::passive_up_to);
    }

    /// How many times each node's response could be as large and passive, in its own loop at every place. Empty if not all loops are known.
    std::vector<Condition::Loop> passiveNodes() const
    {
        std::vector<Condition::Loop> nodes;
        for (const auto& place : places())
        {
            const double limit = loops.loadAt (*place.slope).limit;
            for (const auto& one : place.nodes)
            {
                const double load = one.passivityLoad (loops.numbers, loops.period_s), room = load > 0.0 ? limit / load : inf;
                const auto& path = loops.demand.nodes[one.node].path;
                const auto known = std::ranges::find (nodes, path, &Condition::Loop::node);
                if (known == nodes.end())
                    nodes.push_back ({ path, room });
                else
                    known->passive_up_to = std::min (known->passive_up_to, room);
            }
        }
        std::ranges::stable_sort (nodes, {}, &Condition::Loop::passive_up_to);
        return nodes;
    }

    /// A damper that grows with the speed may swing only after a hard blow, harder than those of the trials.
    void doubtDamper (Condition& c) const
    {
        if (! c.isKnown() || c.isBroken() || loops.isOverdamped() || ! loops.numbers.mass || ! loops.numbers.damping) return;
        if (loops.role.claimed_damping < loops.largestDamper()) return;
        c.verdict = Verdict::unknown;
        c.text += "; after a hard blow, it may swing: at more speed than here, the virtual damping is up to " + text (loops.role.claimed_damping, "N*s/m");
        c.remedy = "a virtual damping that is at any speed " + below (loops.largestDamper(), "N*s/m");
    }

    /// The node with the steepest force at a place.
    static std::optional<std::size_t> steepest (const Slope& s)
    {
        const auto most = std::ranges::max_element (s.by_node);
        if (most == s.by_node.end() || ! (*most > 0.0)) return std::nullopt;
        return static_cast<std::size_t> (most - s.by_node.begin());
    }

    /// True if the node with the steepest force is a friction at the place where this response was measured.
    bool isDragged (const std::vector<double>* response) const
    {
        return std::ranges::any_of (loops.role.slopes, [&] (const Slope& s) {
            const auto node = steepest (s);
            return node && drags (loops.demand, *node) && std::ranges::any_of (s.responses, [&] (const auto& r) { return &r == response; });
        });
    }

    /// True if the loop at a place rests but for the directions in which the settled force pushes the tool away.
    bool falls (const Slope& s) const
    {
        auto response = loops.responseAt (s);
        const Eigen::Matrix3d settled = response.back();
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> parts (0.5 * (settled + settled.transpose()));
        if (! (parts.eigenvalues()[0] < 0.0)) return false;
        Eigen::Matrix3d held = Eigen::Matrix3d::Zero();
        for (int i = 0; i < 3; ++i)
            if (parts.eigenvalues()[i] >= 0.0) held += parts.eigenvectors().col (i) * parts.eigenvectors().col (i).transpose();
        for (auto& m : response)
            m = (held * m * held).eval();
        const auto device = loops.at (s);
        return comesToRest (response, loops.axesOf (device), loops.period_s)
               && std::ranges::all_of (s.responses, [&] (const auto& r) { return r.back() < 0.0 || comesToRest (r, device, loops.period_s); });
    }

    /// A contact that is not passive may still come to rest: judges the loops of all places that are not passive, exactly.
    void closeLoop (Condition& c) const
    {
        std::vector<const Slope*> places;
        for (const auto& s : loops.role.slopes)
        {
            if (const auto load = loops.loadAt (s); load.total <= load.limit) continue;
            if (s.responses.empty() || loops.responseAt (s).empty() || isSlow (loops.demand, loops.numbers)) return noLoop (c);
            if (std::ranges::none_of (places, [&] (const auto* known) { return areLike (*known, s); })) places.push_back (&s);
        }
        if (places.empty()) return;
        const auto radius = [&] (const Slope* s) {
            const auto device = loops.at (*s);
            auto most = largestRadius (loops.responseAt (*s), loops.axesOf (device), loops.period_s);
            for (const auto& r : s->responses)
            {
                const auto along = largestRadius (r, device, loops.period_s);
                most = most && along ? std::optional (std::max (*most, *along)) : std::nullopt;
            }
            return most;
        };
        const auto rests = [&] (const Slope* s, double factor) {
            auto larger = loops.responseAt (*s);
            for (auto& m : larger)
                m *= factor;
            const auto device = loops.at (*s);
            return comesToRest (larger, loops.axesOf (device), loops.period_s)
                   && std::ranges::all_of (s->responses, [&] (const auto& r) { return comesToRest (scaled (r, factor), device, loops.period_s); });
        };
        closeLoops (c, places, radius, rests, [&] (const Slope* s) { return falls (*s); });
        if (c.verdict == Verdict::broken) return;
        const auto best = bestChange (c, places);
        constexpr double enough = 1.02;   // the changed graph moves a little otherwise, so its slopes differ
        if (! best || best->room <= c.may_grow || (c.verdict == Verdict::unstable && best->room < enough && ! (c.may_grow > 0.0))) return;
        if (c.verdict == Verdict::unstable && best->room < enough)   // no single change suffices
        {
            const double weakest = c.loops.empty() ? c.may_grow : std::min (c.may_grow, c.loops.front().may_grow);
            c.remedy = (isStretched (c) ? "a d_max " + atLeast (1.0 / weakest, "times") + " as long"
                                        : atMost (weakest, "times") + " this stiffness and virtual damping")
                       + ", by the linear loop; " + c.remedy;
        }
        else
            c.remedy = "largest effect on the loop: " + best->what + ", up to " + text (best->room) + " times this response; " + c.remedy;
    }

    /// The change that helps most where the loop is weakest. Sets the loops of the nodes there, if one of them explains how much the response may grow.
    std::optional<Change> bestChange (Condition& c, const std::vector<const Slope*>& places) const
    {
        constexpr std::size_t closest = 4;
        constexpr double explained = 1.05;
        const Slope* weakest = nullptr;
        std::vector<NodeLoop> by_node;
        for (const auto* s : std::span (places).first (std::min (closest, places.size())))
        {
            auto its = nodeLoops (*s, loops.responseAt (*s), loops.at (*s), loops.period_s);
            if (! its.empty() && (by_node.empty() || its[0].may_grow < by_node[0].may_grow))
            {
                by_node = std::move (its);
                weakest = s;
            }
        }
        if (weakest == nullptr || by_node.front().may_grow > explained * c.may_grow)
        {
            const auto radius = [&] (const auto& r) { return largestRadius (r, loops.numbers, loops.period_s).value_or (0.0); };
            const auto& worst = *std::ranges::max_element (places.front()->responses, {}, radius);
            return strongestChange (worst, loops.at (*places.front()), loops.period_s, isDragged (&worst));
        }
        std::vector<std::vector<double>> others;
        std::string rooms;
        for (const auto& loop : by_node)
        {
            const auto& path = loops.demand.nodes[loop.along.node].path;
            c.loops.push_back ({ .node = path, .may_grow = loop.may_grow });
            addToList (rooms, text (loop.may_grow) + " times along the force of '" + path + "'");
            if (&loop != &by_node.front()) others.push_back (loop.along.response);
        }
        if (by_node.size() > 1) c.text += ": " + rooms;
        const auto& first = by_node.front().along;
        return strongestChange (first.response, loops.at (*weakest), loops.period_s, drags (loops.demand, first.node), others);
    }

    /// True if the weakest loop is of a friction whose d_max decides how stiff it is.
    bool isStretched (const Condition& c) const
    {
        return ! c.loops.empty() && std::ranges::any_of (loops.demand.stretches, [&] (const Stretch& s) {
            return s.softer == Stretch::Softer::d_max && loops.demand.nodes[s.node].path == c.loops.front().node;
        });
    }

    bool areLike (const Slope& a, const Slope& b) const
    {
        return isLike (loops.responseAt (a), loops.responseAt (b)) && a.responses.size() == b.responses.size()
               && std::equal (a.responses.begin(), a.responses.end(), b.responses.begin(), [] (const auto& x, const auto& y) { return isLike (x, y); });
    }

    static std::vector<double> scaled (std::vector<double> response, double factor)
    {
        for (double& v : response)
            v *= factor;
        return response;
    }
};
}   // namespace

void judgeContact (const RoleLoops& loops, const JudgeOptions& options, Condition& c) { ContactJudge (loops, options).judge (c); }

}   // namespace tactus::check::judging
