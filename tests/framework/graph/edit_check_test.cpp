// SPDX-License-Identifier: MIT
// Edits are checked against the node types when they are made.

#include "edit_rig.hpp"
#include "support/random_edit.hpp"
#include "support/random_graph.hpp"
#include "support/sketch.hpp"

#include <support/property.hpp>
#include <tactus/graph/history.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/plan/compile.hpp>

#include <catch2/catch.hpp>

#include <limits>
#include <random>

using namespace tactus;
using namespace tactus::graph;
using test::Sketch;

namespace
{
Messages errorsOf (const Graph& g)
{
    auto messages = problemsOf (g, catalogue());
    std::erase_if (messages, [] (const Message& m) { return m.severity != Message::Severity::error || m.id == "node/no_role"; });
    return messages;
}

/// The edit on its own, without a check of types.
bool isRight (const Graph& g, const Command& command)
{
    History unchecked (g, nullptr);
    return unchecked.perform (command) && errorsOf (unchecked.graph()).empty();
}

Graph anyGraph (unsigned seed)
{
    return test::prefixed (test::randomGraph (seed, 2 + static_cast<int> (seed % 25)), "e_", "right");
}

Command anyEdit (std::mt19937& random, const Graph& g)
{
    const auto below = [&] (unsigned n) { return static_cast<unsigned> (random() % n); };
    if (below (10) == 0) return test::randomRegrouping (random, g);
    if (below (6) != 0) return test::randomEdit (random, g, "e_", "right");
    Batch several { "several", {} };
    for (unsigned i = 0; i < 3; ++i)
        several.commands.push_back (test::randomEdit (random, g, "e_", "right"));
    return several;
}
}   // namespace

TEST_CASE ("a graph without errors has none after any edit that is accepted, and only edits that add one are refused", "[edit_check]")
{
    test::property ("random edits of random graphs that compile", [] {
        const auto seed = *rc::gen::arbitrary<unsigned>();
        std::mt19937 random (seed);
        History history (anyGraph (seed));
        RC_PRE (errorsOf (history.graph()).empty());
        for (int i = 0; i < 40; ++i)
        {
            if (random() % 8 == 0 && history.position() > 0)   // the check must follow these, too
                random() % 2 == 0 ? history.undo() : history.redo();
            const auto command = anyEdit (random, history.graph());
            const bool is_right = isRight (history.graph(), command);
            const auto done = history.perform (command);
            const bool is_accepted = static_cast<bool> (done);
            if (is_accepted != is_right)
                RC_FAIL (nameOf (command) + (is_accepted ? " was accepted: " + test::text (errorsOf (history.graph())) : " was refused: " + describe (done.error())));
            if (! is_accepted) RC_ASSERT (! done.error().where.empty() && ! done.error().remedy.empty());
        }
        const auto compiled = compile (history.graph(), catalogue());
        RC_ASSERT (compiled.plan || test::has (compiled.messages, "node/no_role"));
    });
}

TEST_CASE ("a graph with errors can be edited like any other: no accepted edit adds an error", "[edit_check]")
{
    test::property ("random edits of random graphs, some of which do not compile", [] {
        const auto seed = *rc::gen::arbitrary<unsigned>();
        std::mt19937 random (seed);
        History broken (anyGraph (seed), nullptr);
        for (int i = 0; i < 10; ++i)
            (void)broken.perform (anyEdit (random, broken.graph()));

        History history (broken.graph());
        for (int i = 0; i < 20; ++i)
        {
            const auto before = errorsOf (history.graph()).size();
            const auto edit = test::randomEdit (random, history.graph(), "e_", "right");
            const auto* param = std::get_if<SetParam> (&edit.edit);
            if (! history.perform (edit) || param == nullptr || before > 20) continue;
            RC_ASSERT (errorsOf (history.graph()).size() <= before);
        }
        while (history.undo())
        {
        }
        RC_ASSERT (test::fingerprint (history.graph()) == test::fingerprint (broken.graph()));
        while (history.redo())
        {
        }
    });
}

namespace
{
/// A stylus on wood that compiles, and that has one of everything that can be edited.
Graph wood()
{
    Sketch s;
    s.node ("hand", "device.position").node ("drag", "friction.elasto_plastic").node ("board", "deform.plane").node ("gain", "signal.gain");
    s.node ("sum", "signal.add", Json::object(), { { "inputs", 2 } }).node ("motor", "device.force").node ("grain", "graph:grain");
    for (auto& n : s.graph.root.nodes)
        if (n.type.starts_with ("device.")) n.role = "stylus";
    s.add (s.subgraph ("grain"), "wave", "texture.grating");
    s.subgraph ("grain").expose.inputs = { { "position", { "wave", "position" } } };
    s.subgraph ("grain").expose.outputs = { { "force", { "wave", "force" } } };
    s.wire ("hand.position -> drag.position").wire ("hand.position -> board.position").wire ("board.resistance -> drag.normal_force");
    s.wire ("drag.force -> motor.force").wire ("hand.position -> grain.position").wire ("grain.force -> motor.force").wire ("board.depth -> gain.in");
    s.graph.controls.push_back ({ "grip", "Grip", 0.5, { { "drag.mu", 0.2, 0.6 } }, Json::object() });
    return s.graph;
}

graph::Node nodeOf (const char* name, const char* type, Json params = Json::object(), Json settings = Json::object())
{
    return Sketch::makeNode (name, type, std::move (params), std::move (settings));
}

Wire gained (const char* text, Json gain)
{
    auto w = test::wire (text);
    w.gain = std::move (gain);
    return w;
}

Command wireTo (const char* text) { return AddWire { "", test::wire (text) }; }
Command param (const char* node, const char* key, Json value) { return SetParam { "", node, key, std::move (value) }; }
Command setting (const char* node, const char* key, Json value) { return SetSetting { "", node, key, std::move (value) }; }
Command key (const char* node, const char* k, Json value) { return SetNodeKey { "", node, k, std::move (value) }; }

struct Mistake
{
    const char *what, *id;
    Command edit;
};

/// One row per mistake, as people make them.
std::vector<Mistake> mistakes()
{
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    const auto control = [] (const char* path, Json low, Json high) {
        return Command (AddControl { Control { "feel", "", 0.5, { { path, std::move (low), std::move (high) } }, Json::object() } });
    };
    return {
        { "a type with a typing mistake", "node/unknown_type", AddNode { "", nodeOf ("a", "friction.elastoplastic") } },
        { "a type that does not exist, in a subgraph", "node/unknown_type", AddNode { "grain", nodeOf ("a", "wood") } },
        { "an empty type", "file/bad_value", AddNode { "", nodeOf ("a", "") } },
        { "a subgraph that does not exist", "graph/unknown_subgraph", AddNode { "", nodeOf ("a", "graph:bark") } },
        { "a subgraph in itself", "graph/recursive", AddNode { "grain", nodeOf ("a", "graph:grain") } },
        { "another type that does not exist", "node/unknown_type", key ("board", "type", "deform.plain") },
        { "a name that is taken", "edit/name_taken", AddNode { "", nodeOf ("drag", "signal.gain") } },
        { "a name with a capital", "graph/bad_id", AddNode { "", nodeOf ("Drag", "signal.gain") } },
        { "a name with a space", "graph/bad_id", RenameNode { "", "drag", "my drag" } },
        { "a node that does not exist", "edit/unknown_node", param ("drags", "mu", 0.4) },
        { "a subgraph to edit that does not exist", "edit/unknown_patch", AddNode { "bark", nodeOf ("a", "signal.gain") } },
        { "a parameter with a typing mistake", "param/unknown", param ("drag", "mue", 0.4) },
        { "a parameter that is a setting", "param/unknown", param ("drag", "adhesion_curve", 1) },
        { "a parameter that is an input", "port/wrong_side", param ("drag", "normal_force", 1) },
        { "a parameter of a new node", "param/unknown", AddNode { "", nodeOf ("a", "signal.gain", { { "gian", 2 } }) } },
        { "a wrong unit", "param/unit", param ("board", "stiffness", "2 N") },
        { "a unit that does not exist", "unit/syntax", param ("board", "stiffness", "2 lbs") },
        { "text instead of a number", "unit/syntax", param ("board", "stiffness", "soft") },
        { "a value below the hard range", "param/out_of_range", param ("drag", "mu", -1) },
        { "zero where the model divides by it", "param/out_of_range", param ("drag", "d_max", 0) },
        { "not a number", "edit/bad_value", param ("drag", "mu", nan) },
        { "an infinite number", "edit/bad_value", param ("drag", "mu", inf) },
        { "true instead of a number", "param/value", param ("drag", "mu", true) },
        { "a list instead of a number", "param/value", param ("drag", "mu", Json::array ({ 1, 2 })) },
        { "a number instead of a vector", "param/shape", param ("board", "normal", 1) },
        { "a vector with two components", "param/shape", param ("board", "normal", Json::array ({ 0, 1 })) },
        { "a choice that does not exist", "param/unknown_choice", param ("drag", "adhesion", "stik") },
        { "the number of a choice", "param/unknown_choice", param ("drag", "adhesion", 1) },
        { "a setting that does not exist", "node/unknown_setting", setting ("sum", "input", 3) },
        { "a setting that is a parameter", "node/unknown_setting", setting ("drag", "mu", 0.4) },
        { "a setting out of range", "setting/value", setting ("sum", "inputs", 0) },
        { "a setting of the wrong kind", "setting/value", setting ("board", "law", "steep") },
        { "a wire from a node that does not exist", "edit/unknown_node", wireTo ("hands.position -> drag.position") },
        { "a wire from an output that does not exist", "port/unknown", wireTo ("hand.positions -> grain.position") },
        { "a wire to an input that does not exist", "port/unknown", wireTo ("board.resistance -> drag.force_normal") },
        { "a wire from an input", "port/wrong_side", wireTo ("drag.position -> board.offset") },
        { "a wire of another dimension", "wire/unit", wireTo ("board.depth -> drag.stiffness") },
        { "a vector into a scalar", "wire/width", wireTo ("board.force -> gain.in") },
        { "a scalar into a vector", "wire/width", wireTo ("board.resistance -> motor.force") },
        { "two wires into an input that takes one", "wire/two_into_one", wireTo ("drag.deflection -> drag.position") },
        { "a second position", "wire/two_into_one", wireTo ("hand.position -> board.position") },
        { "a wire onto a choice", "wire/onto_choice", wireTo ("board.resistance -> drag.adhesion") },
        { "adding to an input", "wire/add_to_input", wireTo ("board.resistance -> (+) drag.normal_force") },
        { "an array port without an entry", "wire/which_entry", wireTo ("board.depth -> sum.in") },
        { "an entry that does not exist", "port/bad_index", wireTo ("board.depth -> sum.in[2]") },
        { "a component of a scalar", "port/not_a_vector", wireTo ("board.depth.x -> sum.in[0]") },
        { "a gain with a unit that does not fit", "wire/unit", AddWire { "", gained ("drag.stored_energy -> board.offset", "2 m/N") } },
        { "a wire to itself", "graph/loop", wireTo ("sum.out -> sum.in[0]") },
        { "a loop", "graph/loop", Batch { "a loop", { wireTo ("gain.out -> sum.in[0]"), RemoveWire { "", 0, "board.depth -> gain.in" }, wireTo ("sum.out -> gain.in") } } },
        { "a wire into a subgraph that does not expose the port", "port/unknown", wireTo ("hand.position -> grain.place") },
        { "an instance of a node that has none", "port/not_counted", wireTo ("hand.position -> grain[1].position") },
        { "a wire that does not exist", "edit/unknown_wire", RemoveWire { "", 0, "hand.position -> motor.force" } },
        { "an override of an inner parameter that does not exist", "param/unknown", SetOverride { "", "grain", "wave.amplitud", 1 } },
        { "more inner roles than instances", "node/bad_roles", key ("grain", "roles", Json { { "tip", Json::array ({ "thumb", "index" }) } }) },
        { "a role that is not an id", "graph/bad_id", key ("hand", "role", "Left Hand") },
        { "a device of a role that does not exist", "edit/unknown_device", SetDevice { "thumb", std::nullopt } },
        { "instances of a node", "node/needless_count", key ("drag", "count", 2) },
        { "zero instances", "file/bad_value", key ("grain", "count", 0) },
        { "a rate for a node", "rate/no_subgraph", key ("drag", "every", 2) },
        { "a faster section that returns to the hand", "rate/to_the_hand", key ("grain", "times", 4) },
        { "a control of a parameter that does not exist", "param/unknown", control ("drag.mue", 0, 1) },
        { "a control that leaves the range", "param/out_of_range", control ("drag.d_max", 0, 1) },
        { "a control of an output", "port/wrong_side", control ("drag.force", 0, 1) },
        { "a rate of the graph that is too high", "graph/rate", SetHeader { .rate_hz = 1e7 } },
        { "an exposed port that does not exist", "port/unknown", ChangeExpose { "grain", Expose { { { "position", { "wave", "positions" } } }, {}, {}, Json::object() } } },
        { "a port no longer exposed that is wired", "port/unknown", ChangeExpose { "grain", {} } },
    };
}
}   // namespace

TEST_CASE ("each mistake in an edit is refused with its place and a remedy, and changes nothing", "[edit_check]")
{
    History history (wood());
    const auto before = test::fingerprint (history.graph());
    REQUIRE (errorsOf (history.graph()).empty());
    CHECK (mistakes().size() >= 40);
    for (const auto& mistake : mistakes())
    {
        const auto done = history.perform (mistake.edit);
        INFO (mistake.what << ": " << (done ? "accepted" : describe (done.error())));
        if (! done)
        {
            CHECK (done.error().id == mistake.id);
            CHECK_FALSE (done.error().where.empty());
            CHECK_FALSE (done.error().remedy.empty());
        }
        else
            CHECK_FALSE (done);
        CHECK (test::fingerprint (history.graph()) == before);
        while (history.undo())
        {
        }
    }
}

TEST_CASE ("a graph with a node of an unknown type can be edited, repaired and saved, but not made worse", "[edit_check]")
{
    auto g = wood();
    g.root.nodes.push_back (nodeOf ("mystery", "someone.rough", { { "depth", 2 } }));
    g.root.wires.push_back (test::wire ("mystery.out -> motor.force"));
    g.root.nodes.push_back (nodeOf ("bad", "signal.gain", { { "gain", "loud" } }));
    History history (std::move (g));
    CHECK (history.perform (param ("drag", "mu", 0.3)));
    CHECK (history.perform (param ("mystery", "depth", 3)));
    CHECK (history.perform (wireTo ("hand.position -> mystery.position")));
    CHECK (history.perform (RenameNode { "", "mystery", "puzzle" }));
    CHECK (history.perform (key ("bad", "ui", Json::object())));
    CHECK (history.perform (AddNode { "", nodeOf ("more", "signal.gain") }));
    CHECK_FALSE (history.perform (AddNode { "", nodeOf ("another", "someone.rough") }));
    CHECK_FALSE (history.perform (param ("bad", "gain", "louder")));
    CHECK_FALSE (history.perform (key ("puzzle", "type", "someone.rougher")));
    CHECK_FALSE (history.perform (wireTo ("drag.force -> more.in")));
    CHECK (history.perform (param ("bad", "gain", 2)));
    CHECK_FALSE (history.perform (key ("puzzle", "type", "texture.grating")));   // it has no such param and output
    CHECK (history.perform (RemoveNode { "", "puzzle" }));
    CHECK (errorsOf (history.graph()).empty());
    while (history.undo())
    {
    }
    while (history.redo())
    {
    }
    CHECK (errorsOf (history.graph()).empty());
}

TEST_CASE ("a wire is removed by its text, in every spelling that means the same", "[edit_check]")
{
    const auto removed = [] (const char* text, const std::string& wire) {
        auto g = wood();
        g.root.wires.push_back (test::wire ("gain.out -> [1] -> (+) board.offset"));
        g.root.wires.push_back (test::wire ("board.resistance -> grain/wave.amplitude"));
        g.find ("grain");
        History history (std::move (g));
        const auto before = history.graph().root.wires.size();
        const auto done = history.perform (RemoveWire { "", 0, text });
        INFO (text << (done ? "" : describe (done.error())));
        CHECK (history.graph().root.wires.size() + 1 == before);
        CHECK (std::ranges::none_of (history.graph().root.wires, [&] (const Wire& w) { return toText (w) == wire; }));
        CHECK (history.undo());
        CHECK (history.graph().root.wires.size() == before);
    };
    removed ("hand.position -> drag.position", "hand.position -> drag.position");
    removed ("  hand.position->drag.position ", "hand.position -> drag.position");
    removed ("gain.out->[1]->(+)board.offset", "gain.out -> [1] -> (+) board.offset");
    removed ("gain.out -> [ 01 ] -> (+)  board.offset", "gain.out -> [1] -> (+) board.offset");
    removed ("hand.position -> grain/wave.position", "hand.position -> grain.position");
    removed ("hand.position -> grain[*].position", "hand.position -> grain.position");
    removed ("grain/wave.force -> motor.force", "grain.force -> motor.force");

    History history (wood());
    for (const char* other : { "hand.position -> [1] -> drag.position", "hand.position.x -> drag.position.x", "hand.position -> grain[0].position" })
    {
        const auto done = history.perform (RemoveWire { "", 0, other });
        INFO (other);
        CHECK (! done);
        CHECK ((! done && done.error().id == "edit/unknown_wire"));
    }
}

TEST_CASE ("a batch is one step that is judged by its result, and an edit that fails takes all of it back", "[edit_check]")
{
    History history (wood());
    const auto before = test::fingerprint (history.graph());

    history.begin ("rewire");   // two wires into one input, until the first is removed
    CHECK (history.perform (wireTo ("hand.position -> [1] -> board.position")));
    CHECK_FALSE (history.undo());
    CHECK (history.perform (RemoveWire { "", 0, "hand.position -> board.position" }));
    CHECK (history.finish());
    CHECK_FALSE (history.isInBatch());
    CHECK (history.names() == std::vector<std::string> { "rewire" });
    const auto rewired = test::fingerprint (history.graph());
    CHECK (history.undo());
    CHECK (test::fingerprint (history.graph()) == before);
    CHECK (history.redo());
    CHECK (test::fingerprint (history.graph()) == rewired);
    CHECK (history.undo());

    for (const auto& mistake : mistakes())
    {
        INFO (mistake.what);
        history.begin ("a mistake among others");
        CHECK (history.perform (AddNode { "", nodeOf ("first", "signal.gain") }));
        const auto done = history.perform (mistake.edit);
        const bool goes_on = static_cast<bool> (history.perform (AddNode { "", nodeOf ("last", "signal.gain") }));
        CHECK (goes_on == static_cast<bool> (done));
        const auto finished = history.finish();
        CHECK_FALSE (finished);
        if (finished) break;
        CHECK (finished.error().id == mistake.id);
        CHECK_FALSE (finished.error().where.empty());
        CHECK_FALSE (finished.error().remedy.empty());
        CHECK (test::fingerprint (history.graph()) == before);
    }
    CHECK (history.redo());   // what failed has not dropped the step that was undone
    CHECK (test::fingerprint (history.graph()) == rewired);

    history.begin ("left");
    CHECK (history.perform (AddNode { "", nodeOf ("first", "signal.gain") }));
    history.abandon();
    CHECK (test::fingerprint (history.graph()) == rewired);
    history.begin ("nothing");
    CHECK (history.finish());
    CHECK (history.size() == 1);
}

TEST_CASE ("a batch is checked once, and not at each of its edits", "[edit_check]")
{
    int checked = 0;
    const auto counts = [&] (const std::string&) { return ++checked > 0; };   // asked about each node of an unknown type
    History history (Graph {}, &catalogue(), counts);
    history.begin ("many");
    for (int i = 0; i < 10; ++i)
        CHECK (history.perform (AddNode { "", nodeOf (("a" + std::to_string (i)).c_str(), "someone.else") }));
    CHECK (checked == 0);
    CHECK (history.finish());
    CHECK (checked == 10);
}

TEST_CASE ("a wire between nodes that have no params at all is checked like any other", "[edit_check]")
{
    auto sketch = test::Sketch {}.node ("a", "signal.abs").node ("b", "signal.abs").node ("c", "signal.abs").wire ("a.out -> b.in");
    for (auto& node : sketch.graph.root.nodes)
        node.params = Json {};
    History history (sketch.graph);
    CHECK (history.perform (AddWire { "", *parseWire ("b.out -> c.in") }));
    CHECK_FALSE (history.perform (AddWire { "", *parseWire ("c.out -> a.in") }));   // a loop
}
