// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/window_rig.hpp"

#include <host/app/inspector/blocks/number_field.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::latestStep;
using tactus::host::test::WindowRig;

namespace
{
juce::Component* firstTextEditor (juce::Component& c)
{
    if (dynamic_cast<juce::TextEditor*> (&c) != nullptr && c.isVisible()) return &c;
    for (auto* child : c.getChildren())
        if (auto* e = firstTextEditor (*child)) return e;
    return nullptr;
}
}   // namespace

TEST_CASE ("every parameter is reached from the canvas with the keyboard alone, and Esc leads back", "[app][keys]")
{
    WindowRig w ("dry_wood.json");
    auto& canvas = w.view->canvas();
    canvas.grabKeyboardFocus();
    canvas.select ({});
    w.key ("ctrl + cursor right");
    REQUIRE (canvas.selection().size() == 1);
    canvas.select ({ w.graph().root.find ("drag")->id });

    w.key ("return");
    auto* field = dynamic_cast<NumberField*> (WindowRig::focused());
    REQUIRE (field != nullptr);
    CHECK (w.view->part<Inspector>().isParentOf (field));

    // Tab goes through all fields of the node, and opens nothing.
    std::set<std::string> titles;
    for (int i = 0; i < 60; ++i)
    {
        if (auto* f = dynamic_cast<NumberField*> (WindowRig::focused())) titles.insert (f->getTitle().toStdString());
        w.key ("tab");
        REQUIRE (w.view->part<Inspector>().hasKeyboardFocus (true));
    }
    for (const char* param : { "d max", "Static ratio", "Stiffness" })
        CHECK (titles.contains (param));

    for (int i = 0; i < 60 && WindowRig::focused()->getTitle() != "Stiffness"; ++i)
        w.key ("tab");
    REQUIRE (WindowRig::focused()->getTitle() == "Stiffness");
    w.key ("return");
    REQUIRE (firstTextEditor (w.view->part<Inspector>()) != nullptr);
    w.stage->type ("2 kN/m");
    w.key ("return");
    CHECK (w.graph().root.find ("drag")->params["stiffness"] == "2 kN/m");
    CHECK (latestStep (w.view->document()) == "drag: Stiffness 0 N/m -> 2 kN/m");

    w.key ("escape");
    CHECK (canvas.hasKeyboardFocus (true));
    CHECK (canvas.selection() == tactus::host::Selection { w.graph().root.find ("drag")->id });
}

TEST_CASE ("a field that gets the focus is scrolled into view", "[app][keys]")
{
    WindowRig w ("dry_wood.json", 1024, 420);
    auto& canvas = w.view->canvas();
    canvas.grabKeyboardFocus();
    canvas.select ({ w.graph().root.find ("drag")->id });
    w.key ("return");
    for (int i = 0; i < 30; ++i)
    {
        w.key ("tab");
        const auto* now = WindowRig::focused();
        REQUIRE (now != nullptr);
        const auto place = w.view->part<Inspector>().getLocalArea (now, now->getLocalBounds());
        INFO (now->getTitle());
        CHECK (w.view->part<Inspector>().getLocalBounds().contains (place.getCentre()));
    }
}

TEST_CASE ("a name that is refused stays in its field, so that the next keys are no shortcuts", "[app][keys]")
{
    WindowRig w ("dry_wood.json");
    w.view->canvas().select ({ w.graph().root.find ("drag")->id });
    WindowRig::settle();
    auto* name = dynamic_cast<juce::TextEditor*> (w.titled ("Name of the node"));
    REQUIRE (name != nullptr);
    w.stage->click (w.middleOf (*name));
    w.stage->type ("2 Wood grips");
    w.key ("return");
    CHECK (name->hasKeyboardFocus (true));
    CHECK (name->getText() == "2 Wood grips");
    CHECK (w.graph().root.find ("drag") != nullptr);
    w.stage->type ("wood_grip");   // the refused name is selected
    w.key ("return");
    CHECK (w.graph().root.find ("wood_grip") != nullptr);
    CHECK (w.view->canvas().hasKeyboardFocus (true));

    w.stage->click (w.middleOf (*w.titled ("Name of the node")));
    w.stage->type ("2 bad names");
    w.key ("return");
    w.key ("escape");
    CHECK (dynamic_cast<juce::TextEditor*> (w.titled ("Name of the node"))->getText() == "wood_grip");
    CHECK (w.view->canvas().hasKeyboardFocus (true));
}

TEST_CASE ("a click beside the fields of the inspector leaves the keyboard to the canvas", "[app][keys]")
{
    WindowRig w ("dry_wood.json");
    auto& canvas = w.view->canvas();
    canvas.grabKeyboardFocus();
    for (const bool has_node : { true, false })
    {
        canvas.select (has_node ? Selection { w.graph().root.find ("drag")->id } : Selection {});
        WindowRig::settle();
        const auto area = w.stage->getLocalArea (&w.view->part<Inspector>(), w.view->part<Inspector>().getLocalBounds());
        const auto& knobs = w.view->part<Inspector>().knobs();
        for (int y = area.getY() + 4; y < area.getBottom() - (knobs.isVisible() ? knobs.getHeight() : 0); y += 8)
        {
            INFO (y);
            w.stage->click (juce::Point<int> (area.getX() + 4, y).toFloat());
            CHECK (canvas.hasKeyboardFocus (true));
        }
    }
}

TEST_CASE ("the controls of a graph stay in reach as knobs while a node is selected", "[app][keys]")
{
    WindowRig w ("bronze_bell.json");
    auto& knobs = w.view->part<Inspector>().knobs();
    w.view->canvas().select ({});
    CHECK_FALSE (knobs.isVisible());
    w.view->canvas().select ({ w.graph().root.find ("wall")->id });
    REQUIRE (knobs.isVisible());
    REQUIRE (knobs.size() == 4);
    const auto before = w.view->document().history().position();
    const auto middle = [&] (std::size_t i) { return w.stage->getLocalPoint (&knobs.knob (i), knobs.knob (i).getLocalBounds().getCentre()).toFloat(); };
    w.stage->drag (middle (0), middle (0).translated (0, -40));
    CHECK (w.graph().controls[0].value > 0.65);
    CHECK (w.view->document().history().position() == before + 1);   // one step for the whole drag
    CHECK (latestStep (w.view->document()).starts_with ("Blow 0.60 -> "));
    w.view->document().undo();
    CHECK (knobs.knob (0).getValue() == Approx (0.6));
    knobs.knob (1).grabKeyboardFocus();
    w.key ("cursor up");
    CHECK (w.graph().controls[1].value == Approx (0.51));
}

TEST_CASE ("an opened subgraph with several instances shows the values of the chosen one", "[app][keys]")
{
    WindowRig w ("two_fingers.json");
    std::string counted;
    for (const auto& n : w.graph().root.nodes)
        if (n.extra.contains ("count")) counted = n.name;
    REQUIRE_FALSE (counted.empty());
    auto& canvas = w.view->canvas();
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
    CHECK (WindowRig::buttonIn (*w.view, "Instance [0] of " + juce::String (canvas.instance()->count)) != nullptr);
    canvas.chooseInstance (1);
    CHECK (canvas.address ("x.out") == counted + "[1]/x.out");
    CHECK (WindowRig::buttonIn (*w.view, "Instance [1] of " + juce::String (canvas.instance()->count)) != nullptr);
    canvas.chooseInstance (99);   // at most the last one
    CHECK (canvas.instance()->number == canvas.instance()->count - 1);
}

TEST_CASE ("a click on a tab shows its panel, and leaves the keyboard to the canvas", "[app][keyboard]")
{
    WindowRig w ("dry_wood.json");
    w.view->canvas().grabKeyboardFocus();
    for (const char* tab : { "History", "Presets", "Take", "Devices", "Layers", "Problems", "Scopes" })
    {
        INFO (tab);
        w.click (tab);
        CHECK (WindowRig::focused() == &w.view->canvas());
    }
}
