// SPDX-License-Identifier: GPL-3.0-or-later
// Undo takes back what was done to the window too, and never touches the graph for it. The history says what was done.
#include "host/app/support/window_rig.hpp"

#include <host/app/scopes/scope_panel.hpp>

#include <tactus/file/graph_file.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::latestStep;
using tactus::host::test::WindowRig;

namespace
{
std::vector<juce::Rectangle<int>> scopes (WindowRig& w)
{
    std::vector<juce::Rectangle<int>> all;
    auto* panel = dynamic_cast<ScopePanel*> (w.titled ("Scopes"));
    REQUIRE (panel != nullptr);
    for (const auto& v : panel->shown())
        all.push_back (v->getBounds());
    return all;
}

void undoAndRedo (WindowRig& w, const std::function<bool()>& isDone)
{
    const auto text = writeGraph (w.graph());
    const bool was_changed = w.view->document().isChanged();
    REQUIRE (isDone());
    for (int i = 0; i < 2; ++i)
    {
        w.key ("ctrl + z");
        CHECK_FALSE (isDone());
        CHECK (writeGraph (w.graph()) == text);
        w.key ("ctrl + y");
        CHECK (isDone());
        CHECK (writeGraph (w.graph()) == text);
    }
    CHECK (w.view->document().isChanged() == was_changed);
}
}   // namespace

TEST_CASE ("closing, moving and sizing scopes, and moving panels, are steps that can be undone", "[app][undo]")
{
    WindowRig w ("dry_wood.json", 1600, 900);
    const auto settled = [&] { WindowRig::settle (60); };
    const auto before = scopes (w);
    REQUIRE (before.size() >= 2);
    auto* panel = dynamic_cast<ScopePanel*> (w.titled ("Scopes"));
    w.view->canvas().grabKeyboardFocus();

    auto* edge = WindowRig::titledIn (*panel, "Edge between scopes");
    REQUIRE (edge != nullptr);
    w.stage->drag (w.middleOf (*edge), w.middleOf (*edge).translated (60.0f, 0.0f));
    settled();
    undoAndRedo (w, [&] { return std::abs (scopes (w)[0].getWidth() - before[0].getWidth() - 60) <= 2; });
    CHECK (latestStep (w.view->document()) == "size scopes");

    const auto first = panel->shown()[0]->shown().kind;
    const auto title = w.stage->getLocalPoint (panel->shown()[0].get(), juce::Point<float> (20.0f, 12.0f));
    w.stage->drag (title, w.middleOf (*panel->shown()[1]));
    settled();
    undoAndRedo (w, [&] { return panel->shown()[1]->shown().kind == first; });

    auto* cross = WindowRig::titledIn (*panel->shown()[0], "Close this scope");
    REQUIRE (cross != nullptr);
    w.stage->click (w.middleOf (*cross));
    settled();
    undoAndRedo (w, [&] { return scopes (w).size() == before.size() - 1; });
    CHECK (latestStep (w.view->document()) == "close scope");

    const auto width = w.view->canvas().getWidth();
    for (auto* child : w.view->getChildren())
        if (child->getTitle() == "Panel edge" && child->getX() < 400 && child->getHeight() > child->getWidth())
        {
            w.stage->drag (w.middleOf (*child), w.middleOf (*child).translated (50.0f, 0.0f));
            break;
        }
    settled();
    undoAndRedo (w, [&] { return std::abs (w.view->canvas().getWidth() - (width - 50)) <= 1; });
    CHECK (latestStep (w.view->document()) == "move panels");
    w.key ("z");
    undoAndRedo (w, [&] { return w.view->canvas().getWidth() > width + 100; });
}

TEST_CASE ("storing a snapshot can be undone", "[app][undo]")
{
    WindowRig w ("dry_wood.json");
    w.view->canvas().grabKeyboardFocus();
    const auto text = writeGraph (w.graph());
    w.key ("ctrl + 3");
    REQUIRE (writeGraph (w.graph()) != text);
    w.key ("ctrl + z");
    CHECK (writeGraph (w.graph()) == text);
}

TEST_CASE ("moving a wire to another port is one step, and the history names wires and nodes", "[app][undo]")
{
    WindowRig w ("layered_cloth.json", 1600, 900);
    auto& canvas = w.view->canvas();
    auto& document = w.view->document();
    canvas.grabKeyboardFocus();
    canvas.frameAll();
    const auto port = [&] (const std::string& node, Role role, const std::string& id) {
        for (const auto& n : canvas.scene().nodes())
            if (n.name == node) return w.stage->getLocalPoint (&canvas, canvas.view().toPixels (n.placeOf (*n.box.find (role, id))));
        FAIL ("no node " << node);
        return juce::Point<float>();
    };
    const auto texts = [&] {
        std::vector<std::string> all;
        for (const auto& wire : canvas.scene().wires())
            all.push_back (wire.text);
        return all;
    };
    const auto before = writeGraph (w.graph());
    const auto position = document.history().position();
    w.stage->drag (port ("table", Role::input, "position"), port ("threads", Role::input, "position"), juce::ModifierKeys::leftButtonModifier,
                   juce::ModifierKeys::shiftModifier);
    WindowRig::settle();
    CHECK (document.history().position() <= position + 1);
    w.stage->drag (port ("drag", Role::input, "position"), port ("table", Role::input, "position"), juce::ModifierKeys::leftButtonModifier,
                   juce::ModifierKeys::shiftModifier);
    WindowRig::settle();
    CHECK (std::ranges::count (texts(), "hand.position -> drag.position") == 0);
    CHECK (std::ranges::count (texts(), "hand.position -> table.position") == 1);
    CHECK (latestStep (document) == "re-plug wire hand.position -> table.position");
    document.goTo (position);
    CHECK (writeGraph (w.graph()) == before);

    // Back where it was: not a step.
    w.stage->drag (port ("drag", Role::input, "position"), port ("drag", Role::input, "position").translated (2.0f, 2.0f),
                   juce::ModifierKeys::leftButtonModifier, juce::ModifierKeys::shiftModifier);
    CHECK (document.history().position() == position);

    canvas.select ({ w.graph().root.find ("touch")->id });
    w.key ("delete");
    CHECK (latestStep (document) == "delete touch");
    w.key ("ctrl + z");
    w.stage->drag (port ("table", Role::output, "force"), port ("felt", Role::input, "in"));
    WindowRig::settle();
    CHECK (latestStep (document) == "table.force -> felt.in");
}
