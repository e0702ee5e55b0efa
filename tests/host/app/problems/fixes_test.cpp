// SPDX-License-Identifier: MIT
#include <host/app/problems/fixes.hpp>

#include <tactus/file/graph_file.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/plan/compile.hpp>

#include <catch2/catch.hpp>

#include <algorithm>

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
    CHECK (culpritOf (g, errors[0]).patch == "inner");
    CHECK (culpritOf (g, errors[0]).id != 0);
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
