// SPDX-License-Identifier: MIT
// Instances of a subgraph that run as lanes have the bits of instances that run one by one.
#include "support/no_allocation.hpp"
#include "support/sketch.hpp"

#include <support/property.hpp>
#include <tactus/graph/instances.hpp>
#include <tactus/kit/random.hpp>
#include <tactus/plan/find_param.hpp>
#include <tactus/plan/steps/lane_group.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

using namespace tactus;
using test::Sketch;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Contacts, each with a few walls, frictions and gratings, wired by chance.
class Contacts
{
public:
    explicit Contacts (unsigned seed) : random (seed)
    {
        draw();
        s.node ("c", "graph:contact");
        setCount (1 + below (70));
    }

    bool oneIn (int n) { return below (n) == 0; }
    int below (int n) { return static_cast<int> (random.uniform() * n); }
    double within (double low, double high) { return low + random.uniform() * (high - low); }

    void setCount (int n)
    {
        count = n;
        auto& c = s.graph.root.nodes.front();
        c.extra["count"] = n;
        c.overrides = Json::object();
        for (int k = 0; k < n; ++k)
            if (oneIn (3)) c.overrides["[" + std::to_string (k) + "]/board0.stiffness"] = within (0.0, 3000.0);
    }

    /// With a separate rate, the subgraph has no lanes.
    void setEvery (int n)
    {
        auto& c = s.graph.root.nodes.front();
        if (n > 1)
            c.extra["every"] = n;
        else
            c.extra.erase ("every");
    }

    /// A param of some instance, and a new value for it.
    std::pair<std::string, double> knob()
    {
        const auto in = "c[" + std::to_string (below (count)) + "]/";
        const auto which = below (drags > 0 ? 5 : 3);
        if (which == 0) return { in + "board0.stiffness", within (0.0, 5000.0) };
        if (which == 1) return { in + "board0.damping", within (-1.0, 5.0) };
        if (which == 2) return { in + "grain0.angle", within (-9.0, 9.0) };
        if (which == 3) return { in + "drag0.adhesion", below (3) == 0 ? 1.0 : 0.0 };   // only `stick` fits into lanes
        return { in + "drag0.static_ratio", within (0.5, 2.0) };
    }

    std::vector<std::string> feeds() const
    {
        std::vector<std::string> all;
        for (int k = 0; k < count; ++k)
            for (const auto* port : { "at.in[0].x", "at.in[0].y", "at.in[0].z", "tilt.in[0].x", "tilt.in[0].y", "tilt.in[0].z" })
                all.push_back ("c[" + std::to_string (k) + "]/" + port);
        return all;
    }

    std::vector<std::string> records() const
    {
        std::vector<std::string> all;
        for (int k = 0; k < count; ++k)
            for (const auto& node : s.graph.graphs.front().second.nodes)
                for (const auto& row : catalogue().find (node.type)->outputs)
                    all.push_back ("c[" + std::to_string (k) + "]/" + node.name + "." + std::string (row.id));
        return all;
    }

    void drive (std::span<double> values, int tick)
    {
        for (std::size_t i = 0; i < values.size(); ++i)
        {
            const auto phase = static_cast<double> (i);
            const bool tilts = i % 6 >= 3;
            values[i] = tilts ? (i % 6 == 5 ? 1.0 : 0.2 * std::sin (0.002 * tick + phase)) * (moves ? 1.0 : i % 6 == 5)
                              : 2e-3 * std::sin ((0.02 + 0.01 * std::fmod (phase, 3.0)) * tick + phase);
            if (oneIn (400)) values[i] = std::vector { not_a_number, 1e308, -1.0 / 0.0, 0.0, -0.0, 5e-324, 1e155 }[static_cast<std::size_t> (below (7))];
        }
    }

    Sketch s;
    int count = 0;

private:
    Random random;
    int drags = 0;
    bool moves = oneIn (2);

    Json friction()
    {
        const auto load = std::vector { "bound", "bound", "scale", "passive" }[static_cast<std::size_t> (below (4))];
        const double ratio = oneIn (2) ? 1.0 : within (1.0, 2.0), stiffness = oneIn (3) ? within (0.0, 3000.0) : 0.0;
        return { { "mu", within (0.0, 1.0) }, { "d_max", within (1e-5, 6e-4) }, { "static_ratio", ratio }, { "load", load }, { "stiffness", stiffness } };
    }

    void draw()
    {
        auto& part = s.subgraph ("contact");
        const auto number = [] (const char* name, int i) { return name + std::to_string (i); };
        s.add (part, "at", "vector.add", Json::object(), { { "inputs", 1 + below (3) } }).add (part, "tilt", "vector.add", Json::object(), { { "inputs", 1 } });
        const int boards = 1 + below (3);
        drags = below (4);
        for (int i = 0; i < boards; ++i)
        {
            const double damping = oneIn (2) ? within (0.0, 4.0) : 0.0, dissipation = oneIn (3) ? within (0.0, 2.0) : 0.0;
            const Json params { { "damping", damping }, { "dissipation", dissipation }, { "offset", within (-1e-3, 1e-3) } };
            s.add (part, number ("board", i), "deform.plane", params, oneIn (6) ? Json { { "window", 0.001 } } : Json::object());
            s.add (part, "at.out -> " + number ("board", i) + ".position");
            s.add (part, number ("touch", i), "contact.window").add (part, number ("board", i) + ".depth -> " + number ("touch", i) + ".depth");
            s.add (part, number ("grain", i), "texture.grating", { { "amplitude", within (0.0, 0.3) }, { "spatial_frequency", within (10.0, 2000.0) } });
            s.add (part, "at.out -> " + number ("grain", i) + ".position").add (part, number ("felt", i), "vector.scale");
            s.add (part, number ("grain", i) + ".force -> " + number ("felt", i) + ".in");
            s.add (part, number ("touch", i) + ".gain -> " + number ("felt", i) + ".gain");
        }
        for (int i = 0; i < drags; ++i)
        {
            const auto drag = number ("drag", i);
            s.add (part, drag, "friction.elasto_plastic", friction());
            s.add (part, "at.out -> " + drag + ".position");
            for (int load = below (3); load >= 0; --load)   // several wires add up
                s.add (part, number ("board", below (boards)) + ".resistance -> " + drag + ".normal_force");
            if (oneIn (2)) s.add (part, "tilt.out -> " + drag + ".normal");
        }
        s.add (part, "all", "vector.add", Json::object(), { { "inputs", boards } });
        for (int i = 0; i < boards; ++i)
            s.add (part, number ("felt", i) + ".out -> all.in[" + std::to_string (i) + "]");
    }
};

/// A plan that is ticked alone, and its successors.
struct Player
{
    std::shared_ptr<Plan> plan;

    void follow (const Contacts& contacts, std::size_t lanes)
    {
        auto [next, messages] = contacts.s.compile ({ .feeds = contacts.feeds(), .records = contacts.records(), .lanes = lanes, .before = plan.get() });
        INFO (test::text (messages));
        REQUIRE (next);
        if (plan)
            next->takeOver (*plan);
        else
            next->startRamping();
        plan = std::move (next);
    }

    void turn (const std::string& name, double value)
    {
        const auto refs = plan::findParams (*plan, name);
        REQUIRE (refs);
        for (const auto& ref : *refs)
            plan::turn (ref, value);
    }

    void tick (std::uint64_t number) noexcept
    {
        plan->applyTurns (nullptr);
        plan->beginTick (number);
        plan->tick();
    }
};

/// The name of the first output that differs.
std::string difference (const Player& a, const Player& b)
{
    for (std::size_t t = 0; t < a.plan->taps().size(); ++t)
    {
        const auto &x = a.plan->taps()[t], &y = b.plan->taps()[t];
        if (std::bit_cast<std::uint64_t> (*x.value) != std::bit_cast<std::uint64_t> (*y.value))
            return x.name + ": " + std::to_string (*x.value) + " one by one, " + std::to_string (*y.value) + " in lanes";
    }
    return {};
}

int groupsOf (const Plan& plan)
{
    return static_cast<int> (std::ranges::count (plan.records(), &plan::LaneStep::step, &Record::step));
}
}   // namespace

TEST_CASE ("lanes have the bits of single instances", "[plan][lanes][property]")
{
    test::property ("for random contacts with faults, turned knobs, and edits that change the number of instances and of lanes, and the rate", [] {
        const auto seed = *rc::gen::arbitrary<unsigned>();
        Contacts contacts { seed };
        Player single, lanes;
        const auto widthNow = [&] { return std::size_t { 1 } << contacts.below (4); };
        const auto follow = [&] {
            single.follow (contacts, 1);
            lanes.follow (contacts, std::min (widthNow(), widestLanes()));
        };
        follow();
        for (int k = 0; k < 300; ++k)
        {
            contacts.drive (single.plan->feeds(), k);
            lanes.plan->setFeeds (single.plan->feeds());
            single.tick (static_cast<std::uint64_t> (k));
            lanes.tick (static_cast<std::uint64_t> (k));
            const auto found = difference (single, lanes);
            RC_LOG ("tick " + std::to_string (k) + ", " + std::to_string (contacts.count) + " instances: " + found);
            RC_ASSERT (found.empty());
            if (contacts.oneIn (20))
            {
                const auto [name, value] = contacts.knob();
                single.turn (name, value);
                lanes.turn (name, value);
            }
            if (! contacts.oneIn (60)) continue;
            if (contacts.oneIn (2)) contacts.setCount (1 + contacts.below (70));
            if (contacts.oneIn (3)) contacts.setEvery (1 + contacts.below (2));
            follow();
        }
    });
}

namespace
{
/// Walls that report their force, with these wires between them.
Sketch walls (int count, const std::vector<std::string>& wires)
{
    Sketch s;
    auto& part = s.subgraph ("wall");
    s.add (part, "at", "vector.add", Json::object(), { { "inputs", 2 } }).add (part, "board", "deform.plane", { { "damping", 1.0 } });
    s.add (part, "at.out -> board.position").add (part, "grain", "texture.grating").add (part, "at.out -> grain.position");
    part.expose.outputs = { { "grain", { "grain", "force" } }, { "place", { "at", "out" } } };
    part.expose.params = { { "angle", { "grain", "angle" } } };
    s.node ("c", "graph:wall");
    s.graph.root.nodes.front().extra["count"] = count;
    for (const auto& wire : wires)
        s.wire (wire);
    return s;
}
}   // namespace

TEST_CASE ("nodes run as lanes where no wire prevents it", "[plan][lanes]")
{
    const auto groups = [] (const Sketch& s) { return groupsOf (*s.compile ({ .lanes = widestLanes() }).plan); };
    CHECK (groups (walls (8, {})) == 3);
    CHECK (groups (walls (1, {})) == 0);
    CHECK (groupsOf (*walls (8, {}).compile().plan) == 0);
    // From instance to instance: `at` would have to run before itself.
    CHECK (groups (walls (8, { "c[0].place -> c[1]/at.in[1]" })) == 2);
    CHECK (groups (walls (8, { "c[0].place -> [1] -> c[1]/at.in[1]" })) == 3);
    // A wire sets a param of all instances, or of one: the other seven remain.
    CHECK (groups (walls (8, {}).node ("turn", "signal.constant").wire ("turn.out -> c.angle")) == 2);
    CHECK (groups (walls (8, {}).node ("turn", "signal.constant").wire ("turn.out -> c[2].angle")) == 3);
}

TEST_CASE ("a choice that does not fit makes a group run one by one, until it fits again", "[plan][lanes]")
{
    Sketch s;
    auto& part = s.subgraph ("pad");
    s.add (part, "drag", "friction.elasto_plastic", { { "mu", 0.5 } });
    s.node ("c", "graph:pad");
    s.graph.root.nodes.front().extra["count"] = 5;
    CompileOptions options;
    for (int k = 0; k < 5; ++k)
        for (const auto* port : { "position.x", "normal_force" })
            options.feeds.push_back ("c[" + std::to_string (k) + "]/drag." + port);
    options.records = { "c[0]/drag.force.x", "c[3]/drag.force.x", "c[3]/drag.state" };

    Player single { s.compile (options).plan };
    options.lanes = 4;
    Player lanes { s.compile (options).plan };
    REQUIRE (groupsOf (*lanes.plan) == 1);
    int different = 0;
    std::array<double, 3> creeps {};   // ticks on which the contact yields a little, before, during and after
    for (int k = 0; k < 900; ++k)
    {
        for (auto* player : { &single, &lanes })
        {
            if (k == 300) player->turn ("c[3]/drag.adhesion", 3.0);
            if (k == 600) player->turn ("c[3]/drag.adhesion", 0.0);
            for (std::size_t i = 0; i < 5; ++i)
            {
                player->plan->feeds()[2 * i] = 4e-5 * std::sin (0.03 * k + static_cast<double> (i));
                player->plan->feeds()[2 * i + 1] = k % 100 == 0 ? 0.0 : 1.0;   // lets go, and so adopts the choice
            }
            player->tick (static_cast<std::uint64_t> (k));
        }
        different += ! difference (single, lanes).empty();
        creeps[static_cast<std::size_t> (k / 300)] += *lanes.plan->taps()[2].value == 2.0;
    }
    CHECK (different == 0);
    CHECK (creeps[0] == 0);
    CHECK (creeps[1] > 250);
    CHECK (creeps[2] == 0);
}

TEST_CASE ("lanes allocate nothing in a tick, in a knob turn or at a takeover", "[plan][lanes]")
{
    if (! NoAllocation::watches)
    {
        WARN ("skipped: a sanitizer has its own allocator");
        return;
    }
    Contacts contacts { 3 };
    contacts.setCount (37);
    Player player;
    player.follow (contacts, widestLanes());
    REQUIRE (groupsOf (*player.plan) > 4);
    player.turn ("c/board0.stiffness", 500.0);
    contacts.setCount (20);
    const CompileOptions options { .feeds = contacts.feeds(), .records = contacts.records(), .lanes = widestLanes(), .before = player.plan.get() };
    const auto next = contacts.s.compile (options).plan;

    const NoAllocation guard;
    for (int k = 0; k < 100; ++k)
        player.tick (static_cast<std::uint64_t> (k));
    next->takeOver (*player.plan);
    CHECK (guard.allocations() == 0);
    CHECK (guard.locks() == 0);
}
