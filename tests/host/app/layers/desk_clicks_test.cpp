// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/desk_stage.hpp"
#include "host/app/support/seen_text.hpp"
#include <host/app/inspector/blocks/number_field.hpp>
#include <host/app/layers/fader.hpp>
#include <host/app/layers/layers_panel.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/presets/preset_list.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/graph/endpoint_text.hpp>

#include <algorithm>
#include <set>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskStage;
using tactus::host::test::OnStage;
using tactus::host::test::readTexts;
using tactus::host::test::waitFor;

TEST_CASE ("three textures and a vibration are composed with a few clicks", "[layers]")
{
    const auto* preset = GENERATE ("dry_wood.json", "granite_wall.json", "scissors_cloth.json");
    DeskStage w (preset);
    w.show<LayersPanel> (layersPanel);
    const auto mixers = mixersOf (w.graph());
    REQUIRE (mixers.empty());
    const auto steps = w.document.history().names().size();
    w.click ("+ Texture");
    const auto mixer = mixersOf (w.graph()).front();
    w.click ("+ Texture");
    w.click ("+ Recorded");
    w.click ("+ Vibration");
    CHECK (w.clicks == 4);

    const auto& graph = w.graph();
    const auto compiled = compile (graph, catalogue());
    CHECK (compiled.plan != nullptr);
    std::vector<std::string> added;
    for (const auto& n : graph.root.nodes)
        if (n.type.starts_with ("texture.") || n.type.starts_with ("vibration.")) added.push_back (n.type);
    const int layers = layersOf (*findMixer (graph, mixer), catalogue());
    for (int i = layers - 4; i < layers; ++i)
        CHECK (wireInto (graph, mixer, i) != nullptr);
    CHECK (added.size() >= 4);
    CHECK (w.document.history().names().size() == steps + 4);   // one undo step for each
}

namespace
{
/// A bell with a mixer whose gains no control sets.
graph::Graph bellWithoutKnobs()
{
    auto g = loadGraph (TACTUS_SOURCE_DIR "/graphs/bronze_bell.json").graph;
    g.controls.clear();
    return g;
}

std::vector<juce::Point<float>> placesIn (DeskStage& w)
{
    std::vector<juce::Point<float>> places;
    for (const auto& n : w.canvas.scene().nodes())
        places.push_back (n.at);
    return places;
}

NumberField* gainField (juce::Component& in)
{
    if (auto* field = dynamic_cast<NumberField*> (&in); field != nullptr && field->isShowing() && field->getTitle().startsWith ("Gain of ")) return field;
    for (auto* child : in.getChildren())
        if (auto* found = gainField (*child)) return found;
    return nullptr;
}

void typeGain (DeskStage& w, const juce::String& text)
{
    auto* field = gainField (*w.stage);
    REQUIRE (field != nullptr);
    w.stage->doubleClick (w.middleOf (*field));
    OnStage::settle();
    REQUIRE (field->isEditing());
    w.key ("ctrl + a");
    w.stage->type (text);
    w.key ("return");
    OnStage::settle();
}
}   // namespace

TEST_CASE ("a value that is typed moves no node, where nodes have no places of their own", "[layers][canvas]")
{
    DeskStage w (bellWithoutKnobs(), 1280, 900);
    w.show<LayersPanel> (layersPanel);
    const auto before = placesIn (w);
    for (const char* gain : { "-17.31 dB", "-3.3 dB", "0.123 %" })
    {
        const auto gains = w.graph().root.find ("desk")->params;
        typeGain (w, gain);
        CHECK (w.graph().root.find ("desk")->params != gains);
        CHECK (placesIn (w) == before);
    }
    // The first move stores where the nodes are; undone, they are where they were.
    auto& canvas = w.canvas;
    canvas.select ({ canvas.scene().nodes().front().id });
    canvas.commands().nudgeSelection ({ 0.0f, 200.0f });
    REQUIRE (placesIn (w) != before);
    w.document.undo();
    CHECK (placesIn (w) == before);

    // A node that grows by its name pushes aside what it would cover, in the same step.
    w.document.perform (graph::RenameNode { {}, "desk", "a_desk_with_a_name_that_is_long" });
    for (const auto& a : canvas.scene().nodes())
        for (const auto& b : canvas.scene().nodes())
            CHECK ((a.id == b.id || ! a.bounds().intersects (b.bounds())));
    w.document.undo();
    CHECK (placesIn (w) == before);
}

TEST_CASE ("a gain that is looked at in its field keeps all its digits", "[layers]")
{
    DeskStage w (bellWithoutKnobs(), 1280, 900);
    auto& panel = w.show<LayersPanel> (layersPanel);
    REQUIRE (w.document.perform (graph::SetParam { {}, "desk", "gain", Json::array ({ 0.6037, 0.7, 0.123456 }) }));
    OnStage::settle();
    const auto before = w.graph().root.find ("desk")->params;
    const auto steps = w.document.history().position();
    auto* field = gainField (*w.stage);
    REQUIRE (field != nullptr);
    const auto open = [&] {
        w.stage->doubleClick (w.middleOf (*field));
        OnStage::settle();
        REQUIRE (field->isEditing());
    };
    for (const char* end : { "return", "escape", "tab" })
    {
        INFO (end);
        open();
        w.key (end);
        OnStage::settle();
        CHECK (w.graph().root.find ("desk")->params == before);
    }
    open();
    letGoOfFocus (panel);   // as another tab does
    panel.setVisible (false);
    OnStage::settle();
    CHECK (w.graph().root.find ("desk")->params == before);
    panel.setVisible (true);
    OnStage::settle();
    open();
    w.key ("ctrl + a");
    w.stage->type (field->spokenValue());   // the same again, as it is shown
    w.key ("return");
    OnStage::settle();
    CHECK (w.graph().root.find ("desk")->params == before);
    CHECK (w.document.history().position() == steps);
}

TEST_CASE ("a gain that a wire sets is dimmed on the desk, names the wire, and is not set by hand", "[layers]")
{
    DeskStage w (bellWithoutKnobs(), 1280, 900);
    w.show<LayersPanel> (layersPanel);
    graph::Node level;
    level.name = "level";
    level.type = "signal.constant";
    REQUIRE (w.document.perform (graph::AddNode { {}, level }));
    REQUIRE (w.document.perform (graph::AddWire { {}, *graph::parseWire ("level.out -> desk.gain[0]") }));
    OnStage::settle();
    auto* field = gainField (*w.stage);
    REQUIRE (field != nullptr);
    CHECK (field->isDriven());
    CHECK (field->spokenValue() == "level.out");
    const auto version = w.document.version();
    auto* strip = field->getParentComponent();
    for (auto* part : strip->getChildren())
        if (auto* fader = dynamic_cast<Fader*> (part))
        {
            CHECK (fader->getAlpha() < 1.0f);
            CHECK (fader->getTooltip().contains ("level.out"));
            const auto at = w.middleOf (*fader);
            w.stage->drag (at, at.translated (0.0f, 30.0f));
        }
    OnStage::settle();
    CHECK (w.document.version() == version);
}

TEST_CASE ("each of six layers of forces has a meter, and knows the level that a gain in newtons asks for", "[layers]")
{
    DeskStage w ("templates/stroke.json");
    auto& panel = w.show<LayersPanel> (layersPanel);
    REQUIRE (w.start());
    for (int i = 0; i < 3; ++i)
        w.click ("+ Texture");
    REQUIRE (panel.layers() == 6);
    for (std::size_t i = 0; i < 6; ++i)
    {
        INFO ("strip " << i + 1);
        auto& strip = panel.layer (i);
        const double before = strip.shownGain();
        const auto isTaken = [&] {
            strip.typeGain ("7 mN");
            return strip.shownGain() != before;
        };
        bool is_taken = false;
        for (int k = 0; k < 200 && ! is_taken; ++k)
        {
            OnStage::settle (20);
            is_taken = isTaken();
        }
        CHECK (is_taken);
    }
    auto& first = panel.layer (0);   // its level is known, also while it is off
    first.typeGain ("off");
    CHECK (first.shownGain() == 0.0);
    OnStage::settle (300);
    first.typeGain ("7 mN");
    CHECK (first.shownGain() != 0.0);
}

TEST_CASE ("a layer that was added while nothing runs shows no level of another one", "[layers]")
{
    DeskStage w ("templates/stroke.json");
    auto& panel = w.show<LayersPanel> (layersPanel);
    REQUIRE (w.start());
    for (int i = 0; i < 2; ++i)
        w.click ("+ Texture");
    OnStage::settle (1500);
    w.playback.stop();
    OnStage::settle (1500);
    w.click ("+ Texture");
    OnStage::settle (300);
    REQUIRE (panel.layers() == 6);
    const std::set<juce::String> marks { "10 N", "1 N", "0.1 N", "10 mN", "1 mN" };   // of the scale
    for (const auto& seen : host::test::readTexts (panel))
        if (seen.text.endsWith (" mN") || seen.text.endsWith (" N")) CHECK (marks.contains (seen.text));
}

TEST_CASE ("a preset that is dropped on the mixer is a layer of it, in one undo step", "[app][layers]")
{
    DeskStage w ("dry_wood.json");
    auto& panel = w.show<LayersPanel> (layersPanel);
    const auto before = writeGraph (w.graph());
    const auto presets = presetsIn (TACTUS_SOURCE_DIR "/graphs", catalogue());
    const auto bell = std::ranges::find (presets, "Bronze bell", &Preset::name);
    REQUIRE (bell != presets.end());
    const juce::DragAndDropTarget::SourceDetails dragged (juce::String (asDragged (*bell)), nullptr, {});
    CHECK_FALSE (panel.isInterestedInDragSource ({ juce::String ("something else"), nullptr, {} }));
    REQUIRE (panel.isInterestedInDragSource (dragged));
    panel.itemDragEnter (dragged);
    CHECK (w.status.text().contains ("Drop it"));
    panel.itemDropped (dragged);
    DeskStage::settle();
    CHECK (std::ranges::any_of (w.graph().root.nodes, [] (const graph::Node& n) { return n.type.starts_with ("graph:"); }));
    CHECK (w.status.text().contains ("as a layer"));
    const auto added = writeGraph (w.graph());
    REQUIRE (panel.layers() == 4);
    panel.layer (3).remove();   // the node of the preset goes with its layer
    DeskStage::settle();
    CHECK (panel.layers() == 3);
    CHECK (std::ranges::none_of (w.graph().root.nodes, [] (const graph::Node& n) { return n.type.starts_with ("graph:"); }));
    CHECK (w.graph().controls.size() == 1);
    panel.layer (0).remove();   // a node of the graph itself stays
    DeskStage::settle();
    CHECK (w.graph().root.find ("board") != nullptr);
    w.document.undo();
    w.document.undo();
    CHECK (writeGraph (w.graph()) == added);
    w.document.undo();
    CHECK (writeGraph (w.graph()) == before);
}

TEST_CASE ("Ctrl and an arrow key go to the same part of the next strip, and come to rest at the ceiling of the mix", "[app][layers]")
{
    DeskStage w ("bronze_bell.json");
    auto& desk = w.show<LayersPanel> (layersPanel);
    REQUIRE (desk.layers() == 3);
    const auto isAt = [&] (std::size_t i) { return desk.layer (i).gainField().hasKeyboardFocus (true); };
    desk.layer (0).gainField().grabKeyboardFocus();
    const auto before = w.document.history().position();
    for (const std::size_t at : { 1u, 2u })
    {
        w.key ("ctrl + cursor right");
        CHECK (isAt (at));
    }
    for (int i = 0; i < 2; ++i)
    {
        w.key ("ctrl + cursor right");
        CHECK (desk.mix()->fields()[1]->hasKeyboardFocus (true));
    }
    w.key ("ctrl + cursor left");
    CHECK (isAt (2));
    w.key ("ctrl + cursor left");
    CHECK (isAt (1));
    CHECK (w.document.history().position() == before);   // no value has changed
    w.key ("cursor right");
    CHECK (w.document.history().position() == before + 1);   // an arrow alone turns the value
}

TEST_CASE ("the strip of the mix shows each number with its unit", "[app][layers]")
{
    DeskStage w ("bronze_bell.json");
    auto& desk = w.show<LayersPanel> (layersPanel);
    REQUIRE (w.start());
    REQUIRE (waitFor ([&] { return desk.mix()->motorMeter().peak() > 0.0; }));
    desk.refresh();
    int lines = 0;
    for (const auto& t : readTexts (*desk.mix()))
        if (t.text.startsWith ("peak ") || t.text.startsWith ("asked "))
        {
            INFO (t.text);
            ++lines;
            CHECK (t.text.endsWithChar ('N'));
        }
    CHECK (lines == 2);
}
