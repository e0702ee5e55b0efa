// SPDX-License-Identifier: MIT
#include "edit_rig.hpp"
#include "meddler.hpp"
#include "wild_graph.hpp"

#include <support/property.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/graph/edit.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/history.hpp>
#include <tactus/graph/param_edit.hpp>

#include <catch2/catch.hpp>

#include <limits>

using namespace tactus;
using namespace tactus::graph;
using namespace tactus::test;

TEST_CASE ("removing a node removes everything that refers to it, and undo restores it all")
{
    auto g = woodGraph();
    perform (g, RemoveNode { "", "drag" });
    CHECK (g.root.wires.size() == 2);
    CHECK (g.controls[0].to.size() == 1);

    perform (g, RemoveNode { "grain", "wave" });
    CHECK_FALSE (contains (g, "wave"));
    CHECK (g.find ("grain")->expose.inputs.empty());
    CHECK (g.find ("grain")->wires.empty());
    CHECK (g.root.find ("grain")->overrides.empty());
    CHECK (g.controls[0].to.empty());
    CHECK (g.root.wires.size() == 1);
}

TEST_CASE ("references to a node follow its new name, even through instances of its subgraph")
{
    auto g = woodGraph();
    perform (g, RenameNode { "grain", "wave", "ripple" });
    CHECK_FALSE (contains (g, "wave"));
    CHECK (toText (g.root.wires[1]) == "hand.position -> grain[1]/ripple.position");
    CHECK (g.controls[0].to[0].path == "grain/ripple.amplitude");
    CHECK (g.root.find ("grain")->overrides.contains ("[1]/ripple.angle"));
    CHECK (g.find ("grain")->expose.outputs[0].second.node == "ripple");

    perform (g, RenameNode { "", "grain", "texture" });
    CHECK (toText (g.root.wires[1]) == "hand.position -> texture[1]/ripple.position");
    CHECK (g.controls[0].to[0].path == "texture/ripple.amplitude");
    CHECK (g.root.find ("texture")->type == "graph:grain");
}

TEST_CASE ("a turned parameter is stored under the name that was used to turn it")
{
    auto g = woodGraph();
    g.graphs[0].second.expose.params = { { "angle", { "wave", "angle" } } };
    const auto keep = [&] (const std::string& name, std::optional<Json> value) {
        auto command = paramEdit (g, name, std::move (value));
        if (! command) return command.error().id;
        perform (g, *command);
        return std::string();
    };
    CHECK (keep ("drag.mu", 0.5) == "");
    CHECK (g.root.find ("drag")->params["mu"] == 0.5);
    CHECK (keep ("grain.angle", 0.6) == "");
    CHECK (keep ("grain[*].angle", 0.7) == "");
    CHECK (g.root.find ("grain")->params == Json { { "angle", 0.7 } });
    CHECK (keep ("grain[0].angle", 0.1) == "");
    CHECK (keep ("grain/wave.phase", 0.2) == "");
    CHECK (keep ("grain[1]/wave.angle", 0.3) == "");
    CHECK (keep ("grain[*]/gain.gain", 0.4) == "");
    CHECK (g.root.find ("grain")->overrides == Json { { "wave.phase", 0.2 }, { "[1]/wave.angle", 0.3 }, { "[0]/wave.angle", 0.1 }, { "gain.gain", 0.4 } });
    CHECK (keep ("grain[0]/wave.angle", std::nullopt) == "");
    CHECK_FALSE (g.root.find ("grain")->overrides.contains ("[0]/wave.angle"));
    CHECK (keep ("none.mu", 1) == "edit/unknown_node");
    CHECK (keep ("mu", 1) == "param/name");
    CHECK (keep ("grain[0].mu", 1) == "param/unknown");
    CHECK (keep ("drag.mu.x", 1) == "param/shape");
    CHECK (refusal (g, SetOverride { "", "grain", "no path", 1 }) == "graph/bad_path");
    CHECK (refusal (g, SetOverride { "", "none", "wave.mu", 1 }) == "edit/unknown_node");
}

TEST_CASE ("renaming a subgraph changes the type of its nodes")
{
    auto g = woodGraph();
    perform (g, RenameSubgraph { "grain", "fibre" });
    CHECK (g.root.find ("grain")->type == "graph:fibre");
    CHECK (refusal (g, RenameSubgraph { "fibre", "Fibre" }) == "graph/bad_id");
    CHECK (refusal (g, RenameSubgraph { "grain", "x" }) == "edit/unknown_patch");
    CHECK (refusal (g, RenameSubgraph { "fibre", "fibre" }) == "edit/name_taken");
}

TEST_CASE ("an edit preserves the order of everything else")
{
    auto g = woodGraph();
    perform (g, AddNode { "", node ("fresh"), 1 });
    CHECK (g.root.nodes[1].name == "fresh");
    perform (g, AddWire { "", wire ("fresh.out -> (+) drag.mu"), 0 });
    CHECK (toText (g.root.wires[0]) == "fresh.out -> (+) drag.mu");
    perform (g, ChangeWire { "", g.root.wires[0].id, wire ("fresh.out -> [1] -> drag.mu") });
    perform (g, RemoveWire { "", g.root.wires[0].id });
    perform (g, SetParam { "", "drag", "mu", std::nullopt });
    CHECK_FALSE (g.root.find ("drag")->params.contains ("mu"));
    perform (g, SetParam { "", "drag", "mu", 0.6 });
    perform (g, SetParam { "grain", "wave", "amplitude", "60 mN" });
    perform (g, SetSetting { "", "drag", "adhesion_curve", Json::array() });
    perform (g, SetNodeKey { "", "drag", "bypass", true });
    perform (g, SetNodeKey { "", "hand", "role", "thumb" });
    perform (g, SetNodeKey { "", "grain", "roles", Json { { "tip", "thumb" } } });
    perform (g, SetNodeKey { "", "grain", "count", std::nullopt });
    perform (g, SetNodeKey { "", "grain", "overrides", std::nullopt });
    perform (g, SetNodeKey { "", "grain", "ui", Json { { "at", Json::array ({ 1, 2 }) } } });
    perform (g, ChangeControl { "roughness", Control { "feel", "Feel", 1.0, {}, Json::object() } });
    perform (g, RemoveControl { "feel" });
    perform (g, AddControl { Control { "feel", "Feel", 1.0, {}, Json::object() } });
    perform (g, AddSubgraph { "other", Patch {}, 0 });
    perform (g, RemoveSubgraph { "other" });
    perform (g, ChangeExpose { "grain", {} });
    perform (g, SetDevice { "stylus", Json { { "driver", "sim" } } });
    perform (g, SetDevice { "stylus", std::nullopt });
    perform (g, SetHeader { "", "Wood", "About wood", std::vector<std::string> { "wood" }, 1000.0, Json { { "zoom", 2 } } });
    perform (g, SetHeader { .patch = "grain", .ui = Json { { "zoom", 2 } } });
}

TEST_CASE ("an invalid edit is refused with a reason and changes nothing")
{
    auto g = woodGraph();
    const auto first = g.root.wires[0].id;
    CHECK (refusal (g, AddNode { "none", node ("a") }) == "edit/unknown_patch");
    CHECK (refusal (g, AddNode { "", node ("drag") }) == "edit/name_taken");
    CHECK (refusal (g, AddNode { "", node ("Drag") }) == "graph/bad_id");
    CHECK (refusal (g, AddNode { "", graph::Node {} }) == "graph/bad_id");
    auto copy = g.root.nodes[0];
    copy.name = "copy";
    CHECK (refusal (g, AddNode { "grain", copy }) == "edit/id_taken");
    CHECK (refusal (g, RemoveNode { "", "wave" }) == "edit/unknown_node");
    CHECK (refusal (g, RenameNode { "", "drag", "hand" }) == "edit/name_taken");
    CHECK (refusal (g, RenameNode { "", "drag", "2d" }) == "graph/bad_id");
    CHECK (refusal (g, SetParam { "", "drag", "d max", 1 }) == "graph/bad_id");
    CHECK (refusal (g, SetParam { "", "drag", "mu", std::numeric_limits<double>::quiet_NaN() }) == "edit/bad_value");
    CHECK (refusal (g, SetNodeKey { "", "drag", "role", "Left Hand" }) == "graph/bad_id");
    CHECK (refusal (g, SetNodeKey { "", "drag", "bypass", 1 }) == "file/wrong_kind");
    CHECK (refusal (g, SetNodeKey { "", "drag", "count", 0 }) == "file/bad_value");
    CHECK (refusal (g, SetNodeKey { "", "drag", "params", Json::object() }) == "edit/bad_value");
    CHECK (refusal (g, SetNodeKey { "", "drag", "type", std::nullopt }) == "edit/bad_value");
    CHECK (refusal (g, AddWire { "", wire ("none.out -> drag.mu") }) == "edit/unknown_node");
    CHECK (refusal (g, AddWire { "", g.root.wires[0] }) == "edit/id_taken");
    CHECK (refusal (g, RemoveWire { "grain", first }) == "edit/unknown_wire");
    auto bad = wire ("hand.position -> drag.position");
    bad.gain = "much";
    CHECK (refusal (g, ChangeWire { "", first, bad }) == "unit/syntax");
    bad.gain = nullptr;
    bad.to.port = "a.b";
    CHECK (refusal (g, ChangeWire { "", first, bad }) == "wire/syntax");
    CHECK (refusal (g, RemoveControl { "none" }) == "edit/unknown_control");
    CHECK (refusal (g, AddControl { g.controls[0] }) == "edit/name_taken");
    CHECK (refusal (g, ChangeControl { "roughness", Control { "roughness", "", 2.0, {}, Json::object() } }) == "file/bad_value");
    CHECK (refusal (g, ChangeControl { "roughness", Control { "roughness", "", 0.5, { { "none.mu", 0, 1 } }, Json::object() } }) == "edit/unknown_node");
    CHECK (refusal (g, RemoveSubgraph { "grain" }) == "edit/in_use");
    CHECK (refusal (g, RemoveSubgraph { "none" }) == "edit/unknown_patch");
    CHECK (refusal (g, SetDevice { "none", std::nullopt }) == "edit/unknown_device");
    CHECK (refusal (g, SetHeader { .rate_hz = 0.0 }) == "file/bad_value");
    CHECK (refusal (g, SetHeader { .patch = "grain", .name = "x" }) == "edit/bad_value");
    CHECK (refusal (g, Batch { "two", { RemoveNode { "", "drag" }, RemoveNode { "", "drag" } } }) == "edit/unknown_node");
}

TEST_CASE ("a node can get a name that dangling wires refer to, and undo makes them dangle again")
{
    auto g = woodGraph();
    (void)apply (g, AddWire { "", wire ("ghost.out -> motor.force") }, Checks::none);
    perform (g, RenameNode { "", "drag", "ghost" });
    auto other = woodGraph();
    (void)apply (other, AddWire { "", wire ("ghost.out -> motor.force") }, Checks::none);
    perform (other, AddNode { "", node ("ghost") });

    g = woodGraph();
    g.controls[0].to.push_back ({ "ghost.mu", 0, 1 });
    CHECK (refusal (g, RenameNode { "", "drag", "ghost" }) == "edit/name_taken");
}

TEST_CASE ("history names its steps, and turning a knob is one step")
{
    History history (woodGraph());
    const auto before = fingerprint (history.graph());
    REQUIRE (history.perform (RenameNode { "", "drag", "stick" }));
    REQUIRE (history.perform (SetParam { "", "stick", "mu", 0.1 }));
    for (int i = 2; i < 1000; ++i)
        REQUIRE (history.perform (SetParam { "", "stick", "mu", 0.001 * i }, Step::joined));
    REQUIRE (history.perform (Batch { "tidy up", { RemoveNode { "", "stick" } } }));
    CHECK_FALSE (history.perform (RemoveNode { "", "stick" }));
    CHECK (history.names() == std::vector<std::string> { "rename 'drag' to 'stick'", "set 'stick.mu'", "tidy up" });
    CHECK (history.undo());
    CHECK (history.undo());
    CHECK (history.graph().root.find ("stick")->params["mu"] == 0.4);
    CHECK (history.position() == 1);
    CHECK (history.redo());
    CHECK (history.graph().root.find ("stick")->params["mu"] == 0.999);
    CHECK (history.undo());
    CHECK (history.undo());
    CHECK_FALSE (history.undo());
    CHECK (fingerprint (history.graph()) == before);

    REQUIRE (history.perform (RemoveNode { "", "drag" }));
    CHECK_FALSE (history.redo());
    CHECK (history.names().size() == 1);
}

TEST_CASE ("every edit can be undone and redone, with the same bytes and ids")
{
    property ("random edits of random graphs", [] {
        const auto seed = *rc::gen::arbitrary<std::uint64_t>();
        auto start = wildGraph (seed);
        if (! start.root.nodes.empty() && seed % 3 == 0) start.root.nodes[0].name = "ghost";   // its wires now refer to a node that does not exist

        History history (std::move (start));
        Meddler meddler (seed);
        std::vector<std::string> states { fingerprint (history.graph()) };
        for (int i = 0; i < 30; ++i)
        {
            const auto before = fingerprint (history.graph());
            if (history.perform (meddler.any (history.graph())))
                states.push_back (fingerprint (history.graph()));
            else
                RC_ASSERT (fingerprint (history.graph()) == before);
        }
        RC_ASSERT (! hasErrors (readGraph (writeGraph (history.graph())).messages));

        RC_ASSERT (history.position() + 1 == states.size());
        for (auto i = states.size() - 1; i > 0; --i)
        {
            RC_ASSERT (history.undo());
            RC_ASSERT (fingerprint (history.graph()) == states[i - 1]);
        }
        for (std::size_t i = 1; i < states.size(); ++i)
        {
            RC_ASSERT (history.redo());
            RC_ASSERT (fingerprint (history.graph()) == states[i]);
        }
    });
}
