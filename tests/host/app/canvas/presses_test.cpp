// SPDX-License-Identifier: GPL-3.0-or-later
// Presses of the mouse that last, and what ends them.
#include "host/app/support/desk_stage.hpp"

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskStage;
using tactus::host::test::OnStage;

TEST_CASE ("a right press opens the menu however long it is held, and moves the canvas if the mouse moves", "[app][mouse]")
{
    DeskStage w ("dry_wood.json");
    auto& canvas = w.canvas;
    const auto& node = canvas.scene().nodes().front();
    const auto at = w.stage->getLocalPoint (&canvas, canvas.view().toPixels (node.bounds().getCentre()));
    const auto open = [] { return juce::Component::getNumCurrentlyModalComponents(); };
    w.stage->move (at);
    w.stage->press (juce::ModifierKeys::rightButtonModifier);
    w.stage->hold();
    w.stage->release();
    for (int i = 0; i < 100 && open() == 0; ++i)
        OnStage::settle (1);
    CHECK (open() == 1);
    CHECK (canvas.selection() == Selection { node.id });
    w.key ("escape");
    OnStage::settle();
    REQUIRE (open() == 0);

    const auto before = canvas.view().toPixels ({});
    w.stage->drag (at, at.translated (60.0f, 0.0f), juce::ModifierKeys::rightButtonModifier);
    OnStage::settle();
    CHECK (open() == 0);
    CHECK (canvas.view().toPixels ({}).x == Approx (before.x + 60.0f).margin (2.0));
}

TEST_CASE ("Ctrl+Z during a drag ends the drag, and the drag replaces no step that can be redone", "[app][mouse]")
{
    DeskStage w ("dry_wood.json");
    auto& document = w.document;
    const auto mu = [&] { return document.graph().root.find ("drag")->params["mu"]; };
    REQUIRE (document.perform (graph::SetParam { {}, "drag", "mu", Json (0.9) }));
    OnStage::settle();
    const auto steps = document.history().position();
    auto& canvas = w.canvas;
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
    w.canvas.keyPressed (juce::KeyPress::createFromDescription ("ctrl + z"));
    CHECK (document.history().position() == steps);
    juce::ModifierKeys::currentModifiers = before;
    w.canvas.keyPressed (juce::KeyPress::createFromDescription ("ctrl + z"));
    CHECK (document.history().position() == steps - 1);
}
