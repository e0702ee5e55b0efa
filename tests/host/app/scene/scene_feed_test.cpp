// SPDX-License-Identifier: GPL-3.0-or-later
#include "preset_bodies.hpp"

#include <host/app/run/scene_feed.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;
using host::test::presetGraph;

namespace
{
/// Compiles what a feed wants of a graph, as a run does.
std::shared_ptr<Plan> planFor (const SceneFeed& feed, const graph::Graph& graph)
{
    FileAssets assets;
    const auto compiled = compile (graph, catalogue(), { .records = feed.ports(), .assets = &assets });
    if (! compiled.plan) throw std::runtime_error ("the graph does not compile");
    return compiled.plan;
}

/// A feed that watches a graph which runs next.
struct Watched
{
    SceneFeed feed;
    graph::Graph graph;
    std::shared_ptr<Plan> plan;

    explicit Watched (const std::string& preset) : graph (presetGraph (preset))
    {
        feed.watch (true);
        plan = planFor (feed, graph);
        feed.show (plan.get());
        static_cast<void> (feed.now());   // asks for the ports
        next();
    }

    void next()
    {
        plan = planFor (feed, graph);
        feed.planComes (*plan);
    }

    bool hasDepth() { return feed.now().of (0, &Appearance::depth).has_value(); }
};
}   // namespace

TEST_CASE ("the scene takes values equally often at a new rate of the graph", "[app][scene]")
{
    Watched w { "liver" };
    w.graph.rate_hz = 1000.0;
    w.next();
    w.feed.after (*w.plan, 8, false);   // every eighth tick at this rate, and every 33rd at 4 kHz
    CHECK (w.hasDepth());
}

TEST_CASE ("a scene whose bodies need no ports shows the tools as soon as it is watched", "[app][scene]")
{
    const auto graph = presetGraph ("dry_wood");
    SceneFeed feed;
    const auto plan = planFor (feed, graph);
    feed.planComes (*plan);
    feed.after (*plan, 0, false);
    CHECK (feed.now().tools.empty());
    feed.watch (true);
    feed.after (*plan, 0, false);
    CHECK (feed.now().tools.size() == 1);
    feed.clear();
    feed.watch (false);
    feed.after (*plan, 0, false);
    CHECK (feed.now().tools.empty());
}

TEST_CASE ("the scene forgets the value of a port that is no longer recorded", "[app][scene]")
{
    Watched w { "liver" };
    w.feed.after (*w.plan, 0, false);
    REQUIRE (w.hasDepth());
    FileAssets assets;
    const auto without = compile (w.graph, catalogue(), { .records = { "liver.force" }, .assets = &assets });
    REQUIRE (without.plan);
    w.feed.planComes (*without.plan);
    CHECK_FALSE (w.hasDepth());
}

TEST_CASE ("a sound card is not a tool in the scene", "[app][scene]")
{
    SceneFeed feed;
    feed.hasPlace = [] (const std::string& role) { return role != "index"; };
    const auto plan = planFor (feed, presetGraph ("two_fingers"));
    feed.watch (true);
    feed.planComes (*plan);
    feed.after (*plan, 0, false);
    const auto tools = feed.now().tools;
    REQUIRE (tools.size() == 1);
    CHECK (tools[0].role == "thumb");
}
