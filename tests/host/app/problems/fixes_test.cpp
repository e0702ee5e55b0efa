// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/problems/fixes.hpp>
#include <host/app/problems/missing_ends.hpp>

#include <tactus/file/graph_file.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/plan/compile.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <utility>

using namespace tactus;
using namespace tactus::host;

namespace
{
graph::Graph graphOf (const std::string& body)
{
    auto read = readGraph (R"({"format":"tactus-graph","version":1,"name":"broken",)" + body + "}");
    return std::move (read.graph);
}

Messages errorsOf (const graph::Graph& g)
{
    auto messages = compile (g, catalogue(), {}).messages;
    std::erase_if (messages, [] (const Message& m) { return m.severity != Message::Severity::error; });
    return messages;
}

/// Applies fixes until none is offered. Returns the remaining errors.
Messages fixAll (graph::Graph& g)
{
    for (int i = 0; i < 20; ++i)
    {
        const auto errors = errorsOf (g);
        const auto fixable = std::ranges::find_if (errors, [&] (const Message& m) { return fixOf (g, m).has_value(); });
        if (fixable == errors.end()) return errors;
        const auto done = graph::apply (g, fixOf (g, *fixable)->command);
        REQUIRE (done.has_value());
    }
    return errorsOf (g);
}
}   // namespace

TEST_CASE ("a loop is fixed by a delay on the wire that closes it", "[app][problems]")
{
    auto g = graphOf (R"("nodes":{"a":{"type":"signal.slew"},"b":{"type":"signal.slew"}},"wires":["a.out -> b.in","b.out -> a.in"])");
    const auto errors = errorsOf (g);
    REQUIRE (errors.size() == 1);
    CHECK (errors[0].id == "graph/loop");
    CHECK (fixOf (g, errors[0])->label == "Delay wire by a tick");
    CHECK (fixAll (g).empty());
    CHECK (std::ranges::count (g.root.wires, 1, &graph::Wire::delay) == 1);
}

TEST_CASE ("a problem inside a subgraph is found and fixed there", "[app][problems]")
{
    auto g = graphOf (R"("nodes":{"g":{"type":"graph:inner"}},"wires":[],
        "graphs":{"inner":{"nodes":{"a":{"type":"signal.slew"},"b":{"type":"signal.slew"}},"wires":["a.out -> b.in","b.out -> a.in"]}})");
    const auto errors = errorsOf (g);
    REQUIRE_FALSE (errors.empty());
    CHECK (locationOf (g, errors[0]).patch == "inner");
    CHECK (locationOf (g, errors[0]).id != 0);
    CHECK (fixAll (g).empty());
}

TEST_CASE ("fixes for a wire of the wrong unit, a param out of range and an unknown node type", "[app][problems]")
{
    auto g = graphOf (R"("nodes":{"hand":{"type":"device.position","role":"r"},"motor":{"type":"device.force","role":"r"},
        "wall":{"type":"deform.plane","params":{"stiffness":-1}},"what":{"type":"no.such"}},"wires":["hand.position -> motor.force"])");
    CHECK (errorsOf (g).size() >= 3);
    CHECK (fixAll (g).empty());
    CHECK (g.root.wires.empty());
    CHECK (g.root.find ("what") == nullptr);
    CHECK (g.root.find ("wall")->params.empty());
    CHECK (g.root.find ("motor") != nullptr);
}

TEST_CASE ("device nodes of a graph without devices get a device", "[app][problems]")
{
    auto g = graphOf (R"("nodes":{"hand":{"type":"device.position"},"motor":{"type":"device.force"}},"wires":[])");
    CHECK (errorsOf (g).size() == 2);
    CHECK (fixAll (g).empty());
    REQUIRE (g.devices.size() == 1);
    CHECK (g.root.find ("hand")->role == "stylus");
    CHECK (g.root.find ("motor")->role == "stylus");
}

TEST_CASE ("an unknown type becomes the one that was probably meant", "[app][problems]")
{
    const auto meant = GENERATE (std::pair { "deform.plain", "deform.plane" }, std::pair { "contact.plane", "deform.plane" },
                                 std::pair { "texture.gratng", "texture.grating" }, std::pair { "xyzzy.foo", "" });
    auto g = graphOf (R"("nodes":{"a":{"type":")" + std::string (meant.first) + R"(","params":{"stiffness":"300 N/m"}}},"wires":[])");
    const auto errors = errorsOf (g);
    REQUIRE (errors.size() == 1);
    const auto fix = fixOf (g, errors[0]);
    REQUIRE (fix.has_value());
    CAPTURE (meant.first, fix->label);
    CHECK (fix->label == (std::string (meant.second).empty() ? "Remove the node" : "Change to " + std::string (meant.second)));
    REQUIRE (graph::apply (g, fix->command).has_value());
    if (! std::string (meant.second).empty()) CHECK (g.root.find ("a")->type == meant.second);
    if (std::string (meant.second) == "deform.plane") CHECK (g.root.find ("a")->params["stiffness"] == "300 N/m");
}

TEST_CASE ("a graph without a hand or a motor says so, and a click adds them with a device", "[app][problems]")
{
    CHECK (missingEnds (graphOf (R"("nodes":{},"wires":[])")).empty());
    auto g = graphOf (R"("nodes":{"wall":{"type":"deform.plane","ui":{"at":[100,40]}}},"wires":[])");
    auto missing = missingEnds (g);
    REQUIRE (missing.size() == 2);
    for (const auto& m : missing)
        REQUIRE (graph::apply (g, fixOf (g, m)->command).has_value());
    CHECK (missingEnds (g).empty());
    CHECK (errorsOf (g).empty());
    REQUIRE (g.devices.size() == 1);
    const auto x = [&] (const char* type) { return std::ranges::find (g.root.nodes, type, &graph::Node::type)->extra["ui"]["at"][0].get<double>(); };
    CHECK (x ("device.position") < 100.0);
    CHECK (x ("device.force") > 100.0);
    CHECK (missingEnds (graphOf (R"("nodes":{"pad":{"type":"graph:pad"}},"wires":[],"graphs":{"pad":{"nodes":{
        "hand":{"type":"device.position"},"buzz":{"type":"device.signal_out"}},"wires":[]}})"))
               .empty());
}

TEST_CASE ("no preset lacks a hand or a motor", "[app][problems]")
{
    for (const auto& entry : std::filesystem::directory_iterator (TACTUS_SOURCE_DIR "/graphs"))
        if (entry.path().extension() == ".json")
        {
            CAPTURE (entry.path().string());
            CHECK (missingEnds (loadGraph (entry.path()).graph).empty());
        }
}
