// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/model/obvious_wires.hpp>
#include <host/app/problems/fixes.hpp>
#include <host/app/problems/unfelt.hpp>
#include <host/base/assets/file_assets.hpp>

#include <tactus/file/graph_file.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/plan/rules/unheard.hpp>

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

Messages unfeltIn (const graph::Graph& g) { return unfelt (g, catalogue()); }

bool hasWire (const graph::Graph& g, const std::string& text)
{
    return std::ranges::any_of (g.root.wires, [&] (const graph::Wire& w) { return graph::toText (w.from) + " -> " + graph::toText (w.to) == text; });
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

TEST_CASE ("a hand, a motor or a role that a button adds has the guard of the templates", "[app][problems]")
{
    const auto guard = loadGraph (TACTUS_SOURCE_DIR "/graphs/templates/press.json").graph.device ("stylus")->at ("guard");
    auto g = graphOf (R"("nodes":{"wall":{"type":"deform.plane"}})");
    const auto missing = unfeltIn (g);
    REQUIRE (missing.size() >= 2);
    for (const auto& m : { missing[0], missing[1] })
        REQUIRE (graph::apply (g, fixOf (g, m)->command).has_value());
    REQUIRE (g.devices.size() == 1);
    CHECK (g.devices[0].second.at ("guard") == guard);

    auto lacking = graphOf (R"("nodes":{"hand":{"type":"device.position"}})");
    fixAll (lacking);
    REQUIRE (lacking.devices.size() == 1);
    CHECK (lacking.devices[0].second.at ("guard") == guard);
}

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

TEST_CASE ("a graph without a hand or a motor says so, and a click adds them with a device, the names of the presets and their wires", "[app][problems]")
{
    CHECK (unfeltIn (graphOf (R"("nodes":{},"wires":[])")).empty());
    auto g = graphOf (R"("nodes":{"wall":{"type":"deform.plane","ui":{"at":[100,40]}},"rub":{"type":"friction.elasto_plastic","ui":{"at":[100,240]}},
        "ridges":{"type":"texture.grating","ui":{"at":[100,440]}},"waves":{"type":"texture.grating","ui":{"at":[100,640]}}},
        "wires":["wall.resistance -> rub.normal_force"])");
    auto missing = unfeltIn (g);
    REQUIRE (missing.size() >= 2);
    CHECK (missing[0].id == "graph/no_hand");
    CHECK (missing[1].id == "graph/no_motor");
    for (const auto& m : { missing[0], missing[1] })
        REQUIRE (graph::apply (g, fixOf (g, m)->command).has_value());
    CHECK (unfeltIn (g).empty());
    CHECK (errorsOf (g).empty());
    REQUIRE (g.devices.size() == 1);
    for (const auto* node : { "wall", "rub", "ridges", "waves" })
        CHECK (hasWire (g, std::string ("hand.position -> ") + node + ".position"));
    CHECK (hasWire (g, "wall.force -> motor.force"));
    CHECK (hasWire (g, "rub.force -> motor.force"));
    CHECK (hasWire (g, "ridges_felt.out -> motor.force"));   // not in the air
    CHECK (hasWire (g, "waves_felt.out -> motor.force"));
    CHECK (std::ranges::count (g.root.nodes, "contact.window", &graph::Node::type) == 1);
    CHECK (unfeltIn (graphOf (R"("nodes":{"pad":{"type":"graph:pad"}},"wires":[],"graphs":{"pad":{"nodes":{
        "hand":{"type":"device.position"},"wall":{"type":"deform.plane"},"motor":{"type":"device.force"}},
        "wires":["hand.position -> wall.position","wall.force -> motor.force"]}})"))
               .empty());
}

TEST_CASE ("what is there but cannot be felt is a problem, and a click wires it", "[app][problems]")
{
    const auto idsOf = [] (const graph::Graph& g) {
        std::vector<std::string> ids;
        for (const auto& m : unfeltIn (g))
            ids.push_back (m.id);
        return ids;
    };
    const std::string ends = R"("hand":{"type":"device.position"},"motor":{"type":"device.force"},"wall":{"type":"deform.plane"})";
    SECTION ("a hand and a motor without wires")
    {
        auto g = graphOf (R"("nodes":{)" + ends + R"(},"wires":[])");
        CHECK (idsOf (g) == std::vector<std::string> { "graph/hand_unwired", "graph/motor_unwired" });
        CHECK (locationOf (g, unfeltIn (g)[1]).node == "motor");
        CHECK (fixOf (g, unfeltIn (g)[0])->label == "Wire hand");
        while (! unfeltIn (g).empty())
            REQUIRE (graph::apply (g, fixOf (g, unfeltIn (g)[0])->command).has_value());
        CHECK (hasWire (g, "hand.position -> wall.position"));
        CHECK (hasWire (g, "wall.force -> motor.force"));
    }
    SECTION ("friction gets the load of the surface with its position, or else with its way to the motor")
    {
        const auto motor_first = GENERATE (false, true);
        auto g = graphOf (R"("nodes":{)" + ends + R"(,"rub":{"type":"friction.elasto_plastic"}},"wires":[])");
        for (const auto* id : { motor_first ? "graph/motor_unwired" : "graph/hand_unwired", motor_first ? "graph/hand_unwired" : "graph/motor_unwired" })
        {
            const auto missing = unfeltIn (g);
            const auto m = std::ranges::find (missing, id, &Message::id);
            REQUIRE (m != missing.end());
            REQUIRE (graph::apply (g, fixOf (g, *m)->command).has_value());
        }
        CHECK (hasWire (g, "wall.resistance -> rub.normal_force"));   // not felt in the air
        CHECK (g.root.wires.size() == 5);
    }
    SECTION ("the surface that gives the load is felt, too, also if only its position was wired by hand")
    {
        auto g = graphOf (R"("nodes":{)" + ends + R"(,"rub":{"type":"friction.elasto_plastic"}},"wires":["hand.position -> wall.position"])");
        REQUIRE (graph::apply (g, wiring::obviousWires (g, "", "rub", catalogue())).has_value());
        CHECK (hasWire (g, "wall.resistance -> rub.normal_force"));
        CHECK (hasWire (g, "wall.force -> motor.force"));
        CHECK (unfeltIn (g).empty());
    }
    SECTION ("a load that is wired, or that no surface gives, stays as it is")
    {
        auto g = graphOf (R"("nodes":{"hand":{"type":"device.position"},"motor":{"type":"device.force"},"rub":{"type":"friction.elasto_plastic"}},"wires":[])");
        while (! unfeltIn (g).empty())
            REQUIRE (graph::apply (g, fixOf (g, unfeltIn (g)[0])->command).has_value());
        CHECK (g.root.wires.size() == 2);
    }
    SECTION ("a node without effect")
    {
        auto g = graphOf (R"("nodes":{)" + ends + R"(,"ridges":{"type":"texture.grating"},
            "rub":{"type":"friction.elasto_plastic"},"sway":{"type":"signal.lfo"}},
            "wires":["hand.position -> wall.position","wall.force -> motor.force"])");
        for (const auto& m : plan::unheardNodes (g, catalogue()))
        {
            INFO (m.where);
            REQUIRE (m.id == "node/no_effect");
            const auto fix = fixOf (g, m);
            REQUIRE (fix.has_value() == ! m.where.ends_with ("sway"));   // only the user knows what it is for
            if (! fix) continue;
            CHECK (fix->label == "Wire " + locationOf (g, m).node);
            REQUIRE (graph::apply (g, fix->command).has_value());
        }
        for (const auto* w : { "hand.position -> ridges.position", "ridges_felt.out -> motor.force", "hand.position -> rub.position",
                               "wall.resistance -> rub.normal_force", "rub.force -> motor.force" })
            CHECK (hasWire (g, w));
        CHECK (plan::unheardNodes (g, catalogue()).size() == 1);
    }
    SECTION ("an effect that does not know where the tool is")
    {
        auto g = graphOf (R"("nodes":{)" + ends + R"(,"ridges":{"type":"texture.grating"}},
            "wires":["hand.position -> wall.position","wall.force -> motor.force","ridges.force -> motor.force"])");
        CHECK (idsOf (g) == std::vector<std::string> { "node/no_input", "mixer/none" });
        REQUIRE (graph::apply (g, fixOf (g, unfeltIn (g)[0])->command).has_value());
        CHECK (hasWire (g, "hand.position -> ridges.position"));
        REQUIRE (idsOf (g) == std::vector<std::string> { "mixer/none" });
        REQUIRE (graph::apply (g, fixOf (g, unfeltIn (g)[0])->command).has_value());
        CHECK (unfeltIn (g).empty());
    }
    SECTION ("an envelope that nothing opens")
    {
        auto g = graphOf (R"("nodes":{)" + ends + R"(,"swell":{"type":"signal.envelope"},"rub":{"type":"friction.elasto_plastic"}},
            "wires":["hand.position -> wall.position","wall.force -> motor.force","hand.position -> rub.position",
                "wall.resistance -> rub.normal_force","rub.force -> motor.force","swell.out -> (+) rub.mu"])");
        const auto isIt = [] (const Message& m) { return m.id == "envelope/no_gate"; };
        const auto all = unfeltIn (g);
        const auto m = std::ranges::find_if (all, isIt);
        REQUIRE (m != all.end());
        REQUIRE (graph::apply (g, fixOf (g, *m)->command).has_value());
        CHECK (hasWire (g, "wall.depth -> touch.depth"));
        CHECK (hasWire (g, "touch.gain -> swell.gate"));
        CHECK (std::ranges::none_of (unfeltIn (g), isIt));
    }
    SECTION ("an empty layer and a clip without a file")
    {
        auto g = graphOf (R"("nodes":{)" + ends + R"(,"buzz":{"type":"signal.clip"},"desk":{"type":"layer.mix_vectors","settings":{"inputs":3}}},
            "wires":["hand.position -> wall.position","wall.force -> desk.in[0]","buzz.value -> desk.in[2].z","desk.out -> motor.force"])");
        CHECK (idsOf (g) == std::vector<std::string> { "clip/no_file", "layer/empty" });
        CHECK (unfeltIn (g)[1].text == "nothing is wired into layer 2 of 'desk'");
        CHECK (locationOf (g, unfeltIn (g)[0]).node == "buzz");
    }
    SECTION ("inside a subgraph, ports that are exposed or named from outside are wired")
    {
        const auto g = graphOf (R"("nodes":{"hand":{"type":"device.position"},"pad":{"type":"graph:pad"},"motor":{"type":"device.force"}},
            "wires":["hand.position -> pad.position","pad.force -> motor.force"],
            "graphs":{"pad":{"nodes":{"wall":{"type":"deform.plane"}},"wires":[],
                "expose":{"inputs":{"position":"wall.position"},"outputs":{"force":"wall.force"}}}})");
        CHECK (unfeltIn (g).empty());
    }
}

TEST_CASE ("a file that is missing is found in every kind of setting, and a chosen one takes its place", "[app][problems]")
{
    struct Case
    {
        const char *node, *within;
        SettingSheet::Kind kind;
    };
    const auto c = GENERATE (Case { R"("signal.clip","settings":{"clip":"gone/x.haptic"})", "", SettingSheet::Kind::table },
                             Case { R"("vibration.wavetable","settings":{"table":{"wav":"gone/x.wav"}})", "/wav", SettingSheet::Kind::signal },
                             Case { R"("deform.surface","settings":{"surface":{"mesh":"gone/x.obj"}})", "/mesh", SettingSheet::Kind::surface });
    auto g = graphOf (R"("nodes":{"a":{"type":)" + std::string (c.node) + R"(}},"wires":[])");
    g.folder = TACTUS_SOURCE_DIR "/graphs";
    FileAssets assets;
    const auto messages = compile (g, catalogue(), { .assets = &assets }).messages;
    const auto lost = std::ranges::find (messages, std::string ("setting/value"), &Message::id);
    REQUIRE (lost != messages.end());
    INFO (lost->where << ": " << lost->text);
    const auto missing = missingFileOf (g, *lost);
    REQUIRE (missing.has_value());
    CHECK (missing->kind == c.kind);
    CHECK (missing->at.within == c.within);
    CHECK (missing->expected.parent_path() == TACTUS_SOURCE_DIR "/graphs/gone");
    REQUIRE (graph::apply (g, useFile (g, *missing, TACTUS_SOURCE_DIR "/graphs/assets/liver.obj")).has_value());
    CHECK (g.root.find ("a")->settings.flatten().items().front().second == "assets/liver.obj");
    CHECK_FALSE (missingFileOf (g, *lost).has_value());   // it exists

    auto silent = graphOf (R"("nodes":{"buzz":{"type":"signal.clip"}},"wires":[])");
    const auto unset = unfeltIn (silent);
    const auto no_file = std::ranges::find (unset, std::string ("clip/no_file"), &Message::id);
    REQUIRE (no_file != unset.end());
    CHECK (missingFileOf (silent, *no_file).has_value());
    for (const auto& m : errorsOf (graphOf (R"("nodes":{"a":{"type":"signal.clip","settings":{"lowest":"gone"}}},"wires":[])")))
        CHECK_FALSE (missingFileOf (silent, m).has_value());   // no file at all
}

TEST_CASE ("every preset can be felt as a whole", "[app][problems]")
{
    for (const auto& entry : std::filesystem::directory_iterator (TACTUS_SOURCE_DIR "/graphs"))
        if (entry.path().extension() == ".json")
        {
            CAPTURE (entry.path().string());
            CHECK (unfeltIn (loadGraph (entry.path()).graph).empty());
        }
}
