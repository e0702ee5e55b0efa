// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/desk_stage.hpp"
#include "host/app/support/seen_text.hpp"

#include <host/app/top_bar/top_bar.hpp>
#include <tactus/file/graph_file.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskStage;
using tactus::host::test::OnStage;

namespace
{
/// The bar over a canvas. It gets the keys that the canvas does not take, as in the window.
struct BarStage : DeskStage
{
    explicit BarStage (int width = 1280, const char* preset = "dry_wood.json") : DeskStage (preset, width, 700)
    {
        stage->addAndMakeVisible (top);
        top.setBounds (0, 0, width, TopBar::height);
        top.show();
        stage->onKey = [this] (const juce::KeyPress& k) { return top.snapshotKey (k) || canvas.keyPressed (k); };
        document.add (shown);
        canvas.onBreadcrumbs = [this] { top.show(); };
    }
    ~BarStage() override { document.remove (shown); }

    TopBar top { desk };
    struct Shown : Document::Listener
    {
        explicit Shown (TopBar& t) : bar (t) {}
        void documentChanged() override { bar.show(); }
        TopBar& bar;
    } shown { top };
};
}   // namespace

TEST_CASE ("the snapshots have a caption, which never covers the name of the graph", "[app][snapshots]")
{
    for (const int width : { 800, 960, 1024, 1280, 1920 })
        for (const auto* name : { "Dry wood", "A very long name of a graph that fills the bar up to the buttons on its right" })
        {
            BarStage rig (width);
            REQUIRE (rig.document.perform (graph::SetHeader { .name = name }));
            rig.top.show();
            const auto texts = tactus::host::test::readTexts (rig.top);
            const auto bar = rig.top.getLocalBounds().toFloat();
            INFO (width << ": " << name);
            CHECK (std::ranges::any_of (texts, [&] (const auto& t) { return t.text == "Snapshots" && bar.contains (t.place); }));
            CHECK (tactus::host::test::overlaps (texts, bar).isEmpty());
        }
}

TEST_CASE ("the snapshot whose values the graph has is lit", "[app][snapshots]")
{
    BarStage w;
    const auto lit = [&] {
        OnStage::settle();
        std::string numbers;
        for (int n = 1; n <= snapshot_count; ++n)
            if (const auto* slot = dynamic_cast<juce::Button*> (w.titled ("Snapshot " + juce::String (n))); slot != nullptr && slot->getToggleState())
                numbers += std::to_string (n);
        return numbers;
    };
    CHECK (lit().empty());
    w.key ("1");
    CHECK (w.status.text().contains ("empty"));
    w.key ("ctrl + 1");
    CHECK (lit() == "1");
    REQUIRE (w.document.perform (graph::SetParam { "", "drag", "mu", Json (0.9) }));
    CHECK (lit().empty());
    w.key ("ctrl + 2");
    CHECK (lit() == "2");
    w.key ("1");
    CHECK (lit() == "1");
    const auto colour = [&] (int n) {
        auto* slot = w.titled ("Snapshot " + juce::String (n));
        return slot->createComponentSnapshot (slot->getLocalBounds()).getPixelAt (6, slot->getHeight() / 2);
    };
    CHECK (colour (1) == themeOf (*w.stage).accent);
    CHECK (colour (2) != colour (1));
    CHECK (colour (2) != colour (3));
    auto turned = w.graph().controls[0];
    turned.value = 0.25;
    REQUIRE (w.document.perform (graph::ChangeControl { turned.id, turned }));
    CHECK (lit().empty());
    w.key ("ctrl + z");
    CHECK (lit() == "1");
}

TEST_CASE ("V switches between the first two snapshots of a file as long as none was recalled", "[app][snapshots]")
{
    BarStage w;
    const auto mu = [&] { return w.graph().root.find ("drag")->params.at ("mu").get<double>(); };
    const auto setMu = [&] (double to) { REQUIRE (w.document.perform (graph::SetParam { "", "drag", "mu", Json (to) })); };
    const auto compare = [&] {
        w.key ("v");
        OnStage::settle();
    };
    REQUIRE (w.document.perform (storeSnapshot (w.graph(), 2)));   // not by a key, as if it was in the file
    const double first = mu();
    compare();
    CHECK (w.status.text().contains ("Ctrl+1"));
    for (const auto& [number, value] : { std::pair { 4, 0.8 }, std::pair { 5, 0.7 } })
    {
        setMu (value);
        REQUIRE (w.document.perform (storeSnapshot (w.graph(), number)));
    }
    REQUIRE (first == 0.4);
    const double start = GENERATE (0.4, 0.8, 0.9);
    setMu (start);
    compare();
    CHECK (mu() == (start == first ? 0.8 : first));
    const double once = mu();
    compare();
    CHECK (mu() == (once == first ? 0.8 : first));
    compare();
    CHECK (mu() == once);
}

TEST_CASE ("a right click on a snapshot moves no value, and offers to recall, to overwrite and to clear it", "[app][snapshots]")
{
    BarStage w;
    const auto middle = [&] { return w.middleOf (*w.titled ("Snapshot 1")); };
    const auto mu = [&] { return w.graph().root.find ("drag")->params["mu"]; };
    w.choose (middle(), 1);   // the only entry of an empty one
    REQUIRE (hasSnapshot (w.graph(), 1));
    REQUIRE (w.document.perform (graph::SetParam { "", "drag", "mu", Json (0.9) }));
    w.choose (middle(), 1, juce::ModifierKeys::rightButtonModifier, "escape");
    CHECK (mu() == 0.9);
    w.choose (middle(), 2);
    CHECK (isAtSnapshot (w.graph(), 1));
    REQUIRE (w.document.perform (graph::SetParam { "", "drag", "mu", Json (0.4) }));
    w.choose (middle(), 1);
    CHECK (mu() == 0.9);
    w.choose (middle(), 3);
    CHECK_FALSE (hasSnapshot (w.graph(), 1));
    w.key ("ctrl + z");
    CHECK (hasSnapshot (w.graph(), 1));
}

TEST_CASE ("storing a snapshot can be undone", "[app][undo]")
{
    BarStage w;
    const auto text = writeGraph (w.graph());
    w.key ("ctrl + 3");
    REQUIRE (writeGraph (w.graph()) != text);
    w.key ("ctrl + z");
    CHECK (writeGraph (w.graph()) == text);
}

TEST_CASE ("an opened subgraph with several instances shows the values of the chosen one", "[app][keys]")
{
    BarStage w (1280, "two_fingers.json");
    std::string counted;
    for (const auto& n : w.graph().root.nodes)
        if (n.extra.contains ("count")) counted = n.name;
    REQUIRE_FALSE (counted.empty());
    auto& canvas = w.canvas;
    CHECK_FALSE (canvas.instance());
    for (const auto& n : canvas.scene().nodes())
        if (n.name == counted)
        {
            canvas.enter (n);
            break;
        }
    REQUIRE (canvas.instance());
    CHECK (canvas.instance()->number == 0);
    CHECK (canvas.address ("x.out") == counted + "[0]/x.out");
    CHECK (OnStage::buttonIn (*w.stage, "Instance [0] of " + juce::String (canvas.instance()->count)) != nullptr);
    canvas.chooseInstance (1);
    CHECK (canvas.address ("x.out") == counted + "[1]/x.out");
    CHECK (OnStage::buttonIn (*w.stage, "Instance [1] of " + juce::String (canvas.instance()->count)) != nullptr);
    canvas.chooseInstance (99);   // at most the last one
    CHECK (canvas.instance()->number == canvas.instance()->count - 1);
}

TEST_CASE ("a morph says before which knobs it takes the place of, and the keys of its snapshots move it", "[app][snapshots]")
{
    BarStage w;
    w.key ("ctrl + 1");
    auto turned = w.graph().controls[0];
    turned.value = 0.25;
    const bool has_turned = GENERATE (false, true);
    if (has_turned) REQUIRE (w.document.perform (graph::ChangeControl { turned.id, turned }));
    REQUIRE (w.document.perform (graph::SetParam { "", "board", "stiffness", Json ("3 N/mm") }));
    w.key ("ctrl + 2");
    const auto before = w.graph().controls.size();
    const auto morph = [&] { w.choose (w.middleOf (*w.titled ("Snapshot 1")), 4); };
    morph();
    CHECK (w.question.isOpen() == has_turned);
    CHECK (w.graph().controls.size() == before + (has_turned ? 0 : 1));
    if (! has_turned) return;
    CHECK (w.question.text().contains ("It takes the place of the knobs " + juce::String (turned.name)));
    w.click ("Cancel");
    CHECK (w.graph().controls[0].id == turned.id);
    morph();
    w.click ("Make the control");
    REQUIRE (w.graph().controls.size() == before);
    CHECK (w.graph().controls[0].to.size() == turned.to.size() + 1);
    CHECK (w.graph().controls[0].value == 0.0);
    w.key ("2");
    CHECK (w.graph().controls[0].value == 1.0);
    CHECK (w.status.text() == "Recalled snapshot 2.");
}

TEST_CASE ("a stored snapshot says that it holds no depths of modulation, if there are any", "[app][snapshots]")
{
    BarStage w;
    w.key ("ctrl + 1");
    CHECK (w.status.text() == "Stored snapshot 1. Press 1 to recall it.");
    graph::Node wave;
    wave.name = "wave";
    wave.type = "signal.lfo";
    REQUIRE (w.document.perform (graph::AddNode { "", wave }));
    graph::Wire depth;
    depth.from = { .node = "wave", .port = "out" };
    depth.to = { .node = "drag", .port = "mu" };
    depth.add = true;
    REQUIRE (w.document.perform (graph::AddWire { "", depth }));
    w.key ("ctrl + 2");
    CHECK (w.status.text() == "Stored snapshot 2. Press 2 to recall it. It does not hold the depths of modulation.");
}
