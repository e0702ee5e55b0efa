// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes and wires that are chosen from the palette.
#include "host/app/support/desk_stage.hpp"
#include "host/app/support/seen_text.hpp"

#include <host/app/adding/node_palette.hpp>
#include <host/app/browser/browser.hpp>
#include <host/app/compose/banks.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskStage;

namespace
{
/// A desk with the palette of the window.
struct PaletteStage : DeskStage
{
    Palette palette;

    explicit PaletteStage (const std::string& preset = {}, int width = 1280, int height = 720) : DeskStage (preset, width, height)
    {
        stage->addChildComponent (palette);
        canvas.onNodeRequested = [this] (const NodeRequest& request) { openNodePalette (desk, palette, {}, request); };
        canvas.onChoose = [this] (const auto& purpose, auto entries, auto chosen) {
            openPalette (palette, canvas, purpose, std::move (entries), std::move (chosen));
        };
    }

    graph::Id id (const std::string& node) { return graph().root.find (node)->id; }

    const SceneNode& shown (const std::string& node)
    {
        const auto& nodes = canvas.scene().nodes();
        const auto found = std::ranges::find (nodes, node, &SceneNode::name);
        REQUIRE (found != nodes.end());
        return *found;
    }

    void type (const juce::String& words)
    {
        stage->type (words);
        settle();   // JUCE tells of typed text later
    }

    /// The entries of the list for these words after this key.
    const std::vector<PaletteEntry>& listed (const char* key, const char* words)
    {
        this->key (key);
        REQUIRE (palette.isShowing());
        type (words);
        return palette.entries();
    }

    void enter()
    {
        this->key ("return");
        settle();
    }

    void choose (const char* key, const char* words)
    {
        INFO (key << ' ' << words);
        static_cast<void> (listed (key, words));
        enter();
    }

    bool hasWire (const std::string& text) { return std::ranges::count (canvas.scene().wires(), text, &SceneWire::text) > 0; }
};
}   // namespace

TEST_CASE ("W wires a vector into a number: the list asks for the component", "[app][keyboard]")
{
    PaletteStage w ("dry_wood.json");
    w.canvas.select ({ w.graph().root.find ("hand")->id });
    w.choose ("w", "touch depth");
    REQUIRE (w.palette.isShowing());
    w.type ("position.z");
    w.enter();
    CHECK_FALSE (w.palette.isShowing());
    CHECK (w.hasWire ("hand.position.z -> touch.depth"));
    CHECK (DeskStage::focused() == &w.canvas);
}

TEST_CASE ("W wires into the selected node, too, and finds names before descriptions", "[app][keyboard]")
{
    PaletteStage w ("dry_wood.json");
    w.canvas.select ({ w.id ("motor") });
    w.choose ("w", "grain force");
    CHECK (w.hasWire ("grain.force -> motor.force"));
    w.key ("ctrl + z");
    REQUIRE_FALSE (w.hasWire ("grain.force -> motor.force"));

    const auto count = w.graph().root.nodes.size();
    w.canvas.select ({ w.id ("motor") });
    w.choose ("w", "torque new");   // a new node before the motor
    w.type ("edge");
    w.enter();
    REQUIRE (w.graph().root.nodes.size() == count + 1);
    const auto& added = w.graph().root.nodes.back();
    CHECK (added.type == "cut.edge");
    CHECK (w.hasWire (added.name + ".torque -> motor.torque"));
    CHECK (w.shown (added.name).bounds().getRight() < w.shown ("motor").bounds().getX());

    w.canvas.select ({ w.id ("board") });
    bool was_described = false;
    int named = 0;
    for (const auto& e : w.listed ("w", "gain"))
        if (e.name.empty())   // a wire between nodes that are there
        {
            const bool is_named = e.type.find ("gain") != std::string::npos;
            CHECK_FALSE ((was_described && is_named));
            was_described = was_described || ! is_named;
            named += static_cast<int> (is_named);
        }
    CHECK (named > 0);
    w.key ("escape");

    w.canvas.select ({});
    w.key ("w");
    CHECK_FALSE (w.palette.isShowing());
    CHECK (w.status.text().contains ("Select one node first"));
}

TEST_CASE ("a wire that is dropped from an input offers what the input is made for first", "[app][canvas]")
{
    PaletteStage w ("dry_wood.json");
    for (const auto& [port, type, wire] :
         { std::tuple { "normal_force", "cut.blade", "resistance" }, std::tuple { "position", "device.position", "position" } })
    {
        INFO (port);
        const auto* socket = w.shown ("drag").box.find (Role::input, port);
        REQUIRE (socket != nullptr);
        auto to = w.canvas.view().toPixels (w.shown ("drag").bounds().getCentre());
        const auto isTaken = [&, &scene = w.canvas.scene()] {
            const auto at = w.canvas.view().toCanvas (to);
            return scene.nodeAt (at) != nullptr || scene.wireAt (at, 12.0f) != nullptr;
        };
        while (isTaken())
            to.y += 10.0f;
        REQUIRE (w.canvas.getLocalBounds().toFloat().contains (to));
        w.choose ("spacebar", "lfo");   // what was chosen before is no better
        const auto count = w.graph().root.nodes.size();
        const auto from = w.canvas.view().toPixels (w.shown ("drag").placeOf (*w.shown ("drag").box.find (Role::input, port)));
        w.stage->drag (w.stage->getLocalPoint (&w.canvas, from), w.stage->getLocalPoint (&w.canvas, to));
        DeskStage::settle();
        const auto& palette = w.palette;
        REQUIRE (palette.isShowing());
        const auto texts = tactus::host::test::readTexts (w.palette);
        CHECK (std::ranges::any_of (texts, [from = "Connect " + juce::String (port) + " from"] (const auto& t) { return t.text == from; }));
        CHECK (palette.entries()[0].name == "Fits best");
        CHECK (std::ranges::count (palette.entries(), std::string (type), &PaletteEntry::type) == 1);   // not listed again

        if (std::string (port) == "position")   // there are such nodes, but they make forces
        {
            w.type ("hunt");
            REQUIRE (palette.entries().size() == 1);
            CHECK (palette.entries()[0].isTitle());
            CHECK (palette.entries()[0].name.ends_with ("has no port for this wire"));
            CHECK (tactus::host::test::cutOff (tactus::host::test::readTexts (w.palette), palette.getLocalBounds().toFloat()).isEmpty());
            w.key ("return");
            CHECK (palette.isVisible());
            CHECK (w.graph().root.nodes.size() == count);
            for (int i = 0; i < 4; ++i)
                w.key ("backspace");
            DeskStage::settle();
        }
        w.enter();
        REQUIRE (w.graph().root.nodes.size() == count + 1);
        const auto& added = w.graph().root.nodes.back();
        CHECK (added.type == type);
        CHECK (w.hasWire (added.name + "." + wire + " -> drag." + port));
    }
}

TEST_CASE ("a preset becomes a layer from the list of nodes", "[app][canvas][clipboard]")
{
    PaletteStage w ("dry_wood.json");
    w.show<PresetBrowser> (presetsPanel);
    w.choose ("spacebar", "bronze b");
    INFO (w.status.text());
    CHECK (w.graph().root.find ("bronze_bell") != nullptr);
    CHECK (compose::bypassedBanks (w.graph(), catalogue()).empty());
    w.choose ("spacebar", "lfo");
    CHECK (std::ranges::count (w.graph().root.nodes, "signal.lfo", &graph::Node::type) == 1);
}

TEST_CASE ("the first node is where the double click was", "[app][canvas]")
{
    PaletteStage w;
    auto& canvas = w.canvas;
    for (const auto& part : { juce::Point<float> (0.3f, 0.4f), juce::Point<float> (0.85f, 0.2f), juce::Point<float> (0.97f, 0.97f) })
    {
        w.document.open ({}, {}, "new graph");
        canvas.frameStart();
        const auto at = canvas.getLocalBounds().toFloat().getRelativePoint (part.x, part.y);
        const auto on_canvas = canvas.view().toCanvas (at);
        w.stage->doubleClick (w.stage->getLocalPoint (&canvas, at));
        DeskStage::settle();
        REQUIRE (w.palette.isShowing());
        w.type ("plane");
        w.enter();
        REQUIRE (canvas.scene().nodes().size() == 1);
        const auto b = canvas.scene().nodes().front().bounds();
        INFO (part.toString() << ": " << on_canvas.toString() << " " << b.toString());
        CHECK (b.expanded (1.0f).contains (on_canvas));
        const juce::Rectangle<float> pixels (canvas.view().toPixels (b.getTopLeft()), canvas.view().toPixels (b.getBottomRight()));
        CHECK (canvas.getLocalBounds().toFloat().contains (pixels));
        w.key ("ctrl + z");
    }
}

TEST_CASE ("an oscillator that keys add and wire gets a free place at the left of what it feeds, in one step", "[app][compose][keyboard]")
{
    for (const auto& words : { "grain amp", "roughness", "board stiff" })
    {
        INFO (words);
        PaletteStage w ("dry_wood.json", 1600, 1000);
        auto& canvas = w.canvas;
        const auto choose = [&] (const char* key, const char* text) {
            w.key (key);
            w.type (text);
            w.enter();
        };
        choose ("spacebar", "lfo");
        const auto position = w.document.history().position();
        const auto* lfo = w.graph().root.find ("lfo");
        REQUIRE (lfo != nullptr);
        const auto id = lfo->id;
        const auto begun_at = canvas.scene().find (id)->at;
        w.choose ("w", words);
        const auto& wires = canvas.scene().wires();
        const auto wire = std::ranges::find (wires, "lfo.out", &SceneWire::source);
        REQUIRE (wire != wires.end());
        CHECK (wire->add);
        CHECK (wire->from.x < wire->to.x);
        const auto place = canvas.scene().find (id)->bounds();
        CHECK (std::ranges::none_of (canvas.scene().nodes(), [&] (const SceneNode& n) { return n.id != id && n.bounds().intersects (place); }));
        CHECK (w.document.history().position() == position + 1);
        w.key ("ctrl + z");
        CHECK (canvas.scene().find (id)->at == begun_at);
    }
}
