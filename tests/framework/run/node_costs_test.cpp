// SPDX-License-Identifier: MIT
#include <tactus/node/generic.hpp>
#include <tactus/run/clock/node_costs.hpp>

#include "support/interpreter.hpp"
#include "support/random_graph.hpp"
#include "support/sketch.hpp"

#include <catch2/catch.hpp>

#include <bit>

using namespace tactus;

namespace
{
constexpr double look_s = 25e-9;

/// A clock that advances only when it is read.
struct LookingClock final : TickClock
{
    void drive (Ticked&) noexcept override {}
    double now() const noexcept override { return look_s * static_cast<double> (++looks); }

    mutable std::uint64_t looks = 0;
};

/// Virtual time, which passes only while a node of type test.costly ticks.
struct VirtualClock final : TickClock
{
    VirtualClock() { now_s = 0.0; }
    void drive (Ticked&) noexcept override {}
    double now() const noexcept override { return now_s; }

    static inline double now_s = 0.0;
};

/// A node whose tick takes as long as its setting says.
struct Costly
{
    using Inputs = In<double>;
    using Outputs = Out<double>;
    struct Params
    {
        double gain = 1.0;
    };
    struct Settings
    {
        double cost = 1e-6;
    };

    static constexpr Info info { .id = "test.costly", .name = "Costly", .summary = "Takes time.", .source = "none" };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", unit::newton, "signal"),
        param (&Params::gain, "gain", unit::count, "what the signal is multiplied by"),
        setting (&Settings::cost, "cost", unit::second, "the time of a tick"),
        output (&Outputs::out, "out", unit::newton, "the signal"),
    };

    Params params;
    Settings settings;

    Outputs tick (const Inputs& in) noexcept
    {
        VirtualClock::now_s += settings.cost;
        return { .out = params.gain * in.in };
    }
};

const Catalogue& catalogueWithCosts()
{
    static const Catalogue all = [] {
        std::vector<NodeType> types (catalogue().begin(), catalogue().end());
        types.push_back (describe<Costly>());
        return Catalogue { std::move (types) };
    }();
    return all;
}

Json cost (double seconds) { return { { "cost", seconds } }; }

std::shared_ptr<Plan> chain (int n)
{
    test::Sketch s;
    s.node ("n0", "signal.constant");
    for (int i = 1; i < n; ++i)
        s.node ("n" + std::to_string (i), "signal.abs").wire ("n" + std::to_string (i - 1) + ".out -> n" + std::to_string (i) + ".in");
    return s.compile().plan;
}

const NodeCost& costOf (const std::vector<NodeCost>& costs, const std::string& node)
{
    const auto at = std::ranges::find (costs, node, &NodeCost::node);
    REQUIRE (at != costs.end());
    return *at;
}
}   // namespace

TEST_CASE ("measuring takes less than 1 % of the tick time, for any plan and any tick time, and reaches every node", "[runtime]")
{
    for (const auto& [nodes, tick_s] : { std::pair { 1, 20e-9 }, { 3, 100e-9 }, { 100, 1e-6 }, { 100, 50e-6 }, { 3000, 100e-6 } })
    {
        const auto plan = chain (nodes);
        LookingClock clock;
        NodeCosts costs { clock };
        costs.begin();
        costs.tick (*plan);
        CHECK (costs.of (*plan).size() >= static_cast<std::size_t> (std::min (nodes, 900)));   // the first tick is always measured
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
        CHECK (look_s * static_cast<double> (most_at_once) < 3e-6 + 0.01 * tick_s);   // no single tick bears a large share
        CHECK (costs.of (*plan).size() == static_cast<std::size_t> (nodes));
    }
}

TEST_CASE ("a plan that is being measured is bit-identical to one that is not", "[runtime][property]")
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
            costs.earn (1.0);   // enough to measure every tick
            costs.collect();
            alone->tick();
            for (std::size_t i = 0; i < alone->taps().size(); ++i)
                differing += std::bit_cast<std::uint64_t> (*alone->taps()[i].value) != std::bit_cast<std::uint64_t> (*looked_at->taps()[i].value);
        }
        INFO ("seed " << seed);
        CHECK (differing == 0);
        CHECK (clock.looks > 500 * alone->records().size() / 2);
    }
}

TEST_CASE ("the cost of a node is measured, including driven inputs, sums and delays, and is kept through edits", "[runtime]")
{
    test::Sketch s;
    s.node ("idle", "signal.abs").node ("one", "signal.constant");
    s.node ("bar", "test.costly", Json::object(), cost (4e-6)).node ("small", "test.costly", Json::object(), cost (1e-6));
    s.wire ("idle.out -> bar.in").wire ("one.out -> bar.gain").wire ("idle.out -> [3] -> small.in").wire ("idle.out -> small.in");
    const auto compiled = compile (s.graph, catalogueWithCosts(), {});
    INFO (test::text (compiled.messages));
    const auto plan = compiled.plan;
    REQUIRE (plan);
    REQUIRE (plan->owners().size() == plan->records().size());

    const VirtualClock clock;
    NodeCosts costs { clock };
    costs.begin();
    CHECK (costs.of (*plan).empty());
    const auto run = [&] (Plan& p) {
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
    CHECK (all[0].type == "test.costly");
    CHECK (all[0].mean_s == Approx (4e-6).epsilon (0.01));
    CHECK (all[0].share == Approx (0.8).epsilon (0.01));
    CHECK (all[1].node == "small");
    CHECK (all[1].share == Approx (0.2).epsilon (0.01));
    CHECK (all[2].mean_s == 0.0);
    CHECK (all[3].mean_s == 0.0);
    CHECK (describe ({ "bar", "vibration.modal", 1e-6, 0.826 }) == "'bar' (vibration.modal) takes 83 % of a tick");

    const auto before = costOf (all, "bar").mean_s;
    s.node ("new", "signal.abs");
    const auto next = compile (s.graph, catalogueWithCosts(), { .before = plan.get() }).plan;
    all = costs.of (*next);
    CHECK (costOf (all, "bar").mean_s == before);
    CHECK (std::ranges::count (all, "new", &NodeCost::node) == 0);
    run (*next);
    CHECK (costOf (costs.of (*next), "new").mean_s == 0.0);
    CHECK (costOf (costs.of (*next), "bar").mean_s == Approx (before));
}

TEST_CASE ("a section with its own rate is one entry in the costs", "[runtime]")
{
    test::Sketch s;
    s.node ("idle", "signal.abs").node ("part", "graph:bell");
    s.graph.root.nodes.back().extra = { { "every", 2 } };
    s.add (s.subgraph ("bell"), "bar", "test.costly", Json::object(), cost (4e-6));
    s.add (s.subgraph ("bell"), "other", "test.costly", Json::object(), cost (2e-6));
    const auto plan = compile (s.graph, catalogueWithCosts(), {}).plan;
    REQUIRE (plan);
    REQUIRE (plan->owners().size() == plan->records().size());

    const VirtualClock clock;
    NodeCosts costs { clock };
    costs.begin();
    for (int k = 0; k < 2000; ++k)
    {
        plan->beginTick (static_cast<std::uint64_t> (k));
        costs.earn (1.0);
        costs.tick (*plan);
        costs.collect();
    }
    const auto all = costs.of (*plan);
    REQUIRE (all.size() == 2);
    CHECK (describe (all[0]) == "'part' (subgraph) takes 100 % of a tick");
    CHECK (all[0].mean_s == Approx (3e-6).epsilon (0.02));   // 6 us on every second tick; the ticks to measure are picked at random
}
