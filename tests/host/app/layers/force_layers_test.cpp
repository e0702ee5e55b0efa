// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/layers/mixer.hpp>
#include <host/app/layers/sends.hpp>

#include <tactus/file/graph_file.hpp>
#include <tactus/graph/history.hpp>
#include <tactus/plan/compile.hpp>

#include "support/sketch.hpp"

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;

namespace
{
/// A graph with a mixer of its forces.
struct MixedForces
{
    graph::History history;
    MixerPlace mixer;

    explicit MixedForces (const graph::Graph& g) : history (g)
    {
        auto added = addMixer (history.graph(), catalogue());
        REQUIRE (added);
        REQUIRE (history.perform (added->command));
        mixer = added->place;
    }

    explicit MixedForces (const std::string& preset) : MixedForces (loadGraph (TACTUS_SOURCE_DIR "/graphs/" + preset).graph) {}

    std::string add (const std::string& type)
    {
        auto added = addLayer (history.graph(), mixer, catalogue(), type);
        REQUIRE (added);
        REQUIRE (history.perform (added->command));
        return added->missing;
    }

    void perform (const Result<graph::Command>& c)
    {
        if (! c) UNSCOPED_INFO (c.error().text);
        REQUIRE (c);
        const auto done = history.perform (*c);
        if (! done) UNSCOPED_INFO (done.error().text);
        REQUIRE (done);
    }

    bool hasWire (const std::string& text) const
    {
        const auto& wires = history.graph().root.wires;
        return std::ranges::any_of (wires, [&] (const graph::Wire& w) { return graph::toText (w) == text; });
    }

    int layers() const { return layersOf (*findMixer (history.graph(), mixer), catalogue()); }

    bool compiles() const
    {
        const auto compiled = compile (history.graph(), catalogue());
        for (const auto& m : compiled.messages)
            if (m.severity == Message::Severity::error) UNSCOPED_INFO (m.where << ": " << m.text);
        return compiled.plan != nullptr;
    }
};
}   // namespace

TEST_CASE ("forces in three axes become the layers of a mixer of vectors", "[layers]")
{
    MixedForces cloth ("layered_cloth.json");
    CHECK (cloth.mixer.vectors);
    CHECK (cloth.layers() == 3);
    CHECK (cloth.hasWire ("table.force -> desk.in[0]"));
    CHECK (cloth.hasWire ("drag.force -> desk.in[1]"));
    CHECK (cloth.hasWire ("felt.out -> desk.in[2]"));
    CHECK (cloth.hasWire ("desk.out -> motor.force"));
    CHECK (cloth.compiles());
    CHECK (mixersOf (cloth.history.graph()) == std::vector { cloth.mixer });

    MixedForces key ("tactile_key.json");   // a vector, and scalars along one axis
    CHECK (key.mixer.vectors);
    CHECK (key.hasWire ("bump_felt.out -> desk.in[1].z"));
    CHECK (key.compiles());
}

TEST_CASE ("a texture keeps its direction as a layer of vectors, and is felt only in contact", "[layers]")
{
    MixedForces wood ("dry_wood.json");
    wood.add ("texture.grating");
    CHECK (wood.hasWire ("grating.force -> grating_felt.in"));
    CHECK (wood.hasWire ("grating_felt.out -> desk.in[3]"));
    CHECK (isGated (wood.history.graph(), wood.mixer, 3));
    CHECK (wood.compiles());

    wood.add ("vibration.modal");   // numbers push along z
    CHECK (wood.hasWire ("modal.value -> desk.in[4].z"));
    CHECK_FALSE (isGated (wood.history.graph(), wood.mixer, 4));
    wood.add ("friction.elasto_plastic");   // pressed by the surface, so it needs no gate
    CHECK (wood.hasWire ("elasto_plastic.force -> desk.in[5]"));
    CHECK_FALSE (isGated (wood.history.graph(), wood.mixer, 5));
    CHECK (wood.compiles());
}

TEST_CASE ("every type that can be a layer of vectors can be added to every preset whose forces are vectors", "[layers]")
{
    const auto types = layerTypes (catalogue(), true);
    CHECK (types.size() > layerTypes (catalogue()).size());
    for (const char* preset : { "dry_wood.json", "soft_pad.json", "machined_steel.json" })
        for (const auto* type : types)
        {
            INFO (preset << ' ' << type->info.id);
            MixedForces all (preset);
            const int before = all.layers();
            all.add (std::string (type->info.id));
            CHECK (all.layers() == before + 1);
            CHECK (wireInto (all.history.graph(), all.mixer, before) != nullptr);
            CHECK (all.compiles());
        }
}

TEST_CASE ("a recorded texture gets the speed of the tool, even if the graph did not measure it before", "[layers]")
{
    MixedForces wood ("dry_wood.json");
    CHECK (wood.add ("texture.noise").empty());
    CHECK (wood.hasWire ("hand.position -> velocity.position"));
    CHECK (wood.hasWire ("velocity.speed -> noise.speed"));
    CHECK (wood.compiles());
    CHECK (wood.add ("texture.noise").empty());   // the second one uses the same node
    CHECK (wood.hasWire ("velocity.speed -> noise_2.speed"));
}

TEST_CASE ("a clip becomes a layer that each tap plays, and asks for its file", "[layers]")
{
    for (const char* preset : { "dry_wood.json", "scissors_cloth.json" })
    {
        MixedForces all (preset);
        CHECK (all.add ("signal.clip").find ("Choose a clip") == 0);
        CHECK (all.history.graph().root.find ("clip")->params["gain"] == "0.2 N");
        CHECK (all.compiles());
    }
}

TEST_CASE ("the contact gate of a layer can be added and removed, and leaves nothing behind", "[layers]")
{
    for (const bool vectors : { true, false })
    {
        auto graph = loadGraph (TACTUS_SOURCE_DIR "/graphs/dry_wood.json").graph;
        MixedForces mixed (vectors ? graph : loadGraph (TACTUS_SOURCE_DIR "/graphs/bronze_bell.json").graph);
        if (! vectors) mixed.mixer = mixersOf (mixed.history.graph())[0].vectors ? mixersOf (mixed.history.graph())[1] : mixersOf (mixed.history.graph())[0];
        REQUIRE (mixed.mixer.vectors == vectors);
        REQUIRE_FALSE (isGated (mixed.history.graph(), mixed.mixer, 0));
        const auto before = writeGraph (mixed.history.graph());
        mixed.perform (setGate (mixed.history.graph(), mixed.mixer, catalogue(), 0, true));
        CHECK (isGated (mixed.history.graph(), mixed.mixer, 0));
        CHECK (mixed.compiles());
        mixed.perform (setGate (mixed.history.graph(), mixed.mixer, catalogue(), 0, false));
        CHECK (writeGraph (mixed.history.graph()) == before);
    }
}

TEST_CASE ("a layer is gated by contact wherever the gate and the contact window are", "[layers]")
{
    const std::vector<std::vector<std::string>> groups {
        { "grating", "grating_felt" }, { "grating", "grating_felt", "touch" }, { "touch" }, { "desk", "grating_felt" }
    };
    for (const auto& members : groups)
    {
        INFO (members.front() << ", " << members.size());
        MixedForces wood ("dry_wood.json");
        wood.add ("texture.grating");
        REQUIRE (isGated (wood.history.graph(), wood.mixer, 3));
        REQUIRE (wood.history.perform (graph::CollapseNodes { {}, members, "box", "box" }));
        REQUIRE (wood.history.perform (graph::CollapseNodes { {}, { "box" }, "outer", "outer" }));
        wood.mixer = mixersOf (wood.history.graph()).front();
        CHECK (isGated (wood.history.graph(), wood.mixer, 3));
        CHECK_FALSE (isGated (wood.history.graph(), wood.mixer, 1));   // friction
        CHECK (wood.compiles());
        const auto before = writeGraph (wood.history.graph());
        auto off = setGate (wood.history.graph(), wood.mixer, catalogue(), 3, false);
        if (members.front() == "desk")   // what the gate multiplies comes from outside of the group
        {
            REQUIRE_FALSE (off);
            CHECK (off.error().id == "mixer/gate_elsewhere");
            continue;
        }
        wood.perform (std::move (off));
        CHECK_FALSE (isGated (wood.history.graph(), wood.mixer, 3));
        CHECK (wireInto (wood.history.graph(), wood.mixer, 3) != nullptr);
        const bool is_window_outside = members.size() == 2;   // then a wire from outside still leads to the product
        CHECK ((writeGraph (wood.history.graph()).find ("grating_felt") != std::string::npos) == is_window_outside);
        CHECK (wood.compiles());
        REQUIRE (wood.history.undo());
        CHECK (writeGraph (wood.history.graph()) == before);
    }
}

TEST_CASE ("the gate in a group that plays twice stays", "[layers]")
{
    MixedForces wood ("dry_wood.json");
    wood.add ("texture.grating");
    REQUIRE (wood.history.perform (graph::CollapseNodes { {}, { "grating", "grating_felt" }, "box", "box" }));
    graph::Node twin;
    twin.name = "twin";
    twin.type = "graph:box";
    REQUIRE (wood.history.perform (graph::AddNode { {}, twin }));
    const auto off = setGate (wood.history.graph(), wood.mixer, catalogue(), 3, false);
    REQUIRE_FALSE (off);
    CHECK (off.error().id == "mixer/gate_elsewhere");
}

TEST_CASE ("an open gate leaves the gain of a wire into it, and what else gets the signal", "[layers]")
{
    MixedForces wood ("dry_wood.json");
    wood.add ("texture.grating");
    SECTION ("a wire that turns the force around")
    {
        const auto& wires = wood.history.graph().root.wires;
        const auto at = std::ranges::find_if (wires, [] (const graph::Wire& w) { return w.from.node == "grating" && w.to.node == "grating_felt"; });
        REQUIRE (at != wires.end());
        auto turned = *at;
        turned.gain = -1.0;
        REQUIRE (wood.history.perform (graph::ChangeWire { {}, at->id, turned }));
        wood.perform (setGate (wood.history.graph(), wood.mixer, catalogue(), 3, false));
        CHECK_FALSE (isGated (wood.history.graph(), wood.mixer, 3));
        CHECK (wireInto (wood.history.graph(), wood.mixer, 3)->from.node == "grating_felt");
        const auto& left = wood.history.graph().root.wires;
        CHECK (std::ranges::any_of (left, [] (const graph::Wire& w) { return w.to.node == "grating_felt" && w.gain == Json (-1.0); }));
        CHECK (wood.compiles());
    }
    SECTION ("another node that gets the output of the product")
    {
        graph::Node other;
        other.name = "other";
        other.type = "vector.scale";
        REQUIRE (wood.history.perform (graph::AddNode { {}, other }));
        graph::Wire tap;
        tap.from = { "grating_felt", "out" };
        tap.to = { "other", "in" };
        wood.perform (graph::Command (graph::AddWire { {}, tap }));
        const auto& wires = wood.history.graph().root.wires;
        auto turned = *std::ranges::find_if (wires, [] (const graph::Wire& w) { return w.from.node == "grating" && w.to.node == "grating_felt"; });
        turned.gain = -1.0;
        REQUIRE (wood.history.perform (graph::ChangeWire { {}, turned.id, turned }));
        const auto off = setGate (wood.history.graph(), wood.mixer, catalogue(), 3, false);
        REQUIRE_FALSE (off);
        CHECK (off.error().id == "mixer/gate_shared");
    }
    SECTION ("another node that gets the output of the group")
    {
        REQUIRE (wood.history.perform (graph::CollapseNodes { {}, { "grating", "grating_felt" }, "box", "box" }));
        wood.mixer = mixersOf (wood.history.graph()).front();
        graph::Node other;
        other.name = "other";
        other.type = "vector.scale";
        REQUIRE (wood.history.perform (graph::AddNode { {}, other }));
        graph::Wire tap;
        tap.from = wireInto (wood.history.graph(), wood.mixer, 3)->from;
        tap.to = { "other", "in" };
        wood.perform (graph::Command (graph::AddWire { {}, tap }));
        const auto off = setGate (wood.history.graph(), wood.mixer, catalogue(), 3, false);
        REQUIRE_FALSE (off);
        CHECK (off.error().id == "mixer/gate_elsewhere");
    }
}

TEST_CASE ("without a surface, a layer cannot have a contact gate", "[layers]")
{
    tactus::test::Sketch sketch;
    sketch.node ("tone", "signal.lfo").node ("desk", "layer.mix").wire ("tone.out -> desk.in[0]");
    const auto mixer = mixersOf (sketch.graph).front();
    CHECK (setGate (sketch.graph, mixer, catalogue(), 0, true).error().id == "mixer/no_contact");
    CHECK (setGate (sketch.graph, mixer, catalogue(), 1, true).error().id == "mixer/empty");
}

TEST_CASE ("a layer is sent to another device through a bus with a gain for each send", "[layers]")
{
    MixedForces wood ("dry_wood.json");
    const auto graph = [&]() -> const graph::Graph& { return wood.history.graph(); };
    CHECK (sendTargets (graph(), wood.mixer).empty());   // its only device is the one that the mixer drives
    const auto before = writeGraph (graph());
    wood.add ("vibration.modal");
    wood.perform (addSendToNewMotor (graph(), wood.mixer, catalogue(), 3));
    CHECK (wood.hasWire ("modal.value -> to_shaker.in[0]"));
    CHECK (wood.hasWire ("to_shaker.out -> shaker.in"));
    CHECK (wood.compiles());

    REQUIRE (sendTargets (graph(), wood.mixer).size() == 1);
    wood.perform (addSend (graph(), wood.mixer, catalogue(), 1, "shaker"));   // of a vector, the sum of its components
    for (const char* component : { "x", "y", "z" })
        CHECK (wood.hasWire ("drag.force." + std::string (component) + " -> to_shaker.in[1]"));
    CHECK (wood.compiles());

    wood.perform (addSend (graph(), wood.mixer, catalogue(), 2, "shaker"));   // behind a product
    CHECK (wood.hasWire ("grain_felt.out.x -> to_shaker.in[2]"));
    CHECK (wood.compiles());
    wood.perform (removeSend (graph(), sendsOf (graph(), wood.mixer, catalogue(), 2)[0], catalogue()));

    const auto sends = sendsOf (graph(), wood.mixer, catalogue(), 1);
    REQUIRE (sends.size() == 1);
    CHECK (sends[0].to.name == "shaker");
    CHECK (sends[0].layer == 1);
    CHECK (sendsOf (graph(), wood.mixer, catalogue(), 0).empty());
    const auto& bus = *findMixer (graph(), sends[0].bus);
    CHECK (layerNames (bus, 2) == std::vector<std::string> { "modal", "drag" });
    wood.perform (setLayerValue (bus, sends[0].bus, catalogue(), "gain", 1, Json (0.5)));
    CHECK (graph().root.find ("to_shaker")->params["gain"].dump() == "[1.0,0.5]");

    wood.perform (removeSend (graph(), sendsOf (graph(), wood.mixer, catalogue(), 3)[0], catalogue()));
    CHECK (sendsOf (graph(), wood.mixer, catalogue(), 1)[0].layer == 0);
    wood.perform (removeSend (graph(), sendsOf (graph(), wood.mixer, catalogue(), 1)[0], catalogue()));
    CHECK (graph().root.find ("to_shaker") == nullptr);
    while (writeGraph (graph()) != before)
        REQUIRE (wood.history.undo());
}

TEST_CASE ("a number that is sent to a device with a tool pushes it along z", "[layers]")
{
    auto graph = loadGraph (TACTUS_SOURCE_DIR "/graphs/bronze_bell.json").graph;
    tactus::test::Sketch second;
    second.graph = std::move (graph);
    second.node ("other", "device.force");
    second.graph.root.nodes.back().role = "left";
    graph::History history (second.graph);
    const auto mixer = mixersOf (history.graph()).front();
    REQUIRE (sendTargets (history.graph(), mixer).size() == 1);
    CHECK (sendTargets (history.graph(), mixer)[0].name == "left");
    const auto sent = addSend (history.graph(), mixer, catalogue(), 1, "other");
    REQUIRE (sent);
    REQUIRE (history.perform (*sent));
    const auto has = [&] (const char* wire) {
        return std::ranges::any_of (history.graph().root.wires, [&] (const graph::Wire& w) { return graph::toText (w) == wire; });
    };
    CHECK (has ("ring_felt.out -> to_left.in[0].z"));
    CHECK (has ("to_left.out -> other.force"));
    CHECK (compile (history.graph(), catalogue()).plan != nullptr);
}
