// SPDX-License-Identifier: MIT
// Properties that hold for any graph that compiles.

#include "support/interpreter.hpp"
#include "support/no_allocation.hpp"
#include "support/random_graph.hpp"
#include "support/sketch.hpp"

#include <support/property.hpp>
#include <tactus/graph/edit.hpp>

#include <catch2/catch.hpp>

#include <bit>
#include <map>
#include <random>

using namespace tactus;

namespace
{
constexpr int ticks = 24;

/// Every output of every node, as names to record.
std::vector<std::string> everyOutput (const graph::Graph& g)
{
    std::vector<std::string> names;
    for (const auto& [name, value] : test::Interpreter { g, g.rate_hz }.outputs())
        names.push_back (name);
    return names;
}

/// A hand that moves at random, sometimes to positions that are not finite.
class Hand
{
public:
    explicit Hand (unsigned seed) : random (seed) {}

    Reading next()
    {
        std::normal_distribution<double> step { 0.0, 1e-3 };
        position += Vec3 { step (random), step (random), step (random) };
        Reading r;
        r.position = r.true_position = position;
        r.pressure = std::abs (100.0 * position.z());
        if (random() % 50 == 0) r.position.x() = std::nan ("");
        return r;
    }

private:
    std::mt19937 random;
    Vec3 position = Vec3::Zero();
};

using Run = std::vector<std::map<std::string, std::uint64_t>>;   // bits of each output, tick by tick

std::uint64_t bits (double v) { return v == v ? std::bit_cast<std::uint64_t> (v) : ~0ull; }

Run runPlan (const graph::Graph& g, unsigned seed)
{
    auto [plan, messages] = compile (g, catalogue(), { .records = everyOutput (g) });
    RC_LOG (test::text (messages));
    RC_ASSERT (plan != nullptr);
    Hand left { seed }, right { seed + 1 };
    Run run;
    for (int k = 0; k < ticks; ++k)
    {
        const auto l = left.next(), r = right.next();
        for (auto& role : plan->roles())
            role.state->reading = role.name == "left" ? l : r;
        plan->tick();
        auto& row = run.emplace_back();
        for (const auto& tap : plan->taps())
            row[tap.name] = bits (*tap.value);
    }
    return run;
}

Run interpret (const graph::Graph& g, unsigned seed)
{
    test::Interpreter interpreter { g, g.rate_hz };
    Hand left { seed }, right { seed + 1 };
    Run run;
    for (int k = 0; k < ticks; ++k)
    {
        const auto l = left.next();
        interpreter.tick ({ { "left", l }, { "right", right.next() } });
        auto& row = run.emplace_back();
        for (const auto& [name, value] : interpreter.outputs())
            row[name] = bits (value);
    }
    return run;
}

std::string difference (const Run& a, const Run& b)
{
    for (std::size_t k = 0; k < a.size(); ++k)
        for (const auto& [name, value] : a[k])
            if (const auto other = b[k].find (name); other == b[k].end() || other->second != value)
                return name + " on tick " + std::to_string (k) + ": " + std::to_string (std::bit_cast<double> (value)) + " and "
                       + (other == b[k].end() ? "nothing" : std::to_string (std::bit_cast<double> (other->second)));
    return "";
}
}   // namespace

TEST_CASE ("each record of a plan has an owner, and each node that runs on its own has a record", "[plan][property]")
{
    for (unsigned seed = 1; seed <= 100; ++seed)
    {
        const auto plan = test::Sketch { test::randomGraph (seed, 40) }.compile().plan;
        REQUIRE (plan);
        REQUIRE (plan->owners().size() == plan->records().size());
        std::vector<int> works (plan->instances().size(), 0);
        int strange = 0;
        for (std::size_t r = 0; r < plan->records().size(); ++r)
        {
            ++works.at (plan->owners()[r]);
            for (std::size_t i = 0; i < plan->instances().size(); ++i)
                strange += plan->instances()[i].node && plan->instances()[i].node.get() == plan->records()[r].self && plan->owners()[r] != i;
        }
        for (std::size_t i = 0; i < works.size(); ++i)
            strange += plan->flat().nodes[i].runs() && plan->flat().nodes[i].section == 0 && works[i] == 0;   // a whole section has only one record
        INFO ("seed " << seed);
        CHECK (strange == 0);
    }
}

TEST_CASE ("a plan is bit-identical to an interpreter of the graph", "[plan][property]")
{
    test::property ("on random graphs of up to 200 nodes", [] {
        const auto seed = *rc::gen::arbitrary<unsigned>();
        const auto g = test::randomGraph (seed, *rc::gen::inRange (2, 200));
        RC_LOG (difference (interpret (g, seed), runPlan (g, seed)));
        RC_ASSERT (interpret (g, seed) == runPlan (g, seed));
    });
}

TEST_CASE ("the order of nodes and wires in the file does not change a single bit", "[plan][property]")
{
    test::property ("on random graphs of up to 200 nodes", [] {
        const auto seed = *rc::gen::arbitrary<unsigned>();
        const auto g = test::randomGraph (seed, *rc::gen::inRange (2, 200));
        const auto other = test::shuffled (g, seed + 1);
        RC_LOG (difference (runPlan (g, seed), runPlan (other, seed)));
        RC_ASSERT (runPlan (g, seed) == runPlan (other, seed));
    });
}

TEST_CASE ("a subgraph with several instances is bit-identical to separate nodes", "[plan][property]")
{
    test::property ("on random graphs of up to 200 nodes", [] {
        const auto seed = *rc::gen::arbitrary<unsigned>();
        const auto g = test::randomGraph (seed, *rc::gen::inRange (13, 200));
        auto drawn = g;
        for (const auto& node : g.root.nodes)
            if (node.extra.contains ("count")) RC_ASSERT (graph::apply (drawn, graph::ExpandNode { "", node.name }).has_value());

        // Once the instances are separate nodes, their wires may meet at a port that cannot sum them.
        RC_PRE (! test::has (compile (drawn, catalogue()).messages, "wire/two_into_one"));

        auto run = runPlan (g, seed), other = runPlan (drawn, seed);
        for (auto& row : run)
        {
            Run::value_type renamed;
            for (const auto& [name, value] : row)
            {
                auto path = name;
                if (const auto bracket = path.find ('['); bracket < path.find ('/') && path.find ('/') < path.find ('.'))
                {
                    path.erase (path.find (']', bracket), 1);
                    path[bracket] = '_';
                }
                renamed[path] = value;
            }
            row = std::move (renamed);
        }
        RC_LOG (difference (run, other));
        RC_ASSERT (run == other);
    });
}

TEST_CASE ("a tick allocates nothing and takes no lock, whatever the graph", "[plan][property]")
{
    if (! NoAllocation::watches)
    {
        WARN ("skipped: a sanitizer has its own allocator");
        return;
    }
    for (unsigned seed = 0; seed < 40; ++seed)
    {
        const auto g = test::randomGraph (seed, 60);
        auto plan = compile (g, catalogue()).plan;
        REQUIRE (plan);
        Engine engine { plan };
        const NoAllocation guard;
        for (int k = 0; k < 50; ++k)
            engine.tick();
        CHECK (guard.allocations() == 0);
        CHECK (guard.locks() == 0);
    }
}

TEST_CASE ("random graphs have wires, loops through delays, driven parameters, and sections with their own rates", "[plan][property]")
{
    constexpr unsigned graphs = 50;
    int wires = 0, delayed = 0, driven = 0, inside = 0, several = 0, counted = 0, own = 0, slow = 0, fast = 0, nested = 0, crossing = 0;
    for (unsigned seed = 0; seed < graphs; ++seed)
    {
        const auto g = test::randomGraph (seed, 100);
        const auto flat = compile (g, catalogue()).plan->flat();
        for (const auto& s : flat.sections)
        {
            (s.kind == plan::Section::Kind::every ? slow : fast) += s.around >= 0;
            nested += s.around > 0;
        }
        crossing += static_cast<int> (std::ranges::count (flat.wires, true, &plan::FlatWire::crosses));
        for (const auto& [name, patch] : g.graphs)
            inside += static_cast<int> (patch.wires.size());
        for (const auto& w : g.root.wires)
        {
            ++wires;
            delayed += w.delay > 0;
            several += w.from.node.find ('[') != std::string::npos || w.to.node.find ('[') != std::string::npos;
            if (const auto* node = g.root.find (w.to.node); const auto* type = node ? catalogue().find (node->type) : nullptr)
                driven += std::ranges::count (type->params, w.to.port, &PortSheet::id) > 0;
        }
        for (const auto& node : g.root.nodes)
            if (node.extra.contains ("count"))
            {
                ++counted;
                own += ! node.overrides.empty();
            }
    }
    CHECK (wires > static_cast<int> (graphs) * 30);
    CHECK (delayed > static_cast<int> (graphs) * 3);
    CHECK (driven > static_cast<int> (graphs) * 3);
    CHECK (inside > 20);
    CHECK (several > 20);
    CHECK (counted > 20);
    CHECK (own > 20);
    CHECK (slow > 20);
    CHECK (fast > 10);
    CHECK (nested > 10);
    CHECK (crossing > 100);
}
