// SPDX-License-Identifier: GPL-3.0-or-later
// Presses of the mouse that last, and presses where there is nothing to feel yet.
#include "host/app/support/seen_text.hpp"
#include "host/app/support/wait_for.hpp"
#include "host/app/support/window_rig.hpp"

#include <tactus/file/graph_file.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::waitFor;
using tactus::host::test::WindowRig;

namespace
{
bool showsText (juce::Component& in, const juce::String& text)
{
    return std::ranges::any_of (tactus::host::test::readTexts (in), [&] (const auto& t) { return t.text == text; });
}
}   // namespace

TEST_CASE ("a right press opens the menu however long it is held, and moves the canvas if the mouse moves", "[app][mouse]")
{
    WindowRig w ("dry_wood.json");
    auto& canvas = w.view->canvas();
    const auto& node = canvas.scene().nodes().front();
    const auto at = w.stage->getLocalPoint (&canvas, canvas.view().toPixels (node.bounds().getCentre()));
    const auto open = [] { return juce::Component::getNumCurrentlyModalComponents(); };
    w.stage->move (at);
    w.stage->press (juce::ModifierKeys::rightButtonModifier);
    w.stage->hold();
    w.stage->release();
    for (int i = 0; i < 100 && open() == 0; ++i)
        WindowRig::settle (1);
    CHECK (open() == 1);
    CHECK (canvas.selection() == Selection { node.id });
    w.key ("escape");
    WindowRig::settle();
    REQUIRE (open() == 0);

    const auto before = canvas.view().toPixels ({});
    w.stage->drag (at, at.translated (60.0f, 0.0f), juce::ModifierKeys::rightButtonModifier);
    WindowRig::settle();
    CHECK (open() == 0);
    CHECK (canvas.view().toPixels ({}).x == Approx (before.x + 60.0f).margin (2.0));
}

TEST_CASE ("a slow click on a problem shows its node", "[app][mouse][problems]")
{
    WindowRig w ("dry_wood.json");
    REQUIRE (w.view->document().perform (graph::SetParam { {}, "drag", "mu", Json ("many") }));
    WindowRig::settle (100);
    w.view->canvas().select ({});
    const auto tab = WindowRig::tabIn (*w.view, *w.stage, "Problems 1");
    REQUIRE (tab);
    w.stage->click (*tab);
    WindowRig::settle();
    auto* list = w.titled ("Problems");
    REQUIRE (list != nullptr);
    w.stage->move (w.stage->getLocalPoint (list, juce::Point<float> (60.0f, 24.0f)));
    w.stage->press();
    w.stage->hold();
    w.stage->release();
    WindowRig::settle();
    CHECK (w.view->canvas().selection() == Selection { w.graph().root.find ("drag")->id });
}

TEST_CASE ("pressing the surface before there is a graph starts nothing", "[app][mouse]")
{
    WindowRig w ({}, 1280, 720, false);
    REQUIRE (w.view->part<WelcomePage>().isVisible());
    auto* surface = w.titled ("Surface");
    REQUIRE (surface != nullptr);
    const auto at = w.middleOf (*surface);
    w.stage->drag (at, at.translated (30.0f, 0.0f));
    WindowRig::settle (100);
    CHECK_FALSE (w.view->run().isWanted());
    CHECK (w.view->part<WelcomePage>().isVisible());
    CHECK (showsText (*w.titled ("Hand"), "Nothing to feel yet: choose a preset, or add a node."));

    w.click ("Dry wood");
    w.stage->drag (at, at.translated (30.0f, 0.0f));
    WindowRig::settle();
    CHECK (w.view->run().isWanted());
    w.view->run().letGo();
}

TEST_CASE ("what is selected counts the wires between the nodes", "[app][inspector]")
{
    WindowRig w ("dry_wood.json");
    auto& canvas = w.view->canvas();
    w.key ("ctrl + a");
    WindowRig::settle();
    const auto& root = w.graph().root;
    CHECK (showsText (w.view->part<Inspector>(), juce::String (root.nodes.size()) + " nodes, " + juce::String (root.wires.size()) + " wires"));
    const auto from = root.find (root.wires.front().from.node)->id, to = root.find (root.wires.front().to.node)->id;
    const auto between = std::ranges::count_if (root.wires, [&] (const graph::Wire& v) {
        const std::set<graph::Id> ends { root.find (v.from.node)->id, root.find (v.to.node)->id };
        return std::ranges::includes (std::set { from, to }, ends);
    });
    canvas.select ({ from, to });
    WindowRig::settle();
    const auto wires = [&] (auto count) { return "2 nodes, " + juce::String (static_cast<int> (count)) + " wires"; };
    CHECK (showsText (w.view->part<Inspector>(), wires (between)));
    const auto& other = *std::ranges::find_if (root.wires, [&] (const graph::Wire& v) { return root.find (v.from.node)->id != from; });
    canvas.select ({ from, to, other.id });
    WindowRig::settle();
    CHECK (showsText (w.view->part<Inspector>(), wires (between + 1)));
    REQUIRE (w.view->document().perform (graph::RemoveWire { {}, other.id }));
    WindowRig::settle();
    CHECK (showsText (w.view->part<Inspector>(), wires (between)));
}

TEST_CASE ("Esc during a drag puts the node back, and stops the forces", "[app][mouse][safety]")
{
    WindowRig w ("dry_wood.json", 1280, 720, false);
    auto& run = w.view->run();
    REQUIRE (run.isWanted());
    auto& canvas = w.view->canvas();
    const auto node = [&]() -> const SceneNode& { return *std::ranges::find (canvas.scene().nodes(), "grain", &SceneNode::name); };
    const auto place = node().at;
    const auto steps = w.view->document().history().position();
    const auto at = w.stage->getLocalPoint (&canvas, canvas.view().toPixels (place + juce::Point<float> (40.0f, 14.0f)));
    w.stage->hold();
    w.stage->move (at);
    w.stage->press();
    w.stage->move (at.translated (30.0f, 20.0f));
    w.stage->move (at.translated (60.0f, 40.0f));
    REQUIRE (node().at != place);
    w.key ("escape");
    CHECK (node().at == place);
    CHECK (w.view->document().history().position() == steps);
    CHECK_FALSE (run.isWanted());
    w.stage->move (at.translated (90.0f, 60.0f));
    w.stage->release();
    CHECK (node().at == place);
    run.letGo();
}

TEST_CASE ("Ctrl+Z during a drag ends the drag, and the drag replaces no step that can be redone", "[app][mouse]")
{
    WindowRig w ("dry_wood.json");
    auto& document = w.view->document();
    const auto mu = [&] { return document.graph().root.find ("drag")->params["mu"]; };
    REQUIRE (document.perform (graph::SetParam { {}, "drag", "mu", Json (0.9) }));
    WindowRig::settle();
    const auto steps = document.history().position();
    auto& canvas = w.view->canvas();
    const auto node = [&]() -> const SceneNode& { return *std::ranges::find (canvas.scene().nodes(), "grain", &SceneNode::name); };
    const auto place = node().at;
    const auto at = w.stage->getLocalPoint (&canvas, canvas.view().toPixels (place + juce::Point<float> (40.0f, 14.0f)));
    w.stage->move (at);
    w.stage->press();
    w.stage->move (at.translated (30.0f, 20.0f));
    w.stage->move (at.translated (60.0f, 40.0f));
    REQUIRE (node().at != place);
    w.key ("ctrl + z");
    CHECK (node().at == place);
    w.stage->move (at.translated (90.0f, 60.0f));
    w.stage->release();
    CHECK (node().at == place);
    CHECK (document.history().position() == steps);
    CHECK (mu() == Json (0.9));

    // While a button is down elsewhere, such as in a field that is dragged.
    const auto before = juce::ModifierKeys::currentModifiers;
    juce::ModifierKeys::currentModifiers = before.withFlags (juce::ModifierKeys::leftButtonModifier);
    w.view->canvas().keyPressed (juce::KeyPress::createFromDescription ("ctrl + z"));
    CHECK (document.history().position() == steps);
    juce::ModifierKeys::currentModifiers = before;
    w.view->canvas().keyPressed (juce::KeyPress::createFromDescription ("ctrl + z"));
    CHECK (document.history().position() == steps - 1);
}

TEST_CASE ("a tool that H holds is let go when another graph opens", "[app][mouse]")
{
    WindowRig w ("dry_wood.json", 1280, 720, false);
    auto* surface = w.titled ("Surface");
    REQUIRE (surface != nullptr);
    w.stage->move (w.middleOf (*surface));
    w.stage->press();
    WindowRig::settle (200);
    w.key ("h");
    w.stage->release();
    WindowRig::settle (100);
    REQUIRE (w.view->part<HandPanel>().view().isHeld());
    w.view->document().open (loadGraph (TACTUS_SOURCE_DIR "/graphs/bronze_bell.json").graph, {}, "open Bronze bell");
    WindowRig::settle (100);
    CHECK_FALSE (w.view->part<HandPanel>().view().isHeld());
    w.view->run().letGo();
}

TEST_CASE ("a drag ends when another program gets the keyboard, because the window may not hear of the release", "[app][mouse][hand]")
{
    WindowRig w ("dry_wood.json");
    auto& run = w.view->run();
    auto* surface = w.titled ("Surface");
    REQUIRE (surface != nullptr);
    const auto at = w.middleOf (*surface);
    w.stage->move (at);
    w.stage->press();
    w.stage->move (at.translated (5.0f, 0.0f));
    REQUIRE (waitFor ([&] { return run.isRunning() && run.tool() && run.tool()->position.z() < 0.0; }));
    w.stage->loseKeyboard();
    WindowRig::settle();
    CHECK (waitFor ([&] { return run.tool() && run.tool()->position.z() > 0.0; }));

    // Nor does a drag on the canvas go on.
    w.stage->release();
    w.stage->regainKeyboard();
    auto& canvas = w.view->canvas();
    const auto& board = *std::ranges::find (canvas.scene().nodes(), "board", &SceneNode::name);
    const auto header = w.stage->getLocalPoint (&canvas, canvas.view().toPixels (board.bounds().getCentre().withY (board.bounds().getY() + 8.0f)));
    w.stage->move (header);
    w.stage->press();
    w.stage->loseKeyboard();
    WindowRig::settle();
    const auto before = w.view->document().history().position();
    w.stage->move (header.translated (40.0f, 40.0f));
    CHECK (w.view->document().history().position() == before);
    w.stage->release();
}
