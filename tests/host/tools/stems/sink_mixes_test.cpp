// SPDX-License-Identifier: GPL-3.0-or-later
// Signals that reach a motor without a mixer. The reference is a run: with all layers muted and without the wires that were found, the motors get nothing.
#include <host/tools/stems/sink_mixes.hpp>

#include <tactus/file/graph_file.hpp>
#include <tactus/plan/flat/flatten.hpp>

#include "support/sketch.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <vector>

using namespace tactus;
using namespace tactus::host;
using tactus::test::Sketch;

namespace
{
plan::Flat flatOf (const graph::Graph& g) { return plan::flatten (g, catalogue(), {}, nullptr).flat; }

/// By signal that is not mixed: the nodes between it and the motor.
std::vector<std::string> throughOf (const graph::Graph& g)
{
    std::vector<std::string> found;
    const auto flat = flatOf (g);
    for (const auto& m : sinkMixes (flat))
        for (const auto& u : m.unmixed)
        {
            found.push_back (u.from + ":");
            for (const int n : u.through)
                found.back() += " " + flat.node (n).path;
        }
    return found;
}

/// Two sources, 2 N and 3 N, a mixer `desk` with one layer, and a motor.
Sketch sources()
{
    Sketch s;
    s.node ("a", "signal.constant", { { "value", "2 N" } }).node ("b", "signal.constant", { { "value", "3 N" } });
    s.node ("desk", "layer.mix", Json::object(), { { "inputs", 1 } }).node ("motor", "device.force");
    s.wire ("a.out -> desk.in[0]");
    return s;
}

std::vector<std::string> unmixedOf (const graph::Graph& g)
{
    std::vector<std::string> found;
    const auto flat = flatOf (g);
    for (const auto& m : sinkMixes (flat))
        for (const auto& u : m.unmixed)
            found.push_back (u.from + " -> " + flat.nameOf (flat.wires[u.wire].to));
    return found;
}

struct Tip final : public Device
{
    void prepare (double) override {}
    Reading read() noexcept override { return {}; }
    void write (const Effort& e) noexcept override { most = std::max (most, e.force.norm() + e.torque.norm()); }

    double most = 0.0;
};

double forceOf (const graph::Graph& g)
{
    auto compiled = compile (g, catalogue());
    INFO (tactus::test::text (compiled.messages));
    REQUIRE (compiled.plan);
    Engine engine (std::move (compiled.plan));
    Tip tip;
    engine.attach ("stylus", tip);
    for (int i = 0; i < 50; ++i)
        engine.tick();
    return tip.most;
}

/// The graph with all layers muted, and without the wires that are not mixed.
graph::Graph silenced (graph::Graph g)
{
    const auto flat = flatOf (g);
    std::vector<graph::Id> gone;
    for (const auto& m : sinkMixes (flat))
        for (const auto& u : m.unmixed)
            gone.push_back (flat.wires[u.wire].identity.id);
    const auto quiet = [&] (graph::Patch& p) {
        std::erase_if (p.wires, [&] (const graph::Wire& w) { return std::ranges::count (gone, w.id) > 0; });
        for (auto& n : p.nodes)
            if (n.type.starts_with ("layer.mix")) n.params["mute"] = Json::array ({ 1 });   // each mixer here has one layer
    };
    quiet (g.root);
    for (auto& [name, p] : g.graphs)
        quiet (p);
    return g;
}

void check (const graph::Graph& g, const std::vector<std::string>& expected)
{
    CHECK (unmixedOf (g) == expected);
    CHECK (forceOf (g) > 1.0);
    CHECK (forceOf (silenced (g)) == 0.0);
}
}   // namespace

TEST_CASE ("a graph whose motor gets only a mix has nothing that is not mixed", "[tools][stems]")
{
    auto s = sources();
    s.wire ("desk.out -> motor.force.z");
    check (s.graph, {});
    const auto flat = flatOf (s.graph);
    const auto mixes = sinkMixes (flat);
    REQUIRE (mixes.size() == 1);
    CHECK (mixes[0].name == "motor.force");
    CHECK (mixes[0].is_direct);
    REQUIRE (mixes[0].mixers.size() == 1);
    CHECK (flat.node (mixes[0].mixers[0]).path == "desk");
}

TEST_CASE ("a second wire into the motor, or into an input on the way to it, is not mixed", "[tools][stems]")
{
    SECTION ("into the motor")
    {
        auto s = sources();
        s.wire ("desk.out -> motor.force.z").wire ("b.out -> motor.force.x");
        check (s.graph, { "b.out -> motor.force.x" });
        CHECK (throughOf (s.graph) == std::vector<std::string> { "b.out:" });
    }
    SECTION ("into the input of a filter")
    {
        auto s = sources();
        s.node ("soft", "signal.gain").wire ("desk.out -> soft.in").wire ("b.out -> soft.in").wire ("soft.out -> motor.force.z");
        check (s.graph, { "b.out -> soft.in" });
        CHECK (throughOf (s.graph) == std::vector<std::string> { "b.out: soft" });
        s.node ("half", "signal.gain").node ("other", "signal.gain").wire ("soft.out -> half.in").wire ("half.out -> motor.force.x");
        s.wire ("half.out -> other.in");   // which leads to no motor
        CHECK (throughOf (s.graph) == std::vector<std::string> { "b.out: soft half" });
    }
    SECTION ("into a node that adds")
    {
        auto s = sources();
        s.node ("both", "signal.add").wire ("desk.out -> both.in[0]").wire ("b.out -> both.in[1]").wire ("both.out -> motor.force.z");
        check (s.graph, { "b.out -> both.in[1]" });
    }
    SECTION ("into another component")
    {
        auto s = sources();
        s.node ("up", "vector.join").wire ("desk.out -> up.z").wire ("b.out -> up.x").wire ("up.out -> motor.force");
        check (s.graph, { "b.out -> up.x" });
        const auto mixes = sinkMixes (flatOf (s.graph));
        CHECK_FALSE (mixes[0].is_direct);
    }
    SECTION ("behind a bypassed node")
    {
        auto s = sources();
        s.node ("soft", "signal.gain").wire ("desk.out -> soft.in").wire ("b.out -> soft.in").wire ("soft.out -> motor.force.z");
        std::ranges::find (s.graph.root.nodes, "soft", &graph::Node::name)->bypass = true;
        check (s.graph, { "b.out -> soft.in" });
    }
}

TEST_CASE ("what a mix is multiplied with is no force of its own", "[tools][stems]")
{
    auto s = sources();
    s.node ("open", "signal.constant", { { "value", 1 } }).wire ("open.out -> felt.in[1]");
    s.node ("felt", "signal.multiply").wire ("desk.out -> felt.in[0]").wire ("felt.out -> motor.force.z");
    check (s.graph, {});
}

TEST_CASE ("a bypassed mixer does not mix, and a motor without a mixer is not mixed", "[tools][stems]")
{
    auto s = sources();
    s.wire ("desk.out -> motor.force.z").node ("other", "device.force").wire ("b.out -> other.force.y");
    check (s.graph, { "b.out -> other.force.y" });
    std::ranges::find (s.graph.root.nodes, "desk", &graph::Node::name)->bypass = true;
    CHECK (unmixedOf (s.graph) == std::vector<std::string> { "desk.out -> motor.force.z", "b.out -> other.force.y" });
}

TEST_CASE ("mixers and motors inside of subgraphs count, too", "[tools][stems]")
{
    auto s = sources();
    s.wire ("desk.out -> motor.force.z");
    auto& inside = s.subgraph ("pad");
    s.add (inside, "c", "signal.constant", { { "value", "1 N" } });
    s.add (inside, "mix", "layer.mix", Json::object(), { { "inputs", 1 } });
    s.add (inside, "d", "signal.constant", { { "value", "1 N" } });
    s.add (inside, "motor", "device.force");
    s.add (inside, "c.out -> mix.in[0]");
    s.add (inside, "mix.out -> motor.force.z");
    s.add (inside, "d.out -> motor.force.y");
    s.node ("block", "graph:pad");
    check (s.graph, { "block/d.out -> block/motor.force.y" });
}
