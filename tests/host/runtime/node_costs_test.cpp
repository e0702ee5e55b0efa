// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/runtime/node_costs.hpp>

#include "support/interpreter.hpp"
#include "support/random_graph.hpp"
#include "support/sketch.hpp"

#include <catch2/catch.hpp>

#include <bit>

#include <time.h>

using namespace tactus;
using namespace tactus::host;

namespace
{
constexpr double look_s = 25e-9;

/// A clock on which only looking takes time.
struct LookingClock final : TickClock
{
    void drive (Ticked&) noexcept override {}
    double now() const noexcept override { return look_s * static_cast<double> (++looks); }

    mutable std::uint64_t looks = 0;
};

/// The time that this program has had a processor: others that want one do not count.
struct ProcessorClock final : TickClock
{
    void drive (Ticked&) noexcept override {}
    double now() const noexcept override
    {
        timespec t {};
        clock_gettime (CLOCK_PROCESS_CPUTIME_ID, &t);
        return static_cast<double> (t.tv_sec) + 1e-9 * static_cast<double> (t.tv_nsec);
    }
};

std::shared_ptr<Plan> chain (int n)
{
    test::Sketch s;
    s.node ("n0", "signal.constant");
    for (int i = 1; i < n; ++i)
        s.node ("n" + std::to_string (i), "signal.abs").wire ("n" + std::to_string (i - 1) + ".out -> n" + std::to_string (i) + ".in");
    return s.compile().plan;
}

Json modes (int n)
{
    auto all = Json::array();
    for (int i = 0; i < n; ++i)
        all.push_back ({ { "frequency", 100.0 + i }, { "decay", 5.0 }, { "amplitude", 1.0 } });
    return { { "modes", all } };
}

const NodeCost& costOf (const std::vector<NodeCost>& costs, const std::string& node)
{
    const auto at = std::ranges::find (costs, node, &NodeCost::node);
    REQUIRE (at != costs.end());
    return *at;
}
}   // namespace

TEST_CASE ("looking takes less than 1 % of the time that ticks take, whatever the plan and its ticks, and meets every node", "[runtime]")
{
    for (const auto& [nodes, tick_s] : { std::pair { 1, 20e-9 }, { 3, 100e-9 }, { 100, 1e-6 }, { 100, 50e-6 }, { 3000, 100e-6 } })
    {
        const auto plan = chain (nodes);
        LookingClock clock;
        NodeCosts costs { clock };
        costs.begin();
        costs.tick (*plan);
        CHECK (costs.of (*plan).size() >= static_cast<std::size_t> (std::min (nodes, 900)));   // the first is looked at
        const auto before = clock.looks;
        double all_s = 0.0;
        std::uint64_t most_at_once = 0;
        for (int k = 0; k < 400000 && all_s < 2.0; ++k)
        {
            const auto looks = clock.looks;
            costs.tick (*plan);
            const double took_s = tick_s + look_s * static_cast<double> (clock.looks - looks);
            costs.earn (took_s);
            all_s += took_s;
            most_at_once = std::max (most_at_once, clock.looks - looks);
            if (k % 100 == 0) costs.collect();
        }
        INFO (nodes << " nodes, ticks of " << 1e6 * tick_s << " us");
        CHECK (look_s * static_cast<double> (clock.looks - before) < 0.006 * all_s);
        CHECK (look_s * static_cast<double> (clock.looks - before) > 0.003 * all_s);
        CHECK (look_s * static_cast<double> (most_at_once) < 3e-6 + 0.01 * tick_s);   // and no tick is held up
        CHECK (costs.of (*plan).size() == static_cast<std::size_t> (nodes));
    }
}

TEST_CASE ("a plan that is looked at gives the same bits as one that is not", "[runtime][property]")
{
    for (unsigned seed = 1; seed <= 20; ++seed)
    {
        const auto graph = test::randomGraph (seed, 40);
        std::vector<std::string> records;
        for (const auto& [name, value] : test::Interpreter { graph, 4000.0 }.outputs())
            records.push_back (name);
        const CompileOptions options { .rate_hz = 4000.0, .records = records };
        const auto looked_at = compile (graph, catalogue(), options).plan, alone = compile (graph, catalogue(), options).plan;
        REQUIRE (looked_at);
        LookingClock clock;
        NodeCosts costs { clock };
        costs.begin();
        std::size_t differing = 0;
        for (int k = 0; k < 500; ++k)
        {
            costs.tick (*looked_at);
            costs.earn (1.0);   // can afford to look at every tick
            costs.collect();
            alone->tick();
            for (std::size_t i = 0; i < alone->taps.size(); ++i)
                differing += std::bit_cast<std::uint64_t> (*alone->taps[i].value) != std::bit_cast<std::uint64_t> (*looked_at->taps[i].value);
        }
        INFO ("seed " << seed);
        CHECK (differing == 0);
        CHECK (clock.looks > 500 * alone->records.size() / 2);
    }
}

TEST_CASE ("what a node costs is found, also when it is driven, summed up to and delayed before, and stays known through edits", "[runtime]")
{
    test::Sketch s;
    s.node ("idle", "signal.abs").node ("one", "signal.constant").node ("bar", "vibration.modal", Json::object(), modes (500)).node ("small", "vibration.modal", Json::object(), modes (50));
    s.wire ("idle.out -> bar.hit").wire ("one.out -> bar.gain").wire ("idle.out -> [3] -> small.hit").wire ("idle.out -> small.hit");
    const auto plan = s.compile().plan;
    REQUIRE (plan);
    REQUIRE (plan->owners.size() == plan->records.size());

    const ProcessorClock clock;
    NodeCosts costs { clock };
    costs.begin();
    CHECK (costs.of (*plan).empty());
    const auto run = [&] (Plan& p)
    {
        for (int k = 0; k < 2000; ++k)
        {
            costs.earn (1.0);
            costs.tick (p);
            costs.collect();
        }
    };
    run (*plan);
    auto all = costs.of (*plan);
    REQUIRE (all.size() == 4);
    CHECK (all[0].node == "bar");
    CHECK (all[0].type == "vibration.modal");
    CHECK (all[1].node == "small");
    CHECK (all[0].share > 0.5);
    double sum = 0.0;
    for (const auto& c : all)
        sum += c.share;
    CHECK (sum == Approx (1.0));
    CHECK (describe ({ "bar", "vibration.modal", 1e-6, 0.826 }) == "'bar' (vibration.modal) takes 83 % of a tick");

    const auto before = costOf (all, "bar").mean_s;
    s.node ("new", "signal.abs");
    const auto next = compile (s.graph, catalogue(), { .before = plan.get() }).plan;
    all = costs.of (*next);
    CHECK (costOf (all, "bar").mean_s == before);
    CHECK (std::ranges::count (all, "new", &NodeCost::node) == 0);
    run (*next);
    CHECK (costOf (costs.of (*next), "new").mean_s < before);
}

TEST_CASE ("what runs at a rate of its own is one part of the costs", "[runtime]")
{
    test::Sketch s;
    s.node ("idle", "signal.abs").node ("part", "graph:bell");
    s.graph.root.nodes.back().extra = { { "every", 2 } };
    s.add (s.subgraph ("bell"), "bar", "vibration.modal", Json::object(), modes (500));
    s.add (s.subgraph ("bell"), "other", "vibration.modal", Json::object(), modes (50));
    const auto plan = s.compile().plan;
    REQUIRE (plan);
    REQUIRE (plan->owners.size() == plan->records.size());

    const ProcessorClock clock;
    NodeCosts costs { clock };
    costs.begin();
    for (int k = 0; k < 2000; ++k)
    {
        plan->number = static_cast<std::uint64_t> (k);
        costs.earn (1.0);
        costs.tick (*plan);
        costs.collect();
    }
    const auto all = costs.of (*plan);
    REQUIRE (all.size() == 2);
    CHECK (describe (all[0]).starts_with ("'part' (subgraph) takes "));
    CHECK (all[0].share > 0.5);
}
