// SPDX-License-Identifier: MIT
// Edits of a few wires, which are compiled without visiting the whole graph.

#include "support/live.hpp"
#include "support/sketch.hpp"

#include <tactus/file/graph_file.hpp>
#include <tactus/graph/history.hpp>
#include <tactus/kit/at.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck/catch.h>

#include <algorithm>
#include <bit>
#include <random>

using namespace tactus;
using test::Sketch;

namespace
{
/// A chain that a hand drives and feels: "push" and "tilt" are typed, the others are generic.
Sketch chain()
{
    return Sketch {}
        .node ("hand", "device.position")
        .node ("wall", "deform.plane")
        .node ("push", "signal.constant", { { "value", "2 N" } })
        .node ("half", "signal.gain", { { "gain", 0.5 } })
        .node ("all", "signal.add", Json::object(), { { "inputs", 3 } })
        .node ("motor", "device.force")
        .wire ("hand.position -> wall.position")
        .wire ("wall.force -> motor.force")
        .wire ("push.out -> half.in")
        .wire ("half.out -> all.in[0]")
        .wire ("all.out -> motor.force.x");
}

/// A graph that runs twice. After each edit, one engine gets a plan that follows the edit, the other one a plan of a copy, whose trail is
/// empty, so that everything is compiled.
struct Twins
{
    explicit Twins (const graph::Graph& g, std::vector<std::string> records, Assets* assets = nullptr, std::size_t lanes = 1)
        : options { .records = std::move (records), .assets = assets, .lanes = lanes }, history (g), quick (compile (graph, catalogue(), options).plan),
          whole (compile (g, catalogue(), options).plan)
    {
    }

    /// Returns false if the edit does not compile.
    bool edit (graph::Command command)
    {
        if (! history.perform (std::move (command))) return false;
        const auto copy = graph;
        auto wanted = options;
        wanted.before = &quick.newest();
        auto mine = compile (graph, catalogue(), wanted);
        wanted.before = &whole.newest();
        auto other = compile (copy, catalogue(), wanted);
        same_messages = same_messages && test::text (mine.messages) == test::text (other.messages);
        if (mine.plan == nullptr || other.plan == nullptr || hasErrors (other.messages))
        {
            history.undo();
            return false;
        }
        quick.submit (std::move (mine.plan));
        whole.submit (std::move (other.plan));
        return true;
    }

    /// True if both give the same bits, and have the same records in the same order.
    bool agree()
    {
        for (int k = 0; k < 5; ++k)
        {
            quick.tick();
            whole.tick();
            const auto &a = quick.plan(), &b = whole.plan();
            if (a.owners() != b.owners() || a.taps().size() != b.taps().size() || a.flat().wires.size() != b.flat().wires.size()) return false;
            for (std::size_t t = 0; t < a.taps().size(); ++t)
                if (std::bit_cast<std::uint64_t> (*a.taps()[t].value) != std::bit_cast<std::uint64_t> (*b.taps()[t].value)) return false;
            for (std::size_t r = 0; r < a.roles().size(); ++r)
                if (a.roles()[r].untouched != b.roles()[r].untouched || a.roles()[r].state->applied.force != b.roles()[r].state->applied.force) return false;
            if (a.delays().size() != b.delays().size()) return false;
        }
        return true;
    }

    CompileOptions options;
    graph::History history;
    const graph::Graph& graph = history.graph();
    Engine quick, whole;
    bool same_messages = true;
};

graph::Wire wire (const std::string& text) { return *graph::parseWire (text); }

struct Dice
{
    std::mt19937 random;

    std::size_t operator() (std::size_t n) { return random() % n; }
};

/// Nodes with ports of many kinds. Sorted by name, they run in a different order from the one in the file.
graph::Graph someNodes (Dice& dice, int n)
{
    static const std::vector<std::string> types { "signal.add", "signal.gain", "signal.abs", "signal.constant", "filter.one_pole", "signal.multiply",
                                                  "vector.add", "vector.join", "vector.length", "vector.scale",
                                                  "motion.velocity", "signal.trigger", "signal.lfo" };
    Sketch s;
    s.node ("hand", "device.position").node ("wall", "deform.plane").node ("motor", "device.force");
    for (int i = 0; i < n; ++i)
        s.node ("n" + std::to_string (dice (1000)) + "_" + std::to_string (i), types[dice (types.size())]);
    return s.graph;
}

/// Any output to any input or parameter, usually nonsense.
graph::Wire someWire (Dice& dice, const graph::Graph& g)
{
    const auto pick = [&] (bool start) -> std::string {
        while (true)
        {
            const auto& node = g.root.nodes[dice (g.root.nodes.size())];
            const auto& type = *catalogue().find (node.type);
            const auto& rows = start ? type.outputs : dice (4) == 0 ? type.params
                                                                    : type.inputs;
            if (rows.empty()) continue;
            const auto& row = rows[dice (rows.size())];
            auto text = node.name + "." + std::string (row.id);
            if (row.list) text += "[" + std::to_string (dice (2)) + "]";
            if (row.width == 3 && dice (3) == 0) text += std::string (".") + "xyz"[dice (3)];
            return text;
        }
    };
    const auto from = pick (true);
    auto made = wire (from + (dice (8) == 0 ? " -> [2] -> " : " -> ") + pick (false));
    if (dice (5) == 0) made.gain = 0.5;
    if (dice (8) == 0) made.enabled = false;
    return made;
}

graph::Command someEdit (Dice& dice, const graph::Graph& g)
{
    const auto& wires = g.root.wires;
    const auto which = wires.empty() ? 0 : dice (5);
    if (which < 2) return graph::AddWire { "", someWire (dice, g) };
    const auto id = wires[dice (wires.size())].id;
    if (which == 2) return graph::RemoveWire { "", id };
    if (which == 3) return graph::ChangeWire { "", id, someWire (dice, g) };
    return graph::Batch { "both", { graph::RemoveWire { "", id }, graph::AddWire { "", someWire (dice, g) } } };
}
}   // namespace

TEST_CASE ("an edit of a wire shares everything but the node where the wire ends", "[plan][live]")
{
    const auto sketch = Sketch {}
                            .node ("a", "signal.constant", { { "value", 2.0 } })
                            .node ("b", "signal.abs")
                            .node ("sum", "signal.add", Json::object(), { { "inputs", 3 } })
                            .wire ("a.out -> b.in")
                            .wire ("b.out -> sum.in[0]");
    Twins twins { sketch.graph, { "sum.out" } };
    twins.quick.tick();
    twins.whole.tick();
    const auto id = twins.graph.root.wires[1].id;
    const auto before = twins.quick.newestShared();
    REQUIRE (twins.edit (graph::AddWire { "", wire ("a.out -> sum.in[1]") }));
    CHECK (twins.quick.newest().rewired() == 1);
    CHECK (twins.whole.newest().rewired() == 0);
    for (std::size_t i = 0; i < before->instances().size(); ++i)
    {
        CHECK (twins.quick.newest().instances()[i].node == before->instances()[i].node);
        CHECK (twins.quick.newest().instances()[i].outputs == before->instances()[i].outputs);
        CHECK ((twins.quick.newest().instances()[i].sources == before->instances()[i].sources) == (i != 2));
    }
    CHECK (twins.agree());
    CHECK (*twins.quick.plan().taps()[0].value == 4.0);
    REQUIRE (twins.edit (graph::RemoveWire { "", id }));
    CHECK (twins.quick.newest().rewired() == 2);
    CHECK (twins.agree());
    CHECK (*twins.quick.plan().taps()[0].value == 2.0);
}

TEST_CASE ("edits that are more than a wire compile everything", "[plan][live]")
{
    Twins twins { chain().graph, {} };
    REQUIRE (twins.edit (graph::AddWire { "", wire ("push.out -> all.in[1]") }));
    CHECK (twins.quick.newest().rewired() == 1);
    CHECK (twins.agree());

    SECTION ("another kind of edit") { REQUIRE (twins.edit (graph::SetParam { "", "half", "gain", Json (0.25) })); }
    SECTION ("a delay") { REQUIRE (twins.edit (graph::AddWire { "", wire ("half.out -> [1] -> all.in[2]") })); }
    SECTION ("outputs that nothing has read") { REQUIRE (twins.edit (graph::AddWire { "", wire ("motor.applied.x -> all.in[2]") })); }
    SECTION ("another node") { REQUIRE (twins.edit (graph::AddNode { "", Sketch::makeNode ("idle", "signal.abs") })); }
    CHECK (twins.quick.newest().rewired() == 0);
    CHECK (twins.agree());
    CHECK (twins.same_messages);
}

TEST_CASE ("a node peeks only if something reads its outputs", "[plan][live]")
{
    const auto peeks = [] (const Plan& plan) { return std::ranges::count (plan.records(), catalogue().find ("device.force")->peek, &Record::step); };
    CHECK (peeks (*chain().compile().plan) == 0);
    CHECK (peeks (*chain().compile ({ .records = { "motor.force" } }).plan) == 0);
    CHECK (peeks (*chain().compile ({ .records = { "motor.applied" } }).plan) == 1);

    Twins twins { chain().graph, { "motor.force" } };
    REQUIRE (twins.edit (graph::AddWire { "", wire ("motor.applied.x -> all.in[2]") }));
    CHECK (twins.agree());
    CHECK (peeks (twins.quick.plan()) == 1);
    const auto id = twins.graph.root.wires.back().id;
    REQUIRE (twins.edit (graph::AddWire { "", wire ("motor.applied.x -> all.in[1]") }));
    CHECK (twins.quick.newest().rewired() == 1);
    CHECK (twins.agree());
    REQUIRE (twins.edit (graph::RemoveWire { "", id }));
    CHECK (twins.quick.newest().rewired() == 2);
    CHECK (twins.agree());
    REQUIRE (twins.edit (graph::RemoveWire { "", twins.graph.root.wires.back().id }));
    CHECK (twins.agree());
    CHECK (peeks (twins.quick.plan()) == 0);
}

TEST_CASE ("an edit of a wire into an instance that runs as a lane compiles everything", "[plan][live][lanes]")
{
    const auto g = readGraph (R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1000,
        "nodes": { "a": { "type": "signal.lfo", "params": { "frequency": 20 } }, "b": { "type": "vector.join" }, "tip": { "type": "graph:tip", "count": 5 } },
        "wires": ["a.out -> b.z", "b.out -> tip.place", "b.out -> tip[0].shake", "b.out -> tip[3].shake"],
        "graphs": { "tip": {
            "nodes": { "at": { "type": "vector.add", "settings": { "inputs": 2 } }, "wall": { "type": "deform.plane" } },
            "wires": ["at.out -> wall.position"],
            "expose": { "inputs": { "place": "at.in[0]", "shake": "at.in[1]" }, "outputs": { "force": "wall.force" } } } } })");
    INFO (test::text (g.messages));
    REQUIRE_FALSE (hasErrors (g.messages));
    Twins twins { g.graph, { "tip[0]/wall.force", "tip[1]/wall.force", "tip[3]/wall.force", "tip[4]/wall.force", "tip[0]/at.out" }, nullptr, 8 };
    REQUIRE (std::ranges::any_of (twins.quick.newest().instances(), [] (const auto& i) { return i.lanes != nullptr; }));
    for (const auto index : { 3U, 2U })
    {
        CHECK (twins.agree());
        REQUIRE (twins.edit (graph::RemoveWire { "", twins.graph.root.wires[index].id }));
        CHECK (twins.quick.newest().rewired() == 0);
        for (int k = 0; k < 40; ++k)
            CHECK (twins.agree());
    }
}

TEST_CASE ("a graph that was changed without its history is compiled as it is", "[plan][live]")
{
    const auto sketch = Sketch {}
                            .node ("a", "signal.constant", { { "value", 2.0 } })
                            .node ("b", "signal.abs")
                            .node ("sum", "signal.add")
                            .wire ("a.out -> b.in")
                            .wire ("b.out -> sum.in[0]");
    const CompileOptions options { .records = { "sum.out" } };
    const auto sumOf = [&options] (const graph::Graph& g, Engine& engine) {
        auto wanted = options;
        wanted.before = &engine.newest();
        engine.submit (compile (g, catalogue(), wanted).plan);
        CHECK (engine.newest().rewired() == 0);
        for (int k = 0; k < 1000; ++k)   // a new value of a parameter is ramped
            engine.tick();
        return *engine.plan().taps()[0].value;
    };
    const auto more = graph::AddWire { "", wire ("a.out -> sum.in[1]") };

    SECTION ("between two commands")
    {
        auto g = sketch.graph;
        Engine engine { compile (g, catalogue(), options).plan };
        g.root.nodes[0].params["value"] = 5.0;
        REQUIRE (graph::apply (g, more));
        CHECK (sumOf (g, engine) == 10.0);
    }
    SECTION ("after a command, in a copy")
    {
        graph::History history (sketch.graph);
        Engine engine { compile (history.graph(), catalogue(), options).plan };
        REQUIRE (history.perform (more));
        auto g = history.graph();
        g.root.nodes[0].params["value"] = 5.0;
        CHECK (sumOf (g, engine) == 10.0);
    }
    SECTION ("a copy that was moved and became its own history")
    {
        graph::History history (sketch.graph);
        Engine engine { compile (history.graph(), catalogue(), options).plan };
        auto g = history.graph();
        g.root.nodes[1].type = "signal.gain";
        graph::History other (std::move (g));
        REQUIRE (other.perform (graph::SetParam { "", "b", "gain", Json (3.0) }));
        REQUIRE (other.perform (more));
        CHECK (sumOf (other.graph(), engine) == 8.0);
    }
    SECTION ("an assigned graph")
    {
        graph::History history (sketch.graph);
        Engine engine { compile (history.graph(), catalogue(), options).plan };
        auto g = sketch.graph;
        g.root.nodes[0].params["value"] = 5.0;
        REQUIRE (history.perform (graph::ReplaceGraph { std::make_shared<graph::Graph> (std::move (g)) }));
        REQUIRE (history.perform (more));
        CHECK (sumOf (history.graph(), engine) == 10.0);
    }
}

TEST_CASE ("a file that has changed is read again after an edit of a wire", "[plan][live]")
{
    struct OneTable final : Assets
    {
        std::shared_ptr<const Grid> grid = std::make_shared<const Grid> (Grid { 2, 2, { 0.0, 0.0, 0.0, 0.0 } });

        Loaded<Signal> signal (const std::string& path) override { return none (path); }
        Loaded<Grid> image (const std::string& path) override { return none (path); }
        Loaded<Grid> table (const std::string&) override { return grid; }
        Loaded<Mesh> mesh (const std::string& path) override { return none (path); }

        static Message none (const std::string& path) { return Message::error ("asset/unreadable", path, "there is only a table"); }
    } assets;
    const Json map { { "csv", "hills.csv" }, { "pitch", 0.001 }, { "height", 1.0 } };
    const auto sketch = Sketch {}
                            .node ("map", "texture.height_map", Json::object(), { { "map", map } })
                            .node ("a", "signal.constant", { { "value", 2.0 } })
                            .node ("sum", "signal.add", Json::object(), { { "inputs", 3 } })
                            .wire ("a.out -> sum.in[0]");
    Twins twins { sketch.graph, { "map.value" }, &assets };
    const auto whole = twins.quick.newest().instances()[0].node;
    REQUIRE (twins.edit (graph::AddWire { "", wire ("a.out -> sum.in[1]") }));
    CHECK (twins.quick.newest().rewired() == 1);
    CHECK (twins.quick.newest().instances()[0].node == whole);
    CHECK (twins.agree());

    assets.grid = std::make_shared<const Grid> (Grid { 2, 2, { 1.0, 1.0, 1.0, 1.0 } });
    REQUIRE (twins.edit (graph::AddWire { "", wire ("a.out -> sum.in[2]") }));
    CHECK (twins.quick.newest().rewired() == 0);
    CHECK (twins.agree());
    CHECK (*twins.quick.plan().taps()[0].value == Approx (1.0));
}

TEST_CASE ("moving a node on the canvas compiles nothing", "[plan][live]")
{
    Twins twins { chain().graph, {} };
    twins.quick.tick();
    twins.whole.tick();
    REQUIRE (twins.edit (graph::SetHeader { .ui = Json { { "zoom", 2 } } }));
    CHECK (twins.quick.newest().rewired() == 1);
    CHECK (twins.quick.newest().roles()[0].untouched);
    CHECK (twins.agree());
}

TEST_CASE ("any edits of wires give the same plan as compiling everything", "[plan][live][property]")
{
    int edits = 0, rewired = 0;
    rc::prop ("any graph, any wires", [&] {
        Dice dice { std::mt19937 (*rc::gen::arbitrary<unsigned>()) };
        const auto graph = someNodes (dice, 3 + static_cast<int> (dice (12)));
        std::vector<std::string> records { "wall.force", "motor.force" };
        for (const auto& node : graph.root.nodes)
            for (const auto& row : catalogue().find (node.type)->outputs)
                records.push_back (node.name + "." + std::string (row.id));
        Twins twins { graph, std::move (records) };
        for (int k = 0; k < 60; ++k)
        {
            if (! twins.edit (someEdit (dice, twins.graph))) continue;
            ++edits;
            rewired += twins.quick.newest().rewired() > 0;
            RC_ASSERT (twins.agree());
        }
        RC_ASSERT (twins.same_messages);
    });
    CHECK (edits > 200);
    CHECK (rewired > edits / 10);
}
