// SPDX-License-Identifier: GPL-3.0-or-later
// The mouse: presses that last, presses where there is nothing to feel yet, and clicks by another button than the left one, which change nothing.
#include "host/app/support/seen_text.hpp"
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

void forButtons (juce::Component& in, const std::function<void (juce::Button&)>& f)
{
    if (auto* b = dynamic_cast<juce::Button*> (&in); b != nullptr && b->isShowing()) f (*b);
    for (auto* child : in.getChildren())
        forButtons (*child, f);
}
}   // namespace

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

TEST_CASE ("a right or middle click on any button changes nothing, except that any click on STOP stops", "[app][click]")
{
    for (const int button : { juce::ModifierKeys::rightButtonModifier, juce::ModifierKeys::middleButtonModifier })
    {
        WindowRig w ("dry_wood.json");
        w.key ("ctrl + 1");
        REQUIRE (w.view->document().perform (graph::SetParam { "", "drag", "mu", Json (0.9) }));
        WindowRig::settle();
        const auto text = [&] { return writeGraph (w.graph()); };
        const auto before = text();
        const auto running = w.view->run().isRunning();
        std::vector<juce::Component::SafePointer<juce::Button>> all;
        forButtons (*w.view, [&] (juce::Button& b) { all.emplace_back (&b); });
        REQUIRE (all.size() > 20);
        for (const auto& b : all)
        {
            if (b == nullptr || ! b->isShowing() || b->getButtonText() == "STOP") continue;
            INFO (b->getButtonText() << " " << b->getTitle());
            w.stage->click (w.middleOf (*b), button);
            juce::PopupMenu::dismissAllActiveMenus();
            WindowRig::settle();
            CHECK (text() == before);
            CHECK (w.view->run().isRunning() == running);
        }
    }
}

TEST_CASE ("a right or middle click on a preset opens and runs nothing", "[app][click]")
{
    WindowRig w ("dry_wood.json");
    auto* search = w.titled ("Search presets");
    REQUIRE (search != nullptr);
    const auto below = w.stage->getLocalPoint (search, juce::Point<int> (40, search->getHeight()));
    for (int y = below.y + 8; y < below.y + 300; y += 12)
        for (const int button : { juce::ModifierKeys::rightButtonModifier, juce::ModifierKeys::middleButtonModifier })
        {
            w.stage->click (juce::Point<int> (below.x, y).toFloat(), button);
            WindowRig::settle();
            CHECK (w.graph().name == "Dry wood");
        }
    bool opens = false;   // what a left click there does
    for (int y = below.y + 8; y < below.y + 300 && ! opens; y += 12)
    {
        w.stage->click (juce::Point<int> (below.x, y).toFloat());
        WindowRig::settle();
        opens = w.graph().name != "Dry wood";
    }
    CHECK (opens);
}
