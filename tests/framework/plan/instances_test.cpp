// SPDX-License-Identifier: MIT
// Subgraphs with several instances: the meaning of names, and the outputs.

#include "support/sketch.hpp"

#include <tactus/file/graph_file.hpp>

#include <catch2/catch.hpp>

using namespace tactus;

namespace
{
/// Three walls in a row under one hand. Each one can be wired, turned and measured separately.
graph::Graph fingers (const std::string& finger = R"("count": 3)", const std::string& more_wires = "", const std::string& more = "")
{
    auto loaded = readGraph (R"({ "format": "tactus-graph", "version": 1, "nodes": {
      "hand": { "type": "device.position", "role": "stylus" },
      "level": { "type": "signal.constant", "params": { "value": 2 } },
      "sum": { "type": "signal.gain" }, "vsum": { "type": "vector.scale" },
      "finger": { "type": "graph:finger", )"
                             + finger + R"( },
      "motor": { "type": "device.force", "role": "stylus" } },
    "wires": [ "finger.force -> motor.force")"
                             + more_wires + R"( ],
    "graphs": { "finger": {
      "nodes": { "wall": { "type": "deform.plane", "params": { "offset": "1 mm" } }, "amp": { "type": "signal.gain" },
                 "device": { "type": "device.pressure", "role": "tip" } },
      "wires": [],
      "expose": { "inputs": { "position": "wall.position", "in": "amp.in" }, "params": { "offset": "wall.offset", "gain": "amp.gain" },
                  "outputs": { "force": "wall.force", "resistance": "wall.resistance", "depth": "wall.depth",
                              "out": "amp.out", "pressure": "device.force" } } } })"
                             + more + " }");
    INFO (test::text (loaded.messages));
    REQUIRE_FALSE (hasErrors (loaded.messages));
    return std::move (loaded.graph);
}

/// The values of the recorded ports after one tick.
std::vector<double> values (const graph::Graph& g, std::vector<std::string> records, std::vector<plan::Override> overrides = {})
{
    auto [plan, messages] = compile (g, catalogue(), { .records = std::move (records), .overrides = std::move (overrides) });
    INFO (test::text (messages));
    REQUIRE (plan);
    Engine { plan }.tick();
    std::vector<double> all;
    for (const auto& tap : plan->taps())
        all.push_back (*tap.value);
    return all;
}

std::vector<std::string> columns (const graph::Graph& g, std::vector<std::string> records)
{
    auto [plan, messages] = compile (g, catalogue(), { .records = std::move (records) });
    INFO (test::text (messages));
    REQUIRE (plan);
    std::vector<std::string> names;
    for (const auto& tap : plan->taps())
        names.push_back (tap.name);
    return names;
}

/// The errors of a graph, each as "id at where".
std::vector<std::string> errors (const graph::Graph& g, CompileOptions options = {})
{
    std::vector<std::string> all;
    for (const auto& m : compile (g, catalogue(), options).messages)
        if (m.severity == Message::Severity::error)
        {
            all.push_back (m.id + " at " + m.where);
            CHECK (m.remedy != "");
        }
    return all;
}

using Strings = std::vector<std::string>;
using Doubles = std::vector<double>;
const Strings gains { "finger[0]/amp.gain", "finger[1]/amp.gain", "finger[2]/amp.gain" };
}   // namespace

TEST_CASE ("a wire to a subgraph feeds every instance, and a wire to one instance feeds that one", "[instances]")
{
    for (const auto* every : { "finger.in", "finger[*].in", "finger/amp.in", "finger[*]/amp.in" })
        CHECK (values (fingers (R"("count": 3)", std::string (R"(, "level.out -> )") + every + '"'), { "finger.out" }) == Doubles { 2.0, 2.0, 2.0 });
    for (const auto* one : { "finger[1].in", "finger[1]/amp.in" })
        CHECK (values (fingers (R"("count": 3)", std::string (R"(, "level.out -> )") + one + '"'), { "finger.out" }) == Doubles { 0.0, 2.0, 0.0 });
    CHECK (values (fingers (R"("count": 3)", R"(, "level.out -> finger.gain", "level.out -> finger.in")"), { "finger.out" }) == Doubles { 4.0, 4.0, 4.0 });
    CHECK (values (fingers (R"("count": 3)", R"(, "level.out -> (+) finger[2].gain", "level.out -> finger.in")"), { "finger.out" })
           == Doubles { 2.0, 2.0, 6.0 });
}

TEST_CASE ("forces of all instances are summed, even in a port that accepts only one wire, and a single instance is not summed", "[instances]")
{
    const auto overrides = R"("count": 3, "overrides": { "wall.offset": "1 mm", "[1]/wall.offset": "2 mm", "[2]/wall.offset": "4 mm" })";
    CHECK (values (fingers (overrides), { "finger.resistance" }) == Doubles { 1.0, 2.0, 4.0 });
    CHECK (values (fingers (overrides), { "motor.force.z" }) == Doubles { 7.0 });
    CHECK (values (fingers (overrides, R"(, "finger.resistance -> sum.in")"), { "sum.out" }) == Doubles { 7.0 });
    CHECK (values (fingers (overrides, R"(, "finger.force -> vsum.in")"), { "vsum.out.z" }) == Doubles { 7.0 });
    CHECK (values (fingers (overrides, R"(, { "wire": "finger.resistance -> sum.gain", "gain": "1 1/N" }, "level.out -> sum.in")"), { "sum.out" })
           == Doubles { 14.0 });
    CHECK (values (fingers (overrides, R"(, "finger[2].resistance -> sum.in")"), { "sum.out" }) == Doubles { 4.0 });
    CHECK (values (fingers (overrides, R"(, "finger[1].depth -> sum.in")"), { "sum.out" }) == Doubles { 0.002 });
    CHECK (errors (fingers (overrides, R"(, "finger.depth -> sum.in")")) == Strings { "wire/which_instance at /wires/1" });
    CHECK (errors (fingers (overrides, R"(, "finger.out -> sum.in")")) == Strings { "wire/which_instance at /wires/1" });
    CHECK (errors (fingers (overrides, R"(, "finger[0].depth -> sum.in", "finger[1].depth -> sum.in")")) == Strings { "wire/two_into_one at /wires/2" });
    CHECK (errors (fingers (R"("count": 1)", R"(, "finger.depth -> sum.in")")).empty());
}

TEST_CASE ("if a parameter is given several values, the one that names its instance takes precedence in any order", "[instances]")
{
    CHECK (values (fingers (R"("count": 3, "params": { "gain": 3 })"), gains) == Doubles { 3.0, 3.0, 3.0 });
    CHECK (values (fingers (R"("count": 3, "params": { "gain": 3 }, "overrides": { "[1]/amp.gain": 5 })"), gains) == Doubles { 3.0, 5.0, 3.0 });
    CHECK (values (fingers (R"("count": 3, "overrides": { "amp.gain": 4, "[1]/amp.gain": 5 })"), gains) == Doubles { 4.0, 5.0, 4.0 });
    CHECK (values (fingers (R"("count": 3, "overrides": { "[1]/amp.gain": 5, "amp.gain": 4 })"), gains) == Doubles { 4.0, 5.0, 4.0 });
    CHECK (values (fingers (R"("count": 3, "overrides": { "[2]/amp.gain": 5, "[*]/amp.gain": 4 })"), gains) == Doubles { 4.0, 4.0, 5.0 });

    const auto plain = fingers();
    CHECK (values (plain, gains, { { "finger.gain", 7 } }) == Doubles { 7.0, 7.0, 7.0 });
    CHECK (values (plain, gains, { { "finger/amp.gain", 7 }, { "finger[0].gain", 8 } }) == Doubles { 8.0, 7.0, 7.0 });
    CHECK (values (plain, gains, { { "finger[*]/amp.gain", 7 }, { "finger[2]/amp.gain", 9 } }) == Doubles { 7.0, 7.0, 9.0 });
    const auto controlled =
        fingers (R"("count": 3)", "", R"(, "controls": { "a": { "value": 0.5, "to": { "finger.gain": [0, 2], "finger[2]/amp.gain": [0, 8] } } })");
    CHECK (values (controlled, gains) == Doubles { 1.0, 1.0, 4.0 });
}

TEST_CASE ("recording all instances gives one column per instance", "[instances]")
{
    CHECK (columns (fingers(), { "finger.resistance" }) == Strings { "finger[0].resistance", "finger[1].resistance", "finger[2].resistance" });
    CHECK (columns (fingers(), { "finger[*].force.z", "finger[1].force" })
           == Strings { "finger[0].force.z", "finger[1].force.z", "finger[2].force.z", "finger[1].force.x", "finger[1].force.y" });
    CHECK (columns (fingers (R"("count": 1)"), { "finger/amp.out" }) == Strings { "finger[0]/amp.out" });
    CHECK (errors (fingers(), { .records = { "finger[3].force" } }) == Strings { "port/no_instance at record finger[3].force" });
    CHECK (errors (fingers(), { .records = { "finger.farce" } }) == Strings { "port/unknown at record finger.farce" });
}

TEST_CASE ("a feed column drives all instances except those with their own column", "[instances]")
{
    for (const bool first : { true, false })
    {
        CompileOptions options { .feeds = { "finger.in", "finger[1]/amp.in" }, .records = { "finger.out" } };
        if (! first) std::swap (options.feeds[0], options.feeds[1]);
        const auto plan = compile (fingers(), catalogue(), options).plan;
        REQUIRE (plan);
        plan->feeds()[0] = first ? 3.0 : 4.0;
        plan->feeds()[1] = first ? 4.0 : 3.0;
        plan->tick();
        CHECK (*plan->taps()[0].value == 3.0);
        CHECK (*plan->taps()[1].value == 4.0);
        CHECK (*plan->taps()[2].value == 3.0);
    }
    CHECK (errors (fingers(), { .feeds = { "finger.position" } }) == Strings { "feed/width at feed column finger.position" });
}

TEST_CASE ("a role is given to all instances, or one role to each", "[instances]")
{
    const auto rolesOf = [] (const std::string& finger) {
        std::vector<std::string> names;
        const auto plan = compile (fingers (finger), catalogue()).plan;
        REQUIRE (plan);
        for (const auto& role : plan->roles())
            names.push_back (role.name);
        return names;
    };
    CHECK (rolesOf (R"("count": 3)") == Strings { "stylus", "tip" });
    CHECK (rolesOf (R"("count": 3, "roles": { "tip": "thumb" })") == Strings { "stylus", "thumb" });
    CHECK (rolesOf (R"("count": 3, "roles": { "tip": [ "thumb", "index", "ring" ] })") == Strings { "index", "ring", "stylus", "thumb" });
    CHECK (rolesOf (R"("roles": { "tip": [ "thumb" ] })") == Strings { "stylus", "thumb" });
    CHECK (errors (fingers (R"("count": 3, "roles": { "tip": [ "thumb", "index" ] })")) == Strings { "node/bad_roles at /nodes/finger/roles/tip" });
    CHECK (errors (fingers (R"("roles": { "tip": [ "thumb", "index" ] })")) == Strings { "node/bad_roles at /nodes/finger/roles/tip" });

    auto plan = compile (fingers (R"("count": 2, "roles": { "tip": [ "thumb", "index" ] })"), catalogue(), { .records = { "finger.pressure" } }).plan;
    REQUIRE (plan);
    for (auto& role : plan->roles())
        role.state->reading.pressure = role.name == "thumb" ? 1.0 : (role.name == "index" ? 2.0 : 9.0);
    plan->tick();
    CHECK (*plan->taps()[0].value == 1.0);
    CHECK (*plan->taps()[1].value == 2.0);
}

TEST_CASE ("instances inside instances can be addressed individually or all together", "[instances]")
{
    auto g = fingers (R"("count": 3, "overrides": { "[1]/wall.offset": "2 mm" })");
    test::Sketch s;
    s.graph = g;
    auto& hand = s.subgraph ("palm");
    hand.nodes.push_back (g.root.nodes[4]);
    s.add (hand, "all", "vector.add", Json::object(), { { "inputs", 1 } }).add (hand, "finger.force -> all.in[0]");
    hand.expose.outputs = { { "force", { "all", "out" } }, { "resistance", { "finger", "resistance" } } };
    hand.expose.params = { { "offset", { "finger", "offset" } }, { "last", { "finger[2]", "offset" } } };
    s.graph.root.nodes[4] = test::Sketch::makeNode ("palm", "graph:palm");
    s.graph.root.nodes[4].extra["count"] = 2;
    s.graph.root.wires[0].from.node = "palm";
    const auto offsets = [&] (const Json& overrides) {
        s.graph.root.nodes[4].overrides = overrides;
        return values (s.graph, { "palm/finger/wall.offset" });
    };
    CHECK (offsets (Json::object()) == Doubles { 0.001, 0.002, 0.001, 0.001, 0.002, 0.001 });
    CHECK (columns (s.graph, { "palm[1]/finger/wall.depth" })
           == Strings { "palm[1]/finger[0]/wall.depth", "palm[1]/finger[1]/wall.depth", "palm[1]/finger[2]/wall.depth" });
    CHECK (columns (s.graph, { "palm[1].resistance" })
           == Strings { "palm[1]/finger[0]/wall.resistance", "palm[1]/finger[1]/wall.resistance", "palm[1]/finger[2]/wall.resistance" });
    CHECK (values (s.graph, { "motor.force.z" })[0] == Approx (8.0));
    CHECK (offsets ({ { "finger.offset", 0.004 } }) == Doubles { 0.004, 0.004, 0.004, 0.004, 0.004, 0.004 });
    CHECK (offsets ({ { "[1]/finger[2].offset", 0.005 }, { "finger[2]/wall.offset", 0.003 }, { "[0]/finger/wall.offset", 0.004 } })
           == Doubles { 0.004, 0.004, 0.004, 0.001, 0.002, 0.005 });
    s.graph.root.nodes[4].overrides = Json::object();
    CHECK (values (s.graph, { "palm/finger/wall.offset" }, { { "palm[1].offset", 0.003 }, { "palm.last", 0.004 } })
           == Doubles { 0.001, 0.002, 0.004, 0.003, 0.003, 0.004 });
    CHECK (values (s.graph, { "palm/finger/wall.offset" }, { { "palm[1]/finger[*]/wall.offset", 0.003 } })
           == Doubles { 0.001, 0.002, 0.001, 0.003, 0.003, 0.003 });
}

TEST_CASE ("when bypassed, each instance passes on its own inputs", "[instances]")
{
    auto g = fingers (R"("count": 2, "bypass": true)", R"(, "level.out -> finger[1].in", "finger[1].out -> sum.in")");
    g.find ("finger");
    for (auto& [name, patch] : g.graphs)
        patch.expose.outputs.front() = { "in", { "amp", "out" } };
    g.root.wires.erase (g.root.wires.begin());
    g.root.wires.back() = *graph::parseWire ("finger[1].in -> sum.in");
    CHECK (values (g, { "finger.in", "sum.out" }) == Doubles { 0.0, 2.0, 2.0 });
}

TEST_CASE ("a wrong count is refused with its place", "[instances]")
{
    for (const auto& count : { Json (0), Json (-1), Json (1.5), Json ("three"), Json (1000001), Json (1e300), Json(), Json::array ({ 1 }), Json (true) })
    {
        auto g = fingers();
        g.root.nodes[4].extra["count"] = count;
        g.root.wires.clear();
        INFO (count.dump());
        CHECK (errors (g) == Strings { "node/bad_count at /nodes/finger/count" });
    }
    auto g = fingers (R"("count": 400000)");
    g.root.wires.clear();
    CHECK (errors (g) == Strings { "graph/too_large at /nodes/finger/count" });
    CHECK (errors (fingers (R"("count": 3000)", R"(, "finger.resistance -> finger.in")")) == Strings { "graph/too_large at /wires/1" });
    g = fingers();
    g.root.nodes[1].extra["count"] = 2;
    CHECK (errors (g) == Strings { "node/needless_count at /nodes/level/count" });
}

TEST_CASE ("an instance that does not exist is refused wherever it is named", "[instances]")
{
    CHECK (errors (fingers (R"("count": 3)", R"(, "level.out -> finger[3].in")")) == Strings { "port/no_instance at /wires/1" });
    CHECK (errors (fingers (R"("count": 3)", R"(, "finger[99999].resistance -> sum.in")")) == Strings { "port/no_instance at /wires/1" });
    for (const auto* brackets : { "[0]", "[*]" })
    {
        CHECK (errors (fingers (R"("bypass": false)", std::string (R"(, "level.out -> finger)") + brackets + R"(.in")"))
               == Strings { "port/not_counted at /wires/1" });
        CHECK (errors (fingers (R"("count": 2)", std::string (R"(, "level)") + brackets + R"(.out -> sum.in")")) == Strings { "port/not_counted at /wires/1" });
    }
    CHECK (errors (fingers (R"("count": 3, "overrides": { "[3]/amp.gain": 1 })")) == Strings { "port/no_instance at /nodes/finger/overrides/[3]~1amp.gain" });
    CHECK (errors (fingers (R"("overrides": { "[0]/amp.gain": 1 })")) == Strings { "port/not_counted at /nodes/finger/overrides/[0]~1amp.gain" });
    CHECK (errors (fingers(), { .overrides = { { "finger[3].gain", 1 } } }) == Strings { "port/no_instance at --set finger[3].gain" });
    CHECK (errors (fingers(), { .feeds = { "finger[7].in" } }) == Strings { "port/no_instance at feed column finger[7].in" });
}

TEST_CASE ("a mistake inside a subgraph is reported once, for any number of instances", "[instances]")
{
    auto g = fingers (R"("count": 50, "overrides": { "amp.gain": "3 kg" })");
    for (auto& [name, patch] : g.graphs)
    {
        patch.nodes[0].params["offset"] = "1 s";
        patch.wires.push_back (*graph::parseWire ("wall.force -> amp.in"));
        patch.wires.push_back (*graph::parseWire ("wall.nothing -> amp.in"));
    }
    CHECK (errors (g).size() == 4);
}
