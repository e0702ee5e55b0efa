// SPDX-License-Identifier: GPL-3.0-or-later
// The clipboard between two graphs, and text that strangers put there.
#include "host/app/support/desk_stage.hpp"

#include <host/app/compose/add_preset.hpp>
#include <host/app/compose/banks.hpp>
#include <host/app/layers/mixer.hpp>
#include <host/app/model/clipboard.hpp>
#include <host/app/model/fragment.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/file/text_file.hpp>

#include "support/sketch.hpp"

#include <algorithm>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskStage;
using tactus::host::test::OnStage;
using tactus::test::Sketch;

namespace
{
void copyAll (DeskStage& w)
{
    w.canvas.grabKeyboardFocus();
    w.key ("ctrl + a");
    w.key ("ctrl + c");
}

bool hasMotorLayers (const graph::Graph& g, std::size_t layers)
{
    const auto mixer = std::ranges::find (g.root.nodes, "layer.mix_vectors", &graph::Node::type);
    return mixer != g.root.nodes.end() && mixer->settings.at ("inputs") == Json (layers) && compose::bypassedBanks (g, catalogue()).empty()
           && std::ranges::count (g.root.nodes, "device.force", &graph::Node::type) == 1;
}
}   // namespace

TEST_CASE ("a graph that is copied in one window becomes a layer in another one, with its knobs, in one undo step", "[app][canvas][clipboard]")
{
    {
        DeskStage first ("velvet.json");
        copyAll (first);
    }
    const auto text = textFromClipboard();
    const auto alone = readGraph (text);
    REQUIRE_FALSE (hasErrors (alone.messages));
    CHECK (alone.graph.name == "Velvet");
    CHECK (alone.graph.devices.size() == 1);
    CHECK_FALSE (alone.graph.controls.empty());

    DeskStage w ("dry_wood.json");
    const auto before = writeGraph (w.graph());
    const auto knobs = w.graph().controls.size();
    w.canvas.grabKeyboardFocus();
    w.key ("ctrl + shift + v");
    OnStage::settle();
    INFO (w.status.text());
    CHECK (w.graph().root.find ("velvet") != nullptr);
    CHECK (hasMotorLayers (w.graph(), 4));
    CHECK (w.graph().controls.size() == knobs + alone.graph.controls.size());
    CHECK (w.status.text().contains ("Velvet"));
    w.key ("ctrl + z");
    CHECK (writeGraph (w.graph()) == before);

    w.key ("ctrl + v");   // the nodes themselves
    OnStage::settle();
    CHECK (std::ranges::count (w.graph().root.nodes, "device.force", &graph::Node::type) == 2);
    CHECK (w.status.text().contains ("Ctrl+Shift+V"));
}

TEST_CASE ("a copied layer becomes one more layer, with the inputs of the original, in one undo step", "[app][canvas][clipboard]")
{
    auto g = loadGraph (TACTUS_SOURCE_DIR "/graphs/dry_wood.json").graph;
    const auto pad = loadGraph (TACTUS_SOURCE_DIR "/graphs/soft_pad.json").graph;
    const auto added = compose::addPreset (g, pad, { .roles = compose::roleMaps (g, pad).front() }, catalogue());
    REQUIRE (added);
    REQUIRE (graph::apply (g, added->command));
    const auto layers = static_cast<std::size_t> (layersOf (*g.root.find ("desk"), catalogue()));
    DeskStage w (g);
    const auto before = writeGraph (w.graph());
    const auto wiresInto = [&] (const std::string& node) {
        return std::ranges::count (w.graph().root.wires, node, [] (const graph::Wire& wire) { return wire.to.node; });
    };
    for (const auto& name : { std::string ("drag"), added->block })   // a node, and a preset
    {
        INFO (name);
        w.canvas.grabKeyboardFocus();
        w.canvas.select ({ w.graph().root.find (name)->id });
        w.key ("ctrl + c");
        w.key ("ctrl + shift + v");
        OnStage::settle();
        INFO (w.status.text());
        const auto* copy = w.graph().root.find (name + "_2");
        REQUIRE (copy != nullptr);
        CHECK (hasMotorLayers (w.graph(), layers + 1));
        CHECK (wiresInto (copy->name) == wiresInto (name));
        CHECK (w.canvas.selection() == Selection { copy->id });
        const auto last = mixersOf (w.graph()).front();
        const auto* wire = wireInto (w.graph(), last, static_cast<int> (layers));
        REQUIRE (wire != nullptr);
        CHECK (wire->from.node == copy->name);
        w.key ("ctrl + z");
        CHECK (writeGraph (w.graph()) == before);
    }

    w.canvas.select ({ w.graph().root.find ("hand")->id });
    w.key ("ctrl + c");
    w.key ("ctrl + shift + v");
    OnStage::settle();
    CHECK (w.status.text().contains ("the copied nodes"));
    CHECK (writeGraph (w.graph()) == before);
}

TEST_CASE ("copied nodes become a layer of another graph, whatever they need there; an oscillator alone does not, as it is no force", "[app][clipboard]")
{
    const auto pad = loadGraph (TACTUS_SOURCE_DIR "/graphs/soft_pad.json").graph, beat = loadGraph (TACTUS_SOURCE_DIR "/graphs/heartbeat.json").graph;
    auto mixed = pad;
    const auto added = compose::addPreset (mixed, beat, { .roles = compose::roleMaps (mixed, beat).front() }, catalogue());
    REQUIRE (added);
    REQUIRE (graph::apply (mixed, added->command));
    const auto pasted = [] (const Sketch& copied, graph::Graph g) {
        std::set<graph::Id> made;
        auto layer = addCopiedLayer (g, {}, catalogue(), copied.graph, made);
        if (layer) REQUIRE (graph::apply (g, layer->command));   // no name is made twice
        return std::pair (std::move (layer), std::move (g));
    };
    Sketch swelling;   // both want to know of the contact, and there is no window of it
    swelling.node ("swell", "signal.envelope");
    swelling.node ("grain", "texture.noise");
    swelling.wire ("swell.out -> grain.amplitude");
    const auto [layer, with] = pasted (swelling, mixed);
    INFO ((layer ? std::string() : layer.error().text));
    REQUIRE (layer);
    CHECK (hasMotorLayers (with, static_cast<std::size_t> (layersOf (*with.root.find ("desk"), catalogue()))));

    Sketch lone;
    lone.node ("lfo", "signal.lfo");
    CHECK_FALSE (pasted (lone, mixed).first);
    const auto none = pasted (swelling, pad).first;
    REQUIRE_FALSE (none);
    CHECK (none.error().id == "mixer/none");
}

TEST_CASE ("relative files of copied nodes are found from the other graph's folder", "[app][canvas][clipboard]")
{
    const TemporaryFolder folder;
    std::filesystem::create_directories (folder / "a");
    std::filesystem::create_directories (folder / "b");
    REQUIRE (writeTextFile (folder / "a" / "heart.haptic", *readFile (TACTUS_SOURCE_DIR "/graphs/assets/heartbeat.haptic")));
    Sketch s;
    s.node ("beat", "signal.clip", Json::object(), { { "clip", "heart.haptic" } });
    REQUIRE (saveGraph (s.graph, folder / "a" / "one.json"));
    REQUIRE (saveGraph (Sketch {}.node ("x", "signal.constant").graph, folder / "b" / "two.json"));
    {
        DeskStage first ((folder / "a" / "one.json").string());
        copyAll (first);
        first.key ("ctrl + v");   // in the same graph, the path stays as it is
        REQUIRE (first.graph().root.nodes.size() == 2);
        CHECK (first.graph().root.nodes[1].settings.at ("clip") == Json ("heart.haptic"));
    }
    DeskStage w ((folder / "b" / "two.json").string());
    w.canvas.grabKeyboardFocus();
    w.key ("ctrl + v");
    REQUIRE (w.graph().root.find ("beat") != nullptr);
    CHECK (w.graph().root.find ("beat")->settings.at ("clip") == Json ("../a/heart.haptic"));
}

TEST_CASE ("text of strangers in the clipboard changes nothing, and the window says why", "[app][canvas][clipboard]")
{
    DeskStage w ("dry_wood.json");
    const auto before = writeGraph (w.graph());
    std::string deep (100'000, '['), wide = R"({"format":"tactus-graph","version":2,"nodes":{)";
    for (int i = 0; i < 400'000; ++i)
        wide += (i == 0 ? "\"n" : ",\"n") + std::to_string (i) + R"(":{"type":"signal.gain","params":{"gain":1}})";
    wide += "}}";
    for (const auto& text : { std::string ("no graph"), std::string(), std::string ("{}"), deep, wide,
                              std::string (R"({"format":"tactus-graph","version":99})"),
                              std::string (R"({"format":"tactus-graph","version":2,"nodes":{"a":{"type":7}}})"),
                              std::string (R"({"format":"tactus-graph","version":2,"nodes":{"../x":{"type":"signal.gain"}}})") })
        for (const auto* key : { "ctrl + v", "ctrl + shift + v" })
        {
            INFO (text.substr (0, 80) << " " << key);
            copyToClipboard (text);
            w.canvas.grabKeyboardFocus();
            w.key (key);
            CHECK (writeGraph (w.graph()) == before);
            CHECK (w.status.text().contains ("Nothing to paste"));
        }
}

TEST_CASE ("a clipboard without nodes is said to have none", "[app][canvas][clipboard]")
{
    DeskStage w ("dry_wood.json");
    const auto before = writeGraph (w.graph());
    for (const auto& text : { std::string(), writeGraph (graph::Graph {}) })
        for (const auto* key : { "ctrl + v", "ctrl + shift + v" })
        {
            INFO (text << " " << key);
            copyToClipboard (text);
            w.status.refuse ({});
            w.canvas.grabKeyboardFocus();
            w.key (key);
            CHECK (writeGraph (w.graph()) == before);
            CHECK (w.status.text() == "Nothing to paste: the clipboard has no nodes");
        }
}

TEST_CASE ("where there is nothing that a layer could join, Ctrl+Shift+V says so", "[app][canvas][clipboard]")
{
    DeskStage w;
    w.canvas.grabKeyboardFocus();
    w.key ("ctrl + shift + v");
    CHECK (w.graph().root.nodes.empty());
    CHECK (w.status.text().contains ("Ctrl+V"));
}

TEST_CASE ("a pasted subgraph does not become another one of the same name", "[fragment]")
{
    const auto with = [] (double gain) {
        Sketch s;
        auto& inside = s.subgraph ("grain");
        s.add (inside, "a", "signal.gain", { { "gain", gain } });
        s.node ("x", "graph:grain");
        return s.graph;
    };
    auto g = with (1.0);
    for (const double gain : { 1.0, 2.0 })
    {
        const auto other = with (gain);
        std::set<graph::Id> made;
        const auto pasted = paste (g, "", fragmentOf (other, "", { other.root.nodes[0].id }), {}, made);
        REQUIRE (pasted);
        auto after = g;
        REQUIRE (graph::apply (after, *pasted));
        CHECK (after.graphs.size() == (gain == 1.0 ? 1 : 2));
        const auto& node = *after.root.find ("x_2");
        CHECK (after.find (node.type.substr (6))->nodes[0].params.at ("gain") == Json (gain));
        CHECK (made == std::set<graph::Id> { node.id });
        CHECK (node.id != other.root.nodes[0].id);
    }
}
