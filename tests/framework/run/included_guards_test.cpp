// SPDX-License-Identifier: MIT
// The guards of included graphs ("file:").

#include "support/sketch.hpp"

#include <tactus/file/graph_file.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/run/guard/included_guards.hpp>
#include <tactus/run/run.hpp>

#include <catch2/catch.hpp>

#include <map>

using namespace tactus;

namespace
{
graph::Graph read (const std::string& nodes, const std::string& devices = "", const std::string& graphs = "")
{
    auto found = readGraph (R"({ "format": "tactus-graph", "version": 1, "nodes": { )" + nodes + R"( }, "wires": [], "devices": { )" + devices
                            + R"( }, "graphs": { )" + graphs + " } }");
    INFO (test::text (found.messages));
    REQUIRE_FALSE (hasErrors (found.messages));
    return std::move (found.graph);
}

/// A graph that pushes with 5 N and has this guard, 1 N by default.
std::shared_ptr<const graph::Graph> pushing (const std::string& guard = R"("max_force": "1 N")")
{
    auto graph = read (R"("push": { "type": "signal.constant", "params": { "value": 5 } }, "motor": { "type": "device.force", "role": "tip" })",
                       R"("tip": { "driver": "sim", "guard": { )" + guard + " } }");
    graph.root.wires.push_back (*graph::parseWire ("push.out -> motor.force.x"));
    return std::make_shared<const graph::Graph> (std::move (graph));
}

class Still final : public Device
{
public:
    void prepare (double) override {}
    Reading read() noexcept override { return {}; }
    void write (const Effort& e) noexcept override { force = e.force.x(); }

    double force = 0.0;
};

/// The force on each role after one tick of the graph, on devices without limits. `messages` gets those of openDevices.
std::map<std::string, double> forces (const graph::Graph& graph, Messages* messages = nullptr)
{
    std::map<std::string, Still*> devices;
    Run run (catalogue(), {}, [&] (const std::string& role, const graph::Graph&, const Plan&, Messages&) -> Run::RoleDevice {
        auto device = std::make_unique<Still>();
        devices[role] = device.get();
        return { std::move (device), {} };
    });
    const auto loaded = run.load (graph);
    INFO (test::text (loaded));
    REQUIRE (run.hasEngine());
    Messages found;
    run.openDevices (graph, found);
    run.tick();
    if (messages != nullptr) *messages = found;
    std::map<std::string, double> all;
    for (const auto& [role, d] : run.devices())
        all[role] = d.device ? devices.at (role)->force : 0.0;
    return all;
}
}   // namespace

TEST_CASE ("the guard of an included graph tightens that of the whole graph, and never loosens it", "[run][safety]")
{
    auto graph = read (R"("part": { "type": "file:part.json" })");
    graph.files["part.json"] = pushing();
    CHECK (forces (graph).at ("tip") == Approx (1.0));

    graph.devices = { { "tip", Json { { "driver", "sim" }, { "guard", { { "max_force", 3.0 } } } } } };
    CHECK (forces (graph).at ("tip") == Approx (1.0));
    graph.devices[0].second["guard"]["max_force"] = 0.5;
    CHECK (forces (graph).at ("tip") == Approx (0.5));

    graph.files["part.json"] = pushing (R"("max_speed": 9)");
    graph.devices.clear();
    CHECK (forces (graph).at ("tip") == 5.0);
}

TEST_CASE ("the guard of an included graph follows its role through the roles, the instances and the graphs around it", "[run][safety]")
{
    const std::string fingers = R"("finger": { "type": "file:part.json", "count": 2, "roles": { "tip": [ "thumb", "middle" ] } })";
    auto graph = read (R"("hand": { "type": "graph:hand", "roles": { "middle": "ring" } })", "", R"("hand": { "nodes": { )" + fingers + R"( }, "wires": [] })");
    graph.files["part.json"] = pushing();
    const auto found = includedGuards (graph);
    REQUIRE (found.size() == 2);
    CHECK (found[0].role == "thumb");
    CHECK (found[1].role == "ring");
    const auto after = forces (graph);
    CHECK (after.size() == 2);
    CHECK (after.at ("thumb") == Approx (1.0));
    CHECK (after.at ("ring") == Approx (1.0));
}

TEST_CASE ("a wrong guard in an included graph is an error with the name of the file, and its role gets no device", "[run][safety]")
{
    auto graph = read (R"("part": { "type": "file:part.json" })");
    graph.files["part.json"] = pushing (R"("max_force": "many")");
    Messages messages;
    CHECK (forces (graph, &messages).empty());
    REQUIRE (messages.size() == 1);
    CHECK (messages[0].file == "part.json");
    CHECK (messages[0].where == "/devices/tip/guard/max_force");
}

TEST_CASE ("a file that is included along many paths is looked at once", "[run]")
{
    auto inner = pushing();
    for (int level = 0; level < 60; ++level)   // 2^60 paths
    {
        auto outer = std::make_shared<graph::Graph> (read (""));
        outer->files = { { "a.json", inner }, { "b.json", inner } };
        inner = std::move (outer);
    }
    CHECK (includedGuards (*inner).empty());   // no node uses any of the files
}
