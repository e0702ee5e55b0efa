// SPDX-License-Identifier: MIT
// A node whose outputs lead nowhere is computed for nothing, and a value far from the usual one is mostly a slip in its unit: both are warnings.

#include <tactus/file/graph_file.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/plan/rules/unheard.hpp>

#include <catch2/catch.hpp>

using namespace tactus;

namespace
{
graph::Graph graphOf (const std::string& nodes, const std::string& wires, const std::string& rest = "")
{
    const std::string head = R"({ "format": "tactus-graph", "version": 2, "nodes": { "hand": { "type": "device.position", "role": "pen" }, )";
    auto loaded = readGraph (head + nodes + R"( }, "wires": [ )" + wires + " ]" + rest + "}");
    REQUIRE (loaded.messages.empty());
    return std::move (loaded.graph);
}

std::string placesOf (const Messages& messages)
{
    std::string places;
    for (const auto& m : messages)
    {
        CHECK (m.id == "node/no_effect");
        CHECK (m.severity == Message::Severity::warning);
        CHECK_FALSE (m.remedy.empty());
        places += (places.empty() ? "" : " ") + m.where;
    }
    return places;
}

std::string unheardIn (const graph::Graph& g, const std::vector<std::string>& recorded = {})
{
    return placesOf (plan::unheardNodes (g, catalogue(), recorded));
}

const std::string wall = R"("wall": { "type": "deform.plane" }, "motor": { "type": "device.force", "role": "pen" })",
                  felt = R"("hand.position -> wall.position", "wall.force -> motor.force")";

/// The warnings about the value of one parameter.
Messages warningsOf (const std::string& type, const std::string& param, const std::string& value)
{
    auto g = graphOf (R"("n": { "type": ")" + type + R"(", "params": { ")" + param + "\": " + value + " } }", "");
    auto compiled = compile (g, catalogue());
    REQUIRE (compiled.plan);
    std::erase_if (compiled.messages, [] (const Message& m) { return m.id != "param/unusual"; });
    for (const auto& m : compiled.messages)
    {
        CHECK (m.severity == Message::Severity::warning);
        CHECK (m.where == "/nodes/n/params/" + param);
    }
    return compiled.messages;
}
}   // namespace

TEST_CASE ("a node whose outputs lead nowhere is a warning, and only the last of a chain is named", "[plan]")
{
    CHECK (unheardIn (graphOf (wall, felt)).empty());
    CHECK (unheardIn (graphOf (wall + R"(, "skin": { "type": "deform.plane" })", felt)) == "/nodes/skin");
    CHECK (unheardIn (graphOf (wall + R"(, "drag": { "type": "friction.elasto_plastic" }, "half": { "type": "vector.scale" })",
                               felt + R"(, "hand.position -> drag.position", "drag.force -> half.in")"))
           == "/nodes/half");
}

TEST_CASE ("nodes that only feed each other in a loop are named, for the loop has no last one", "[plan]")
{
    const auto loop =
        graphOf (wall + R"(, "a": { "type": "signal.gain" }, "b": { "type": "signal.gain" })", felt + R"(, "a.out -> b.in", "b.out -> [1] -> a.in")");
    CHECK (unheardIn (loop) == "/nodes/a /nodes/b");
}

TEST_CASE ("a wire into a parameter, a wire that is switched off, a record and an exposed output count", "[plan]")
{
    const auto lfo = wall + R"(, "slow": { "type": "signal.lfo" })";
    CHECK (unheardIn (graphOf (lfo, felt)) == "/nodes/slow");
    CHECK (unheardIn (graphOf (lfo, felt), { "slow.out" }).empty());
    CHECK (unheardIn (graphOf (lfo, felt + R"(, { "wire": "slow.out -> (+) wall.offset", "gain": "1 mm", "enabled": false })")).empty());
    CHECK (unheardIn (graphOf (lfo, felt, R"(, "expose": { "outputs": { "value": "slow.out" } })")).empty());
}

TEST_CASE ("a section that runs several times a tick is there to be heard", "[plan]")
{
    const auto graphs = R"(, "graphs": { "tone": { "nodes": { "wave": { "type": "signal.lfo" } }, "wires": [],
        "expose": { "outputs": { "value": "wave.out" } } } })";
    CHECK (unheardIn (graphOf (wall + R"(, "tone": { "type": "graph:tone", "times": 12 })", felt, graphs)).empty());
    CHECK (unheardIn (graphOf (wall + R"(, "tone": { "type": "graph:tone" })", felt, graphs)) == "/nodes/tone");
}

TEST_CASE ("a graph without any motor is there to be recorded, and gets no warning", "[plan]")
{
    CHECK (unheardIn (graphOf (R"("wall": { "type": "deform.plane" })", R"("hand.position -> wall.position")")).empty());
}

TEST_CASE ("a subgraph that drives a device is an end, and what leads nowhere inside of one is named there", "[plan]")
{
    const auto graphs = R"(, "graphs": { "pad": { "nodes": { "skin": { "type": "deform.plane" }, "pad": { "type": "device.force", "role": "pen" } },
        "wires": [ "skin.force -> pad.force" ], "expose": { "inputs": { "position": "skin.position" } } },
        "tone": { "nodes": { "wave": { "type": "signal.lfo" }, "other": { "type": "signal.lfo" } }, "wires": [],
        "expose": { "outputs": { "value": "wave.out" } } } })";
    CHECK (unheardIn (graphOf (R"("pad": { "type": "graph:pad" })", R"("hand.position -> pad.position")", graphs)) == "/graphs/tone/nodes/other");
    CHECK (unheardIn (graphOf (R"("pad": { "type": "graph:pad" }, "tone": { "type": "graph:tone" })",
                               R"("hand.position -> pad.position", "tone/other.out -> pad/skin.offset")", graphs))
               .empty());
}

TEST_CASE ("a value more than ten times beyond its usual range is a warning that speaks of the unit", "[plan]")
{
    const auto warnings = warningsOf ("friction.elasto_plastic", "d_max", "0.3");   // usually up to 0.01 m
    REQUIRE (warnings.size() == 1);
    CHECK (warnings[0].text.find ("0.3 m") != std::string::npos);
    CHECK (warnings[0].text.find ("0.01 m") != std::string::npos);
    CHECK (warnings[0].remedy.find ("\"0.3 mm\"") != std::string::npos);

    CHECK (warningsOf ("friction.elasto_plastic", "d_max", "\"300 mm\"").size() == 1);
    CHECK (warningsOf ("friction.elasto_plastic", "d_max", "1e-8").size() == 1);
    CHECK (warningsOf ("deform.plane", "offset", "-2").size() == 1);
    CHECK (warningsOf ("texture.grating", "angle", "90").size() == 1);
}

TEST_CASE ("a value outside the usual range but near it, zero, and one of a node that takes any unit are fine", "[plan]")
{
    CHECK (warningsOf ("friction.elasto_plastic", "d_max", "\"90 mm\"").empty());
    CHECK (warningsOf ("friction.elasto_plastic", "mu", "15").empty());
    CHECK (warningsOf ("cut.blade", "thickness", "0").empty());
    CHECK (warningsOf ("signal.constant", "value", "1e6").empty());
    CHECK (warningsOf ("signal.gain", "gain", "1000").empty());
}
