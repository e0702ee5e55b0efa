// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/layers/mixer.hpp>
#include <host/app/storage/snapshots.hpp>

#include <tactus/file/graph_file.hpp>
#include <tactus/graph/history.hpp>
#include <tactus/plan/compile.hpp>

#include "support/sketch.hpp"

#include <catch2/catch.hpp>
#include <rapidcheck.h>

#include <map>
#include <numeric>

using namespace tactus;
using namespace tactus::host;

namespace
{
graph::Graph bell() { return loadGraph (TACTUS_SOURCE_DIR "/graphs/bronze_bell.json").graph; }

bool compiles (const graph::Graph& g)
{
    const auto compiled = compile (g, catalogue());
    for (const auto& m : compiled.messages)
        if (m.severity == Message::Severity::error) UNSCOPED_INFO (m.where << ": " << m.text);
    return compiled.plan != nullptr;
}

std::vector<std::string> sources (const graph::Graph& g, const MixerPlace& mixer)
{
    std::vector<std::string> all;
    for (int i = 0; i < layersOf (*findMixer (g, mixer), catalogue()); ++i)
    {
        const auto* w = wireInto (g, mixer, i);
        all.push_back (w == nullptr ? "" : w->from.node);
    }
    return all;
}

/// Everything that belongs to each layer: its source, name, gain, and the control of the gain.
std::vector<std::string> channels (const graph::Graph& g, const MixerPlace& mixer)
{
    const auto& node = *findMixer (g, mixer);
    const int n = layersOf (node, catalogue());
    auto all = sources (g, mixer);
    const auto names = layerNames (node, n);
    for (int i = 0; i < n; ++i)
    {
        auto& text = all[static_cast<std::size_t> (i)];
        text += '|' + names[static_cast<std::size_t> (i)] + '|' + layerValue (node, catalogue(), "gain", i).dump() + '|';
        for (const auto& c : g.controls)
            for (const auto& t : c.to)
                if (t.path == mixer.path + ".gain[" + std::to_string (i) + ']') text += c.id;
    }
    return all;
}
}   // namespace

TEST_CASE ("each mixer of a graph is found once, including those in subgraphs", "[layers]")
{
    tactus::test::Sketch sketch;
    sketch.node ("a", "layer.mix").node ("first", "graph:inner").node ("second", "graph:inner");
    sketch.add (sketch.subgraph ("inner"), "mix", "layer.mix");
    const auto mixers = mixersOf (sketch.graph);
    REQUIRE (mixers.size() == 2);
    CHECK (mixers[0].path == "a");
    CHECK (mixers[1].path == "first/mix");
    CHECK (mixers[1].patch == "inner");
    CHECK (findMixer (sketch.graph, mixers[1])->type == "layer.mix");
}

TEST_CASE ("removing a layer removes its wires, keeps the other layers intact, and can be undone", "[layers]")
{
    graph::History history (bell());
    const auto before = writeGraph (history.graph());
    const auto mixer = mixersOf (history.graph()).front();
    const auto all = channels (history.graph(), mixer);
    REQUIRE (all == std::vector<std::string> { "blow|blow|1|blow", "ring_felt|ring|1|ring", "warble_felt|warble|0.5|warble" });

    auto command = removeLayer (history.graph(), mixer, catalogue(), 1);
    REQUIRE (command);
    CHECK (history.perform (*command));
    CHECK (channels (history.graph(), mixer) == std::vector<std::string> { all[0], all[2] });
    CHECK (history.graph().controls[1].to.empty());
    CHECK (compiles (history.graph()));
    CHECK (history.names().size() == 1);
    history.undo();
    CHECK (writeGraph (history.graph()) == before);
}

TEST_CASE ("neither the last layer nor one that a subgraph exposes can be removed", "[layers]")
{
    tactus::test::Sketch sketch;
    sketch.node ("a", "graph:inner").node ("one", "layer.mix", Json::object(), { { "inputs", 1 } });
    auto& inner = sketch.subgraph ("inner");
    sketch.add (inner, "mix", "layer.mix");
    inner.expose.inputs.emplace_back ("x", graph::Endpoint { "mix", "in", 1, -1 });
    const auto mixers = mixersOf (sketch.graph);
    REQUIRE (mixers.size() == 2);
    CHECK (removeLayer (sketch.graph, mixers[0], catalogue(), 1).error().id == "mixer/exposed");
    CHECK (removeLayer (sketch.graph, mixers[0], catalogue(), 0));
    CHECK (removeLayer (sketch.graph, mixers[1], catalogue(), 0).error().id == "mixer/last_layer");
}

TEST_CASE ("a moved layer keeps everything that belongs to it, and moving it back restores the file", "[layers]")
{
    CHECK (rc::check ([] {
        graph::History history (bell());
        const auto before = writeGraph (history.graph());
        const auto mixer = mixersOf (history.graph()).front();
        auto all = channels (history.graph(), mixer);
        const auto from = *rc::gen::inRange (0, 3), to = *rc::gen::inRange (0, 3);
        RC_ASSERT (history.perform (moveLayer (history.graph(), mixer, catalogue(), from, to)).has_value());
        const auto moved = all[static_cast<std::size_t> (from)];
        all.erase (all.begin() + from);
        all.insert (all.begin() + to, moved);
        RC_ASSERT (channels (history.graph(), mixer) == all);
        RC_ASSERT (history.perform (moveLayer (history.graph(), mixer, catalogue(), to, from)).has_value());
        RC_ASSERT (writeGraph (history.graph()) == before);
    }));
}

TEST_CASE ("a snapshot gives each layer its own values, whichever layers are removed and moved after it", "[layers][snapshots]")
{
    constexpr int layers = 6;
    const auto check = [] (bool is_inside) {
        tactus::test::Sketch sketch;
        auto& patch = is_inside ? sketch.node ("first", "graph:inner").subgraph ("inner") : sketch.graph.root;
        sketch.add (patch, "desk", "layer.mix", Json::object(), { { "inputs", layers }, { "names", "0, 1, 2, 3, 4, 5" } });
        graph::History history (sketch.graph);
        const auto mixer = mixersOf (history.graph()).front();
        const auto set = [&] (const char* param, int layer, const std::optional<Json>& value) {
            const auto command = setLayerValue (*findMixer (history.graph(), mixer), mixer, catalogue(), param, layer, value);
            RC_ASSERT (history.perform (command).has_value());
        };
        const auto valuesIn = [&] (const graph::Graph& g) {   // by the name of the layer
            const auto& node = *findMixer (g, mixer);
            std::map<std::string, std::string> values;
            const auto names = layerNames (node, layersOf (node, catalogue()));
            for (int i = 0; i < static_cast<int> (names.size()); ++i)
                for (const char* param : { "gain", "mute", "solo" })
                    values[names[static_cast<std::size_t> (i)]] += Json (layerValue (node, catalogue(), param, i).get<double>()).dump() + ' ';
            return values;
        };
        for (int i = 0; i < layers; ++i)
            for (const char* param : { "gain", "mute", "solo" })
                set (param, i, Json (*rc::gen::inRange (0, 2)));
        const auto stored = valuesIn (history.graph());
        RC_ASSERT (history.perform (storeSnapshot (history.graph(), 1)).has_value());
        for (int i = 0; i < layers; ++i)
            set ("gain", i, Json (0.5));
        const auto before = writeGraph (history.graph());
        const auto steps = history.position();
        for (int left = layers, change = 0; left > 1 && change < 12; ++change)
        {
            const bool is_removal = *rc::gen::inRange (0, 3) > 0;
            const int layer = *rc::gen::inRange (0, left), to = *rc::gen::inRange (0, left);
            const auto command = is_removal ? removeLayer (history.graph(), mixer, catalogue(), layer)
                                            : Result<graph::Command> (moveLayer (history.graph(), mixer, catalogue(), layer, to));
            RC_ASSERT (history.perform (*command).has_value());
            left -= is_removal ? 1 : 0;
            auto recalled = history.graph();
            if (const auto recall = recallSnapshot (recalled, 1)) RC_ASSERT (graph::apply (recalled, *recall).has_value());
            const auto values = valuesIn (recalled);
            RC_ASSERT (static_cast<int> (values.size()) == left);
            for (const auto& [name, value] : values)
                RC_ASSERT (value == stored.at (name));
        }
        while (history.position() > steps)
            history.undo();
        RC_ASSERT (writeGraph (history.graph()) == before);
    };
    CHECK (rc::check ([&] { check (false); }));
    CHECK (rc::check ([&] { check (true); }));
}

TEST_CASE ("every texture and vibration that can be a layer can be added and wired, and compiles", "[layers]")
{
    REQUIRE (layerTypes (catalogue()).size() >= 4);
    for (const auto* type : layerTypes (catalogue()))
    {
        INFO (type->info.id);
        graph::History history (bell());
        const auto mixer = mixersOf (history.graph()).front();
        auto added = addLayer (history.graph(), mixer, catalogue(), std::string (type->info.id));
        REQUIRE (added);
        REQUIRE (history.perform (added->command));
        CHECK (layersOf (*findMixer (history.graph(), mixer), catalogue()) == 4);
        CHECK (sources (history.graph(), mixer).back() != "");
        CHECK (compiles (history.graph()));
        const auto& nodes = history.graph().root.nodes;
        const auto made = std::find_if (nodes.rbegin(), nodes.rend(), [&] (const graph::Node& n) { return n.type == type->info.id; });
        REQUIRE (made != nodes.rend());
        int inputs = 0;
        for (const auto& w : history.graph().root.wires)
            if (w.to.node == made->name) ++inputs;
        CHECK (inputs + (added->missing.empty() ? 0 : 1) >= static_cast<int> (type->inputs.size()));
    }
}

TEST_CASE ("a texture that is added as a layer is felt only in contact", "[layers]")
{
    const auto wires = [] (const graph::Graph& g) {
        std::vector<std::string> all;
        for (const auto& w : g.root.wires)
            all.push_back (graph::toText (w));
        return all;
    };
    const auto has = [&] (const graph::Graph& g, const char* wire) { return std::ranges::count (wires (g), wire) == 1; };

    graph::History with_window (bell());   // it has a window already
    auto added = addLayer (with_window.graph(), mixersOf (with_window.graph()).front(), catalogue(), "texture.grating");
    REQUIRE (added);
    REQUIRE (with_window.perform (added->command));
    CHECK (has (with_window.graph(), "grating.value -> grating_felt.in[0]"));
    CHECK (has (with_window.graph(), "touch.gain -> grating_felt.in[1]"));
    CHECK (has (with_window.graph(), "grating_felt.out -> desk.in[3]"));

    tactus::test::Sketch sketch;   // only a surface
    sketch.node ("hand", "device.position").node ("wall", "deform.plane").node ("desk", "layer.mix", Json::object(), { { "inputs", 1 } });
    sketch.wire ("hand.position -> wall.position");
    graph::History with_depth (sketch.graph);
    added = addLayer (with_depth.graph(), mixersOf (with_depth.graph()).front(), catalogue(), "texture.grating");
    REQUIRE (added);
    REQUIRE (with_depth.perform (added->command));
    CHECK (has (with_depth.graph(), "wall.depth -> touch.depth"));
    CHECK (has (with_depth.graph(), "touch.gain -> grating_felt.in[1]"));
    CHECK (has (with_depth.graph(), "grating_felt.out -> desk.in[0]"));   // the only layer was empty
    CHECK (layersOf (*findMixer (with_depth.graph(), mixersOf (with_depth.graph()).front()), catalogue()) == 1);
    CHECK (with_depth.names().size() == 1);

    tactus::test::Sketch alone;   // nothing to touch: felt everywhere
    alone.node ("hand", "device.position").node ("desk", "layer.mix");
    added = addLayer (alone.graph, mixersOf (alone.graph).front(), catalogue(), "texture.grating");
    REQUIRE (added);
    graph::History without (alone.graph);
    REQUIRE (without.perform (added->command));
    CHECK (has (without.graph(), "grating.value -> desk.in[2]"));
}

TEST_CASE ("the inputs of a new layer are never wired to anything downstream of the mixer", "[layers]")
{
    tactus::test::Sketch sketch;
    sketch.node ("desk", "layer.mix").node ("late", "contact.impact").wire ("desk.out -> late.depth");
    sketch.graph.root.wires.clear();
    sketch.node ("map", "signal.gain").wire ("desk.out -> map.in").wire ("map.out -> late.depth");
    const auto mixer = mixersOf (sketch.graph).front();
    auto added = addLayer (sketch.graph, mixer, catalogue(), "vibration.modal");
    REQUIRE (added);
    CHECK (added->missing.find (".hit") != std::string::npos);
}

TEST_CASE ("a mixer is inserted between scalar forces and the motor", "[layers]")
{
    graph::History joined (loadGraph (TACTUS_SOURCE_DIR "/graphs/scissors_cloth.json").graph);
    auto between = addMixer (joined.graph(), catalogue());
    REQUIRE (between);
    REQUIRE (joined.perform (between->command));
    const auto mixer = mixersOf (joined.graph()).front();
    CHECK (mixer == between->place);
    CHECK_FALSE (mixer.vectors);
    for (const auto& s : sources (joined.graph(), mixer))
        CHECK (s != "");
    CHECK (compiles (joined.graph()));
    CHECK (joined.names().size() == 1);

    CHECK (addMixer ({}, catalogue()).error().id == "mixer/no_motor");
}

TEST_CASE ("a mixer can be added to every preset with a motor", "[layers]")
{
    for (const auto& entry : std::filesystem::directory_iterator (TACTUS_SOURCE_DIR "/graphs"))
    {
        if (entry.path().extension() != ".json") continue;
        INFO (entry.path());
        graph::History history (loadGraph (entry.path()).graph);
        auto added = addMixer (history.graph(), catalogue());
        if (! added) continue;
        REQUIRE (history.perform (added->command));
        const auto messages = compile (history.graph(), catalogue()).messages;
        for (const auto& m : messages)
            if (m.severity == Message::Severity::error) CHECK (m.id.starts_with ("setting"));   // files are not read here
    }
}

TEST_CASE ("layer values are set one by one, and a list of defaults is not written", "[layers]")
{
    graph::History history (bell());
    const auto mixer = mixersOf (history.graph()).front();
    const auto node = [&]() -> const graph::Node& { return *findMixer (history.graph(), mixer); };
    REQUIRE (history.perform (setLayerValue (node(), mixer, catalogue(), "mute", 2, Json (1))));
    CHECK (node().params["mute"].dump() == "[0.0,0.0,1]");
    CHECK (layerValue (node(), catalogue(), "mute", 2) == 1);
    CHECK (layerValue (node(), catalogue(), "mute", 0) == 0.0);
    REQUIRE (history.perform (setLayerValue (node(), mixer, catalogue(), "mute", 2, std::nullopt)));
    CHECK_FALSE (node().params.contains ("mute"));
    REQUIRE (history.perform (renameLayer (node(), mixer, 3, 1, " hum, deep ")));
    CHECK (layerNames (node(), 3) == std::vector<std::string> { "blow", "hum  deep", "warble" });
}

TEST_CASE ("if the motors are inside a subgraph, the message says where to add a mixer", "[layers]")
{
    const auto added = addMixer (loadGraph (TACTUS_SOURCE_DIR "/graphs/two_fingers.json").graph, catalogue());
    CHECK (added.error().id == "mixer/in_subgraph");
}

TEST_CASE ("a layer never takes a force along the surface, or of another effect, as its load", "[layers]")
{
    auto graph = readGraph (R"({"format":"tactus-graph","version":2,"devices":{"pen":{"driver":"sim"}},"nodes":{"hand":{"type":"device.position","role":"pen"},
        "grain":{"type":"texture.grating"},"ring":{"type":"vibration.modal"},"motor":{"type":"device.force","role":"pen"}},
        "wires":["hand.position -> grain.position","grain.force -> motor.force","ring.value -> motor.force.z"]})")
                     .graph;
    const auto mixer = addMixer (graph, catalogue());
    REQUIRE (mixer);
    REQUIRE (graph::apply (graph, mixer->command));
    const auto layer = addLayer (graph, mixer->place, catalogue(), "texture.noise");
    REQUIRE (layer);
    CHECK (layer->missing.find ("noise.normal_force") != std::string::npos);
    REQUIRE (graph::apply (graph, layer->command));
    for (const auto& w : graph.root.wires)
        CHECK (w.to.port != "normal_force");
}
