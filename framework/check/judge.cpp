// SPDX-License-Identifier: MIT
#include "contact_changes.hpp"
#include "judging.hpp"
#include "sampled_loop.hpp"
#include "spring_and_damper.hpp"

#include <tactus/text/list_text.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

namespace tactus::check
{

namespace
{
using namespace judging;

/// All conditions of one role.
class RoleJudge
{
public:
    RoleJudge (const Demand& d, const RoleDemand& r, const DeviceNumbers& n, const JudgeOptions& o)
        : demand (d), role (r), numbers (n), options (o), period_s (periodOf (d, n))
    {
    }

    std::vector<Condition> all()
    {
        if (! role.slopes.empty())
        {
            stiffness();
            damping();
            quantum();
            blow();
        }
        jump();
        if (! role.slopes.empty() || role.peak_force > 0.0)
        {
            peakForce();
            slew();
        }
        if (! role.axis.empty()) return std::move (conditions);   // the other conditions are about the tool
        for (const auto& s : demand.stretches)
            if (s.role == role.role) stretch (s), teeth (s);
        for (const auto& wall : demand.deadbeats)
            if (wall.role == role.role) deadbeat (wall);
        for (const auto& t : demand.textures)
            if (t.role == role.role) judgeTexture (demand, t, numbers, options, conditions);
        for (const auto& u : demand.unreached)
            if (u.role == role.role) unreached (u);
        return std::move (conditions);
    }

private:
    const Demand& demand;
    const RoleDemand& role;
    const DeviceNumbers& numbers;
    const JudgeOptions& options;
    double period_s;
    std::vector<Condition> conditions {};
    mutable std::vector<std::vector<Jacobian>> own_responses {};   // by place; findResponses()
    mutable std::vector<std::optional<double>> own_loads {};       // by place; exactLoad()

    using Number = DeviceNumbers::Number;

    double delay() const noexcept { return delayOf (numbers); }

    Condition& add (std::string_view id, std::string_view law, std::string_view unit, std::string sentence)
    {
        return conditions.emplace_back (Condition { .id = id, .role = role.role, .axis = role.axis, .law = law, .unit = unit, .text = std::move (sentence) });
    }

    Condition& add (std::size_t node, std::string_view id, std::string_view law, std::string_view unit, std::string sentence)
    {
        auto& c = add (id, law, unit, std::move (sentence));
        c.node = demand.nodes[node].path;
        return c;
    }

    /// The largest b, in N s/m.
    double virtualDamping() const
    {
        double most = 0.0;
        for (const auto& s : role.slopes)
            most = std::max (most, s.damping);
        return most;
    }

    Dampers dampers() const { return { role.dampers, std::ranges::find (demand.nodes, "hold.predictive", &MeasuredNode::type) != demand.nodes.end() }; }

    double motorMass() const { return check::motorMass (numbers, period_s); }

    /// The largest b at which the virtual damper does not oscillate, in N s/m.
    double largestDamper() const { return check::largestDamper (numbers, period_s); }

    /// True if b breaks the condition `damping`. Then `stiffness` is judged without b, because b would break it too.
    bool isOverdamped() const { return numbers.damping && numbers.mass && ! (virtualDamping() < largestDamper()); }

    /// The largest slope that the device allows a texture, in N/m.
    double stiffestTexture() const { return numbers.damping ? stiffestWall (numbers.damping->value, period_s, delay()) : inf; }

    /// A place, and what the device has to dissipate there, in N s/m.
    struct Load
    {
        const Slope* at;
        double damping;   // b, or 0 if b is left out
        double sum;       // (2d + 1) sigma T/2 + |b|
        double total;     // exactly; the sum if the response is not known
        double limit;     // B, and the brake there

        double share() const noexcept { return total / std::max (limit, 1e-12); }
    };

    Load loadAt (const Slope& s) const
    {
        const double b = isOverdamped() ? 0.0 : s.damping, sum = s.stiffness * period_s * (0.5 + delay()) + s.lag + b;
        return { &s, b, sum, isOverdamped() ? sum : exactLoad (s).value_or (sum), (numbers.damping ? numbers.damping->value : 0.0) + s.brake };
    }

    /// The response of this role's force at a place, in all directions together; empty if it is not known. The nominal slopes have none.
    const std::vector<Jacobian>& responseAt (const Slope& s) const
    {
        static const std::vector<Jacobian> none;
        const auto i = static_cast<std::size_t> (&s - role.slopes.data());
        if (role.slopes.empty() || std::less<> {}(&s, role.slopes.data()) || i >= role.slopes.size()) return none;
        if (own_responses.empty()) findResponses();
        return own_responses[i];
    }

    std::optional<double> exactLoad (const Slope& s) const
    {
        const auto& response = responseAt (s);
        if (response.empty() || isSlow (demand, numbers)) return std::nullopt;
        const auto i = static_cast<std::size_t> (&s - role.slopes.data());
        if (own_loads.empty()) own_loads.resize (role.slopes.size());
        for (std::size_t j = 0; j < i && ! own_loads[i]; ++j)   // many places have the same response
            if (own_loads[j] && isLike (own_responses[j], response)) own_loads[i] = own_loads[j];
        constexpr std::array<double, 3> whole { 1.0, 1.0, 1.0 };
        if (! own_loads[i]) own_loads[i] = passivityLoad (response, axesOf (numbers), whole, period_s);
        return own_loads[i];
    }

    void findResponses() const
    {
        own_responses.resize (role.slopes.size());
        const auto first = static_cast<Eigen::Index> (3 * (&role - demand.roles.data()));
        for (std::size_t i = 0; i < role.slopes.size() && i < demand.linked.size(); ++i)
            for (const auto& m : demand.linked[i].responses)
                own_responses[i].emplace_back (m.block (first, first, 3, 3));
    }

    static std::array<const DeviceNumbers*, 3> axesOf (const DeviceNumbers& n) noexcept { return { &n, &n, &n }; }

    /// The numbers of the device, with its brake as at a place.
    DeviceNumbers at (const Slope& s) const
    {
        auto braked = numbers;
        if (braked.damping) braked.damping->value += s.brake;
        return braked;
    }

    /// The damping that a passive contact needs by the claims of all nodes, wherever the tool goes, in N s/m. The measured load, if the nodes claim no
    /// more than was measured.
    double claimedLoad() const
    {
        constexpr double precision = 1e-3;
        double stiffest = 0.0, exact = 0.0;
        for (const auto& s : role.slopes)
        {
            stiffest = std::max (stiffest, s.stiffness);
            exact = std::max (exact, loadAt (s).total);
        }
        if (role.claimed_stiffness <= (1.0 + precision) * stiffest && role.claimed_damping <= (1.0 + precision) * virtualDamping()) return exact;
        return role.claimed_stiffness * period_s * (0.5 + delay()) + role.claimed_damping;
    }

    /// True if the force field of this role has a curl at a place, so that no energy belongs to it. Places with friction do not count, because their slopes
    /// differ forwards and backwards.
    bool turns() const
    {
        constexpr double precision = 2e-3;
        const auto first = static_cast<Eigen::Index> (3 * (&role - demand.roles.data()));
        return std::ranges::any_of (demand.linked, [&] (const Linked& place) {
            return place.is_smooth && turnOf (Jacobian (place.settled.block (first, first, 3, 3))) > precision;
        });
    }

    Load largestLoad (const std::vector<Slope>& slopes) const
    {
        auto most = loadAt (slopes.front());
        for (const auto& s : slopes)
            if (const auto load = loadAt (s); load.share() > most.share()) most = load;
        return most;
    }

    /// The load of the whole graph. If it is too large and a texture is too steep on its own, the load without the textures.
    Load countedLoad (std::string& left_out) const
    {
        auto load = largestLoad (role.slopes);
        if (isOverdamped()) left_out = ", without b, because b breaks 'damping'";
        if (! numbers.damping || load.total <= load.limit || role.nominal.empty()) return load;
        for (const auto& t : demand.textures)
            if (t.role == role.role && t.slope > stiffestTexture())
            {
                left_out += ", without the textures, because '" + demand.nodes[t.node].path + "' breaks 'gain'";
                return largestLoad (role.nominal);
            }
        return load;
    }

    void stiffness()
    {
        std::string left_out;
        const auto [s, b, sum, value, limit] = countedLoad (left_out);
        const double late = delay() + (s->stiffness > 0.0 ? s->lag / (s->stiffness * period_s) : 0.0);   // d, in ticks
        // A wall damps along its normal, where a friction is stiff along the surface: then b and sigma are of two directions.
        const double own_b = b > 0.0 && s->responses.size() > 1 ? std::max (0.0, springAndDamper (s->responses.front(), period_s).damping) : b;
        const bool is_elsewhere = own_b < 0.5 * b;
        auto& c = add ("stiffness", passive_law, "N*s/m",
                       "sigma " + text (s->stiffness, "N/m") + ", b " + text (b, "N*s/m") + (is_elsewhere ? " along another direction" : "") + ", d "
                           + text (late) + ", T " + text (1e3 * period_s, "ms") + left_out);
        c.damping = own_b;
        c.is_partial = ! left_out.empty();
        if (! numbers.damping) return unknown (c, value, "damping");

        const double held = s->stiffness * period_s;
        c.text += "; sigma T " + text (held, "N*s/m") + (held < own_b + limit ? " < " : " >= ") + "b + B " + text (own_b + limit, "N*s/m") + " (footnote 2"
                  + (is_elsewhere ? ", along sigma)" : ")");
        const auto* const worst = s;   // clang 14 does not capture structured bindings

        // Else the load is that without the textures.
        const bool has_all = std::ranges::any_of (role.slopes, [worst] (const Slope& own) { return &own == worst; });
        auto broken = has_all ? brokenContacts (limit > 0.0 ? value / limit : inf) : std::vector<Contact> {};
        if (broken.empty())
        {
            const auto load = [ticks = 0.5 + late] (double k, double d, double T) { return k * ticks * T + d; };
            const auto node = steepest (*s);
            broken.push_back ({ {}, node ? softer (demand, *node) : Stretch::Softer::unknown, s->stiffness, b, limit, load });
        }
        auto remedy = passiveRemedy (broken, value, dampers(), numbers, period_s);
        if (const auto node = steepestNode (demand, s->by_node); ! node.empty()) remedy += "; the steepest node is " + node;
        decideContact (c, value, limit, remedy);
        if (c.is_partial && ! c.isBroken())   // nothing is said of the whole contact
        {
            c.verdict = Verdict::unknown;
            c.remedy = isOverdamped() ? "first what helps with 'damping', then check again" : "first what helps with 'gain', then check again";
            return;
        }
        if (c.verdict == Verdict::broken) closeLoop (c);
        const auto* const its = &role;
        weigh (demand, options.trials, c, { &its, 1 }, turns(), claimedLoad() <= limit);
        doubtDamper (c);
        blame (c);
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
        for (const auto& s : role.slopes)
        {
            const auto& response = responseAt (s);
            if (isOverdamped() || isSlow (demand, numbers) || (response.empty() && s.stiffness > 0.0)) return {};
            if (! all.empty() && all.back().slope->brake == s.brake && isLike (responseAt (*all.back().slope), response)) continue;
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
            const double own = loadAt (*place.slope).limit, limit = (place.nodes.size() > 1 ? together : 1.0) * own;
            for (const auto& one : place.nodes)
            {
                const double its = one.passivityLoad (numbers, period_s);
                largest = std::max (largest, its / std::max (own, 1e-12));
                if (its <= limit) continue;
                const auto parts = springAndDamper (one.response, period_s);
                if (parts.stiffness < 0.0 || parts.damping < 0.0) return {};
                const auto load = [this, n = one.node, parts] (double stiffness, double damping, double T) {
                    return NodeResponse { n, parts.response (stiffness, damping * period_s / T) }.passivityLoad (numbers, T);
                };
                const auto& path = demand.nodes[one.node].path;
                Contact contact { are_several ? path : std::string(), softer (demand, one.node), parts.stiffness, parts.damping, limit, load };
                const auto known = std::ranges::find (all, contact.node, &Contact::node);
                if (known == all.end())
                    all.push_back (std::move (contact));
                else if (contact.share (period_s) > known->share (period_s))
                    *known = std::move (contact);
            }
        }
        if (explained * largest < share) return {};
        std::ranges::stable_sort (all, std::ranges::greater {}, [&] (const Contact& c) { return c.share (period_s); });
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
            const double limit = loadAt (*place.slope).limit;
            for (const auto& one : place.nodes)
            {
                const double load = one.passivityLoad (numbers, period_s), room = load > 0.0 ? limit / load : inf;
                const auto& path = demand.nodes[one.node].path;
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
        if (! c.isKnown() || c.isBroken() || isOverdamped() || ! numbers.mass || ! numbers.damping || role.claimed_damping < largestDamper()) return;
        c.verdict = Verdict::unknown;
        c.text += "; after a hard blow, it may swing: at more speed than here, the virtual damping is up to " + text (role.claimed_damping, "N*s/m");
        c.remedy = "a virtual damping that is at any speed " + below (largestDamper(), "N*s/m");
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
        return std::ranges::any_of (role.slopes, [&] (const Slope& s) {
            const auto node = steepest (s);
            return node && drags (demand, *node) && std::ranges::any_of (s.responses, [&] (const auto& r) { return &r == response; });
        });
    }

    /// True if the loop at a place rests but for the directions in which the settled force pushes the tool away.
    bool falls (const Slope& s) const
    {
        auto response = responseAt (s);
        const Eigen::Matrix3d settled = response.back();
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> parts (0.5 * (settled + settled.transpose()));
        if (! (parts.eigenvalues()[0] < 0.0)) return false;
        Eigen::Matrix3d held = Eigen::Matrix3d::Zero();
        for (int i = 0; i < 3; ++i)
            if (parts.eigenvalues()[i] >= 0.0) held += parts.eigenvectors().col (i) * parts.eigenvectors().col (i).transpose();
        for (auto& m : response)
            m = (held * m * held).eval();
        const auto device = at (s);
        return comesToRest (response, axesOf (device), period_s)
               && std::ranges::all_of (s.responses, [&] (const auto& r) { return r.back() < 0.0 || comesToRest (r, device, period_s); });
    }

    /// A contact that is not passive may still come to rest: judges the loops of all places that are not passive, exactly.
    void closeLoop (Condition& c) const
    {
        std::vector<const Slope*> places;
        for (const auto& s : role.slopes)
        {
            if (const auto load = loadAt (s); load.total <= load.limit) continue;
            if (s.responses.empty() || responseAt (s).empty() || isSlow (demand, numbers)) return noLoop (c);
            if (std::ranges::none_of (places, [&] (const auto* known) { return areLike (*known, s); })) places.push_back (&s);
        }
        if (places.empty()) return;
        const auto radius = [&] (const Slope* s) {
            const auto device = at (*s);
            auto most = largestRadius (responseAt (*s), axesOf (device), period_s);
            for (const auto& r : s->responses)
            {
                const auto along = largestRadius (r, device, period_s);
                most = most && along ? std::optional (std::max (*most, *along)) : std::nullopt;
            }
            return most;
        };
        const auto rests = [&] (const Slope* s, double factor) {
            auto larger = responseAt (*s);
            for (auto& m : larger)
                m *= factor;
            const auto device = at (*s);
            return comesToRest (larger, axesOf (device), period_s)
                   && std::ranges::all_of (s->responses, [&] (const auto& r) { return comesToRest (scaled (r, factor), device, period_s); });
        };
        closeLoops (c, places, radius, rests, [&] (const Slope* s) { return falls (*s); });
        if (c.verdict == Verdict::broken) return;
        const auto best = bestChange (c, places);
        constexpr double enough = 1.02;   // the changed graph moves a little otherwise, so its slopes differ
        if (! best || best->room <= c.may_grow || (c.verdict == Verdict::unstable && best->room < enough && ! (c.may_grow > 0.0))) return;
        if (c.verdict == Verdict::unstable && best->room < enough)   // no single change suffices
        {
            const double weakest = c.loops.empty() ? c.may_grow : std::min (c.may_grow, c.loops.front().may_grow);
            c.remedy = atMost (weakest, "times") + " this stiffness and virtual damping, by the linear loop; " + c.remedy;
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
        std::vector<NodeLoop> loops;
        for (const auto* s : std::span (places).first (std::min (closest, places.size())))
            if (auto its = nodeLoops (*s, responseAt (*s), at (*s), period_s); ! its.empty() && (loops.empty() || its[0].may_grow < loops[0].may_grow))
            {
                loops = std::move (its);
                weakest = s;
            }
        if (weakest == nullptr || loops.front().may_grow > explained * c.may_grow)
        {
            const std::vector<double>* worst = &places.front()->responses.front();
            for (const auto& r : places.front()->responses)
                if (largestRadius (r, numbers, period_s).value_or (0.0) > largestRadius (*worst, numbers, period_s).value_or (0.0)) worst = &r;
            return strongestChange (*worst, at (*places.front()), period_s, isDragged (worst));
        }
        std::vector<std::vector<double>> others;
        std::string rooms;
        for (const auto& loop : loops)
        {
            const auto& path = demand.nodes[loop.along.node].path;
            c.loops.push_back ({ .node = path, .may_grow = loop.may_grow });
            addToList (rooms, text (loop.may_grow) + " times along the force of '" + path + "'");
            if (&loop != &loops.front()) others.push_back (loop.along.response);
        }
        if (loops.size() > 1) c.text += ": " + rooms;
        const auto& first = loops.front().along;
        return strongestChange (first.response, at (*weakest), period_s, drags (demand, first.node), others);
    }

    bool areLike (const Slope& a, const Slope& b) const
    {
        return isLike (responseAt (a), responseAt (b)) && a.responses.size() == b.responses.size()
               && std::equal (a.responses.begin(), a.responses.end(), b.responses.begin(), [] (const auto& x, const auto& y) { return isLike (x, y); });
    }

    static std::vector<double> scaled (std::vector<double> response, double factor)
    {
        for (double& v : response)
            v *= factor;
        return response;
    }

    void damping()
    {
        const double most = virtualDamping();
        auto& c = add ("damping", "b < 2M/T + 4B/3", "N*s/m", "b " + text (most, "N*s/m") + ", T " + text (1e3 * period_s, "ms"));
        if (! numbers.damping) return unknown (c, most, "damping");
        if (! numbers.mass) return unknown (c, most, "mass");
        const double limit = largestDamper();
        if (motorMass() < numbers.mass->value) c.text += ", M " + text (motorMass(), "kg") + " at the motor";
        std::vector<std::string> ways { "a virtual damping " + below (limit, "N*s/m") };
        if (const auto rate = rateForDamper (most); rate && reaches (numbers, *rate)) ways.push_back ("a rate " + above (*rate, "Hz"));
        decide (c, most, limit, Strict::yes, 1.0, anyOf (ways));
    }

    /// The rate above which a virtual damper does not oscillate, within a thousandth. Empty if there is none.
    std::optional<double> rateForDamper (double damper) const
    {
        const auto rests = [&] (double rate) { return damper < check::largestDamper (numbers, 1.0 / rate); };
        double low = 1.0 / period_s, high = low;
        for (int doubled = 0; doubled < 20 && ! rests (high); ++doubled)
            low = std::exchange (high, 2.0 * high);
        if (! rests (high)) return std::nullopt;
        while (high > 1.001 * low)
            (rests (0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
        return high;
    }

    void quantum()
    {
        const double most = steepest();
        auto& c = add ("quantum", "sigma delta/2 <= f_f", "N", "sigma " + text (most, "N/m"));
        if (! numbers.quantum) return unknown (c, 0.0, "quantum");
        const double delta = numbers.quantum->value, value = 0.5 * most * delta;
        c.text += ", delta " + text (1e6 * delta, "um");
        if (! numbers.coulomb && value > 0.0) return unknown (c, value, "Coulomb friction");
        const double limit = numbers.coulomb ? numbers.coulomb->value : 0.0;
        std::vector<std::string> ways;
        if (limit > 0.0) ways = { "a stiffness of " + atMost (2.0 * limit / delta, "N/m"), "a quantum of " + atMost (2e6 * limit / most, "um") };
        ways.push_back ("a device with a dry friction of " + atLeast (value, "N"));
        decide (c, value, limit, Strict::no, 1.0, anyOf (ways));
    }

    /// Judges a damper that computes the speed from the last positions: each step of the sensor is a blow, which lasts as long as its window.
    void blow()
    {
        double most = 0.0;   // N/m
        for (const auto& s : role.slopes)
        {
            const auto& response = responseAt (s);
            if (response.empty()) most = std::max (most, s.damping / period_s);
            for (const auto& m : response)
                most = std::max (most, Jacobian (m - response.back()).norm());
        }
        if (! (most * period_s > 1e-3 * steepest() * period_s) || ! (virtualDamping() > 0.0)) return;
        auto& c = add ("blow", "b delta/T <= f_f", "N",
                       "b " + text (virtualDamping(), "N*s/m") + ", as if over " + text (1e3 * virtualDamping() / most, "ms"));
        if (! numbers.quantum) return unknown (c, 0.0, "quantum");
        const double delta = numbers.quantum->value, value = most * delta;
        c.text += ", delta " + text (1e6 * delta, "um") + ": each step of the sensor is a blow of b delta/T " + text (value, "N");
        if (! numbers.coulomb && value > 0.0) return unknown (c, value, "Coulomb friction");
        const double limit = numbers.coulomb ? numbers.coulomb->value : 0.0;
        std::vector<std::string> ways;
        if (dampers().are_predicted && dampers().leaveUnclaimed (virtualDamping()))
            ways.emplace_back (smaller_b);
        else if (limit > 0.0)
        {
            ways.push_back ("a window of " + atLeast (1e3 * virtualDamping() * delta / limit, "ms")
                            + " for the speed (the setting \"window\" or a motion.velocity)");
            ways.push_back ("a virtual damping of " + atMost (virtualDamping() * limit / value, "N*s/m"));
        }
        else
            ways.emplace_back ("no virtual damping");
        if (limit > 0.0) ways.push_back ("a quantum of " + atMost (1e6 * delta * limit / value, "um"));
        ways.push_back ("a device with a dry friction of " + atLeast (value, "N"));
        decide (c, value, limit, Strict::no, 1.0, anyOf (ways));
    }

    /// A force that steps by F changes by F from one step of the sensor to the next, so its slope is at least F/delta.
    void jump()
    {
        const Jump* most = nullptr;
        for (const auto& j : demand.jumps)
            if (j.role == role.role && (most == nullptr || j.force > most->force)) most = &j;
        if (most == nullptr) return;
        auto& c = add ("jump", "(2d + 1) F T/(2 delta) <= B", "N*s/m",
                       "the force steps by F " + text (most->force, "N") + " against the movement at " + text (most->t_s, "s"));
        if (most->node) c.node = demand.nodes[*most->node].path;
        if (! numbers.quantum) return unknown (c, 0.0, "quantum");
        const double delta = numbers.quantum->value, value = most->force * period_s * (0.5 + delay()) / delta;
        c.text += ", delta " + text (1e6 * delta, "um");
        if (! numbers.damping) return unknown (c, value, "damping");
        const double limit = numbers.damping->value;
        decide (c, value, limit, Strict::no, 1.0,
                limit > 0.0 ? "a force that rises over " + atLeast (1e3 * most->force / stiffestWall (limit, period_s, delay()), "mm")
                            : std::string ("a force that does not step"));
    }

    void peakForce()
    {
        auto& c = add ("peak_force", "|f| <= f_max", "N", "the largest force along the motion");
        if (! numbers.peak_force) return unknown (c, role.peak_force, "peak force");
        decide (c, role.peak_force, numbers.peak_force->value, Strict::no, 1.0,
                "weaker forces, or a device that gives " + atLeast (role.peak_force, "N"));
    }

    /// A structure that follows a sine of the amplitude f_max up to F_0 follows changes of force of up to 2 pi F_0 f_max.
    void slew()
    {
        auto& c = add ("slew", "|df/dt| <= 2 pi F_0 f_max", "N/s", "the fastest change of force along the motion, from tick to tick");
        if (! numbers.first_mode) return unknown (c, role.fastest_force, "first mode");
        if (! numbers.peak_force && numbers.first_mode->value < inf) return unknown (c, role.fastest_force, "peak force");
        const double limit = numbers.first_mode->value < inf ? 2.0 * std::numbers::pi * numbers.first_mode->value * numbers.peak_force->value : inf;
        const auto stiffer = "a device whose first mode is " + atLeast (numbers.first_mode->value * role.fastest_force / std::max (limit, 1e-300), "Hz");
        const bool is_contact = steepest() * role.speed >= 0.5 * role.fastest_force;   // a filter in its loop would make it swing
        decide (c, role.fastest_force, limit, Strict::no, 1.0,
                is_contact ? "a softer contact, slower strokes, or " + stiffer
                           : "a filter.butterworth2 at " + text (numbers.first_mode->value, "Hz") + " before the motor, a softer onset, or " + stiffer);
    }

    /// The largest stiffness along the motion, in N/m.
    double steepest() const
    {
        double most = 0.0;
        for (const auto& s : role.slopes)
            most = std::max (most, s.stiffness);
        return most;
    }

    void stretch (const Stretch& s)
    {
        const bool has_teeth = s.teeth > 0.0 && s.teeth < s.d_max;
        const double limit = has_teeth ? s.teeth : s.d_max;
        auto& c = add (s.node, "d_max", "delta < d_max, preferably 10 delta < d_max", "m",
                       "slides at a stretch of " + text (1e6 * s.d_max, "um") + (has_teeth ? ", with teeth of " + text (1e6 * s.teeth, "um") : ""));
        if (! numbers.quantum) return unknown (c, 0.0, "quantum");
        const double delta = numbers.quantum->value;
        decide (c, delta, limit, Strict::yes, Factors::better,
                (has_teeth ? "teeth " : "a stretch ") + above (1e7 * delta, "um") + (has_teeth ? " (d_max times static_ratio - 1)" : "")
                    + ", or a quantum " + below (1e5 * limit, "um"));
    }

    /// A hand that crosses a tooth in less than a tick feels teeth of another length.
    void teeth (const Stretch& s)
    {
        if (s.teeth > 0.0) judgeTeeth (demand, s, numbers, options, add (s.node, "scanning", "alpha k v T < 1", "1", ""));
    }

    /// The node computes the speed from the last positions, and the forces that change it within two ticks. A position that is wrong by
    /// delta then causes a force of about M delta/T^2.
    void deadbeat (const Deadbeat& wall)
    {
        judgeDeadbeat (demand, wall, numbers, add (wall.node, "deadbeat", "d and M as assumed, M delta/(2 T^2) <= f_f", "N", ""));
    }

    void unreached (const Unreached& u)
    {
        const auto conditions_of = u.renders_texture ? "its texture" : "the stretch at which it slides";
        auto& c = add (u.node, "reach", "the motion reaches the node", "1", std::string ("the node gave no force, so ") + conditions_of + " is not judged");
        c.verdict = Verdict::not_reached;
        c.remedy = "another motion of the hand: --sweep, --device ROLE=gesture:NAME or --device ROLE=trace:FILE.csv";
    }
};
}   // namespace

std::string_view nameOf (Verdict verdict) noexcept
{
    constexpr std::array<std::string_view, 9> names { "holds", "close", "passive", "passive_here", "stable", "unstable", "broken", "unknown", "not reached" };
    return names[static_cast<std::size_t> (verdict)];
}

double Condition::margin() const noexcept
{
    if (! isKnown()) return 0.0;
    if (verdict == Verdict::stable || verdict == Verdict::unstable) return may_grow;
    return value > 0.0 ? limit / value : inf;
}

std::vector<Condition> judge (const Demand& demand, std::span<const RoleDevice> devices, const JudgeOptions& options)
{
    std::vector<Condition> all;
    for (const auto& role : demand.roles)
    {
        const auto numbers = numbersFor (devices, role);
        std::ranges::move (RoleJudge (demand, role, numbers, options).all(), std::back_inserter (all));
    }
    judgeLinks (demand, devices, options, all);
    return all;
}

bool isBroken (std::span<const Condition> all) noexcept
{
    return std::ranges::any_of (all, &Condition::isBroken);
}

}   // namespace tactus::check
