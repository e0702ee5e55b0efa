// SPDX-License-Identifier: GPL-3.0-or-later
// The keyboard is never lost: after everything that takes it for a while, the keys of the canvas work again. With the palette or a menu open, Esc stops the
// run first.
#include "host/app/support/window_rig.hpp"

#include <host/app/inspector/blocks/number_field.hpp>
#include <host/app/take/take_panel.hpp>
#include <tactus/file/graph_file.hpp>

#include <set>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::latestStep;
using tactus::host::test::waitFor;
using tactus::host::test::WindowRig;

namespace
{
/// A window with a graph that may be saved.
struct GraphDesk
{
    TemporaryFolder folder;
    std::filesystem::path file = folder / "mine.json";
    std::unique_ptr<WindowRig> w;

    GraphDesk()
    {
        std::filesystem::copy_file (TACTUS_SOURCE_DIR "/graphs/dry_wood.json", file);
        w = std::make_unique<WindowRig> (file.string(), 1280, 1000);   // the row of a parameter is in view
    }

    Document& document() { return w->view->document(); }

    /// Ctrl+S saves, the space bar opens the palette, Esc closes it, and Ctrl+Z undoes.
    void checkKeys (const std::string& after)
    {
        INFO ("after " << after);
        WindowRig::settle();
        CHECK (WindowRig::focused() == &w->view->canvas());
        document().perform (graph::SetHeader { .about = after });
        REQUIRE (document().isChanged());
        w->key ("ctrl + s");
        CHECK_FALSE (document().isChanged());
        CHECK (loadGraph (file).graph.about == after);
        w->key ("spacebar");
        CHECK (w->titled ("Palette") != nullptr);
        w->key ("escape");
        CHECK (w->titled ("Palette") == nullptr);
        const auto position = document().history().position();
        w->key ("ctrl + z");
        CHECK (document().history().position() == position - 1);
    }

    void select (const std::string& node) { w->view->canvas().select ({ w->graph().root.find (node)->id }); }
};

/// Opens a menu by a click, calls f with it, and closes it.
template <typename F>
void withMenu (WindowRig& w, juce::Component& at, int button, F f)
{
    const auto open = [&] { w.stage->click (w.middleOf (at), button); };
    WindowRig::withMenu (open, [&] (juce::Component& menu) {
        f (menu);
        juce::PopupMenu::dismissAllActiveMenus();
    });
}

juce::Component* firstTextEditor (juce::Component& c)
{
    if (dynamic_cast<juce::TextEditor*> (&c) != nullptr && c.isVisible()) return &c;
    for (auto* child : c.getChildren())
        if (auto* e = firstTextEditor (*child)) return e;
    return nullptr;
}
}   // namespace

TEST_CASE ("after a menu, a name, a dialog and a start, the keys of the canvas work", "[app][keyboard]")
{
    GraphDesk d;
    auto& w = *d.w;
    w.stage->grabKeyboardFocus();   // as the window system does when it shows the window
    d.checkKeys ("a start with a file");

    d.select ("drag");
    const auto controls = w.graph().controls.size();
    w.choose (w.middleOf (*w.titled ("Stiffness")), 1);
    REQUIRE (w.graph().controls.size() == controls + 1);
    REQUIRE (dynamic_cast<juce::TextEditor*> (WindowRig::focused()) != nullptr);   // for its name
    w.key ("return");
    d.checkKeys ("New control");
    w.key ("ctrl + z");
    d.checkKeys ("New control and Ctrl+Z");

    w.view->canvas().select ({});
    w.clickTitled ("Name of the control");
    w.stage->type ("Drape");
    w.key ("return");
    CHECK (w.graph().controls[0].name.find ("Drape") != std::string::npos);
    d.checkKeys ("a control was renamed");

    d.select ("drag");
    w.clickTitled ("Name of the node");
    w.key ("ctrl + a");
    w.stage->type ("scrub");
    w.key ("return");
    REQUIRE (w.graph().root.find ("scrub") != nullptr);
    d.checkKeys ("a node was renamed");

    for (const char* end : { "escape", "return" })
    {
        auto* more = w.titled ("Menu");
        REQUIRE (more != nullptr);
        w.choose (w.middleOf (*more), 14, juce::ModifierKeys::leftButtonModifier, end);   // the theme
        d.checkKeys (std::string ("the menu of the window, ") + end);
    }

    w.view->canvas().select ({});
    w.key ("F1");
    w.key ("escape");
    d.checkKeys ("the help");

    d.document().perform (graph::SetHeader { .about = "changed" });
    w.key ("ctrl + n");
    REQUIRE (w.view->asked().isOpen());
    w.key ("escape");
    d.checkKeys ("a question");

    w.choose (w.onStage (w.view->canvas().scene().nodes().front().bounds().getCentre()), 0, juce::ModifierKeys::rightButtonModifier, "escape");
    d.checkKeys ("the menu of a node");

    d.select ("scrub");
    WindowRig::useMenu (
        *w.stage, [&] { w.stage->key ("shift + F10"); }, 0, "escape");
    d.checkKeys ("the menu that a key opens");

    // If a field is deleted while it has the keyboard, the component next to it does not get it.
    d.select ("scrub");
    w.key ("return");
    REQUIRE (w.view->part<Inspector>().hasKeyboardFocus (true));
    d.document().perform (graph::RemoveNode { {}, "scrub" });
    d.checkKeys ("the node of a focused field was deleted");

    w.click ("Presets");
    w.key ("ctrl + f");
    REQUIRE (w.titled ("Search presets")->hasKeyboardFocus (true));
    w.click ("History");
    d.checkKeys ("the panel of a focused field was hidden");
}

TEST_CASE ("another program gets the keyboard while the palette is open, and keeps it until the user comes back", "[app][keyboard]")
{
    GraphDesk d;
    auto& w = *d.w;
    w.stage->grabKeyboardFocus();
    d.select ("drag");
    WindowRig::settle();
    for (const char* keys : { "spacebar", "ctrl + k" })
    {
        INFO (keys);
        w.key (keys);
        REQUIRE (w.titled ("Palette") != nullptr);
        w.stage->loseKeyboard();
        WindowRig::settle();
        CHECK (w.titled ("Palette") == nullptr);
        CHECK_FALSE (w.stage->hasKeyboard());   // else, a B for the other program would bypass the node
        CHECK (WindowRig::focused() == nullptr);
        w.stage->regainKeyboard();
        d.checkKeys (std::string ("another program, ") + keys);
    }
}

TEST_CASE ("the keyboard alone leads from the welcome page to a force, and through all panels", "[app][keyboard]")
{
    WindowRig w ({}, 1280, 720, false);
    const auto& cards = w.view->part<WelcomePage>().cards();
    REQUIRE (cards.size() == 6);
    const auto isOn = [&] (std::size_t card) { return WindowRig::focused() != nullptr && WindowRig::focused()->getName() == juce::String (cards[card].name); };
    CHECK (isOn (0));
    w.key ("cursor down");
    CHECK (isOn (3));
    w.key ("cursor right");
    CHECK (isOn (4));
    w.key ("tab");
    CHECK (isOn (5));
    w.key ("cursor left");
    w.key ("cursor up");
    w.key ("cursor left");
    REQUIRE (isOn (0));
    w.key ("return");
    CHECK (w.graph().name == cards[0].name);
    CHECK (waitFor ([&] { return w.view->run().tool() && w.view->run().tool()->force.norm() > 0.1; }));
    CHECK (WindowRig::focused() == &w.view->canvas());

    w.view->run().letGo();
    REQUIRE_FALSE (w.view->run().isWanted());
    w.key ("F5");
    CHECK (w.view->run().isWanted());
    w.view->run().letGo();

    std::vector<juce::Component*> visited;
    for (int i = 0; i < 5; ++i)
    {
        w.key ("F6");
        REQUIRE (WindowRig::focused() != nullptr);
        CHECK (std::ranges::count (visited, WindowRig::focused()) == 0);
        visited.push_back (WindowRig::focused());
    }
    CHECK (visited.back() == &w.view->canvas());
    w.key ("shift + F6");
    CHECK (WindowRig::focused() == visited[3]);
    w.key ("ctrl + f");
    CHECK (WindowRig::focused()->getTitle() == "Search presets");
    w.stage->type ("liver");
    w.key ("return");
    CHECK (w.graph().name == "Liver");
    CHECK (WindowRig::focused() == &w.view->canvas());
    w.view->run().letGo();
}

TEST_CASE ("keys reach the buttons of the welcome page, and every tab", "[app][keyboard]")
{
    WindowRig w;
    const auto isOn = [] (const juce::String& button) {
        const auto* b = dynamic_cast<juce::Button*> (WindowRig::focused());
        return b != nullptr && b->getButtonText() == button;
    };
    for (int i = 0; i < 2; ++i)
        w.key ("cursor down");
    CHECK (isOn ("New empty graph"));
    w.key ("cursor up");
    CHECK (isOn (juce::String (w.view->part<WelcomePage>().cards()[5].name)));
    w.key ("cursor down");
    w.key ("tab");
    CHECK (isOn ("Open ..."));
    w.key ("shift + tab");
    w.key ("return");
    WindowRig::settle();
    REQUIRE_FALSE (w.view->part<WelcomePage>().isVisible());
    CHECK (WindowRig::focused() == &w.view->canvas());

    std::set<std::string> shown;
    for (int panel = 0; panel < 5; ++panel)
    {
        w.key ("F6");
        auto* tabs = dynamic_cast<Tabs*> (WindowRig::focused());
        if (tabs == nullptr) continue;
        const int count = static_cast<int> (tabs->titles().size());
        const int first = tabs->shown();
        for (int i = 0; i < count; ++i)
        {
            w.key ("cursor right");
            CHECK (tabs->shown() == (first + i + 1) % count);
            CHECK (tabs->panel (tabs->shown())->isShowing());
            CHECK (WindowRig::focused() == tabs);
            shown.insert (tabs->titles()[static_cast<std::size_t> (tabs->shown())].first.toStdString());
        }
        w.key ("tab");
        CHECK ((WindowRig::focused() != tabs && tabs->isParentOf (WindowRig::focused())));
        w.key ("shift + tab");
        CHECK (WindowRig::focused() == tabs);
    }
    for (const char* tab : { "Presets", "Nodes", "History", "Scopes", "Take", "Layers", "Devices", "Problems" })
    {
        INFO (tab);
        CHECK (shown.contains (tab));
    }
}

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

TEST_CASE ("after a new graph is opened, what is typed is for the canvas and not for the search that had the keyboard", "[app][keys]")
{
    WindowRig w ("dry_wood.json");
    w.key ("ctrl + f");
    w.stage->type ("wood");
    WindowRig::settle();
    REQUIRE (WindowRig::focused() != &w.view->canvas());
    w.key ("ctrl + n");
    WindowRig::settle();
    REQUIRE (w.graph().root.nodes.empty());
    CHECK (WindowRig::focused() == &w.view->canvas());
    w.stage->key ("spacebar");
    WindowRig::settle();
    w.stage->type ("plane");
    WindowRig::settle();
    w.key ("return");
    REQUIRE (w.graph().root.nodes.size() == 1);
    CHECK (w.graph().root.nodes[0].type == "deform.plane");
    CHECK_FALSE (w.view->run().isRunning());
}

TEST_CASE ("with the palette open, Esc stops the run and closes the palette", "[app][keys][safety]")
{
    WindowRig w ("dry_wood.json", 1280, 720, false);
    REQUIRE (waitFor ([&] { return w.view->run().isRunning(); }));
    REQUIRE_FALSE (w.view->run().drivesDevice());
    w.view->canvas().grabKeyboardFocus();
    w.key ("ctrl + k");
    auto* palette = w.titled ("Palette");
    REQUIRE (palette != nullptr);
    w.key ("escape");
    CHECK_FALSE (w.view->run().isWanted());
    CHECK_FALSE (palette->isVisible());
}

TEST_CASE ("with a menu open, Esc stops the run and closes the menu", "[app][keys][safety]")
{
    WindowRig w ("dry_wood.json", 1280, 720, false);
    REQUIRE (waitFor ([&] { return w.view->run().isRunning(); }));
    withMenu (w, *w.titled ("Menu"), juce::ModifierKeys::leftButtonModifier, [&] (juce::Component&) {
        w.stage->key ("escape");
        CHECK_FALSE (w.view->run().isWanted());
        WindowRig::settle();
        CHECK (juce::Component::getCurrentlyModalComponent() == nullptr);
    });
}

TEST_CASE ("no menu covers STOP, however low the window is", "[app][keys][safety]")
{
    const auto [width, height] = GENERATE (table<int, int> ({ { 1280, 720 }, { 1024, 420 }, { 512, 350 } }));
    INFO (width << " x " << height);
    WindowRig w ("dry_wood.json", width, height);
    const auto isClear = [&] (juce::Component& menu) {
        CHECK (w.view->getLocalArea (&menu, menu.getLocalBounds()).getY() >= SafetyStrip::height);
        CHECK (w.view->isParentOf (&menu));
    };
    withMenu (w, *w.titled ("Menu"), juce::ModifierKeys::leftButtonModifier, isClear);
    withMenu (w, w.view->canvas(), juce::ModifierKeys::rightButtonModifier, isClear);
}
