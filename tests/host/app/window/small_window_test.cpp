// SPDX-License-Identifier: GPL-3.0-or-later
// The places of the panels, and the edges between them. A window of 1024 by 700 pixels at a scale of 200 % has 512 by 350 units: too few for all
// panels side by side.
#include "host/app/support/seen_text.hpp"
#include "host/app/support/window_rig.hpp"

#include <host/app/look/appearance.hpp>
#include <host/app/scopes/scope_panel.hpp>
#include <host/app/storage/settings.hpp>
#include <host/app/welcome/template_row.hpp>
#include <tactus/file/graph_file.hpp>

#include <array>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::latestStep;
using tactus::host::test::Stage;
using tactus::host::test::WindowRig;

namespace
{
constexpr int small_width = 512, small_height = 350;

template <typename T>
void collect (juce::Component& in, std::vector<T*>& found)
{
    if (! in.isShowing()) return;
    if (auto* t = dynamic_cast<T*> (&in)) found.push_back (t);
    for (auto* child : in.getChildren())
        collect (*child, found);
}

template <typename T>
std::vector<T*> shown (juce::Component& in)
{
    std::vector<T*> found;
    collect (in, found);
    return found;
}

/// What is in a viewport can be scrolled to.
bool isScrolled (const juce::Component& c) { return c.findParentComponentOfClass<juce::Viewport>() != nullptr; }

/// The buttons and lists of which a part is not in the window, or that are too small to hit.
juce::StringArray outOfReach (WindowRig& w)
{
    juce::StringArray all;
    const auto check = [&] (juce::Component& c, const juce::String& name) {
        if (isScrolled (c) || c.getBounds().isEmpty()) return;
        const auto place = w.view->getLocalArea (&c, c.getLocalBounds());
        if (! w.view->getLocalBounds().contains (place) || place.getWidth() < 14 || place.getHeight() < 14) all.add (name + " " + place.toString());
        for (auto* p = c.getParentComponent(); p != nullptr && p != w.view.get(); p = p->getParentComponent())
            if (! p->getLocalBounds().contains (p->getLocalArea (&c, c.getLocalBounds()))) return void (all.add (name + " is cut by " + p->getTitle()));
    };
    for (auto* b : shown<juce::Button> (*w.view))
        check (*b, b->getTitle().isNotEmpty() ? b->getTitle() : b->getButtonText());
    for (auto* b : shown<juce::ComboBox> (*w.view))
        check (*b, b->getTitle());
    return all;
}

/// Opens the tab, from the menu at the end of the row if there is no room for its title.
void turnTo (WindowRig& w, const juce::String& title)
{
    if (WindowRig::tabIn (*w.view, *w.stage, title)) return w.click (title);
    for (auto* tabs : shown<Tabs> (*w.view))
        for (int i = 0, hidden = 0; const auto& [name, place] : tabs->titles())
        {
            if (place.isEmpty()) ++hidden;
            if (name == title)
            {
                const auto row = w.stage->getLocalArea (tabs, tabs->getLocalBounds().removeFromTop (Tabs::row_height));
                w.choose ({ static_cast<float> (row.getRight() - 14), static_cast<float> (row.getCentreY()) }, hidden, juce::ModifierKeys::leftButtonModifier);
                CHECK (tabs->shown() == i);
                return;
            }
            ++i;
        }
    FAIL ("no tab " << title);
}
}   // namespace

TEST_CASE ("on an empty canvas, all templates are in view, and below the hint", "[app][small]")
{
    const auto [width, height] = GENERATE (std::pair { small_width, small_height }, std::pair { 640, 400 }, std::pair { 800, 500 }, std::pair { 1280, 720 });
    INFO (width << " by " << height);
    WindowRig w ({}, width, height);
    w.key ("ctrl + n");
    WindowRig::settle();
    auto& canvas = w.view->canvas();
    REQUIRE (canvas.isShowing());
    const auto area = w.stage->getLocalArea (&canvas, canvas.getLocalBounds());
    int count = 0;
    for (auto* row : shown<TemplateRow> (*w.view))
    {
        for (auto* b : row->getChildren())
        {
            const auto place = w.stage->getLocalArea (b, b->getLocalBounds());
            CHECK (area.contains (place));
            CHECK (b->getWidth() >= dynamic_cast<PlainButton&> (*b).widthFor());
            ++count;
        }
    }
    CHECK (count == 5);

    const auto* row = shown<TemplateRow> (*w.view).front();
    const auto texts = tactus::host::test::readTexts (canvas);
    const auto hint = std::ranges::find_if (texts, [] (const auto& t) { return t.text.startsWith ("Press Space"); });
    REQUIRE (hint != texts.end());
    CHECK (hint->place.getY() >= 0.0f);
    CHECK (hint->place.getBottom() <= static_cast<float> (canvas.getLocalPoint (row, juce::Point<int>()).y));
    CHECK (tactus::host::test::cutOff (texts, canvas.getLocalBounds().toFloat()).isEmpty());
}

TEST_CASE ("a window of 1024 by 700 at 200 % has a canvas, a hand and a scope that can be used", "[app][small]")
{
    WindowRig w ("dry_wood.json", small_width, small_height);
    auto& canvas = w.view->canvas();
    REQUIRE (canvas.isShowing());
    CHECK (canvas.getWidth() >= 240);
    CHECK (canvas.getHeight() >= 180);
    const auto plots = shown<ScopePlot> (*w.view);
    REQUIRE_FALSE (plots.empty());
    CHECK (plots.front()->getHeight() >= 120);
    CHECK (w.titled ("Surface") == nullptr);

    w.click ("Hand");
    auto* surface = w.titled ("Surface");
    REQUIRE (surface != nullptr);
    CHECK (surface->getHeight() >= 100);
    CHECK (surface->getWidth() >= 200);
    CHECK (shown<ScopePlot> (*w.view).front()->getHeight() >= 120);   // beside the hand
    CHECK_FALSE (canvas.isShowing());

    SECTION ("keys for the canvas do nothing while it is hidden, and go to it again when it is back")
    {
        const auto before = w.graph().root.nodes.size();
        w.key ("ctrl + a");
        w.key ("delete");
        CHECK (w.graph().root.nodes.size() == before);
        w.click ("Canvas");
        CHECK (canvas.hasKeyboardFocus (true));
        canvas.select ({ w.graph().root.find ("drag")->id });
        w.key ("return");   // to the parameters
        CHECK (w.titled ("Inspector") != nullptr);
        CHECK (w.titled ("Inspector")->hasKeyboardFocus (true));
        w.key ("escape");
        CHECK (canvas.hasKeyboardFocus (true));
    }
    SECTION ("Z leaves the window to the page, and brings the other panels back")
    {
        w.click ("Canvas");
        w.key ("z");
        CHECK (canvas.getWidth() == small_width);
        CHECK (w.titled ("Scopes") == nullptr);
        w.key ("z");
        CHECK (canvas.getWidth() < small_width);
        CHECK (w.titled ("Scopes") != nullptr);
    }
    SECTION ("a larger window has all panels side by side again")
    {
        w.stage->setSize (1280, 720);
        WindowRig::settle();
        CHECK (canvas.isShowing());
        CHECK (w.titled ("Surface") != nullptr);
        CHECK (w.titled ("Inspector") != nullptr);
        CHECK_FALSE (WindowRig::tabIn (*w.view, *w.stage, "Canvas").has_value());
    }
}

TEST_CASE ("in a small window, every panel can be opened, and no button is out of reach", "[app][small]")
{
    WindowRig w ("dry_wood.json", small_width, small_height);
    for (const char* title : { "Hand", "Inspector", "Presets", "Canvas", "Take", "Layers", "Devices", "Problems", "Scopes" })
    {
        turnTo (w, title);
        WindowRig::settle (60);
        INFO (title << ": " << outOfReach (w).joinIntoString ("; "));
        CHECK (outOfReach (w).isEmpty());
    }
    for (int i = 0; i < 6; ++i)
    {
        w.key ("F6");   // from panel to panel, also to those on other pages
        CHECK (WindowRig::focused() != nullptr);
    }
    w.key ("ctrl + k");
    REQUIRE (w.titled ("Palette") != nullptr);
    CHECK (w.titled ("Palette")->getY() >= SafetyStrip::height);   // STOP is not covered
    CHECK (w.view->getLocalBounds().contains (w.titled ("Palette")->getBounds()));
    w.key ("escape");
    w.key ("ctrl + f");
    CHECK (w.titled ("Search presets") != nullptr);
    CHECK (w.titled ("Search presets")->hasKeyboardFocus (true));
}

TEST_CASE ("in the smallest window of the program, and in a lower one, all panels are side by side, and no button is out of reach", "[app][small]")
{
    const int height = GENERATE (600, 470);   // the second is a screen of 1600 by 1000 at 200 %, less the frame of the window and a taskbar
    WindowRig w ("dry_wood.json", 800, height);
    CHECK (w.view->canvas().isShowing());
    CHECK (w.titled ("Surface") != nullptr);
    CHECK (w.titled ("Inspector") != nullptr);
    CHECK (w.titled ("Search presets") != nullptr);
    for (const char* title : { "Nodes", "History", "Presets", "Take", "Layers", "Devices", "Problems", "Scopes" })
    {
        turnTo (w, title);
        WindowRig::settle (60);
        INFO (height << ", " << title << ": " << outOfReach (w).joinIntoString ("; "));
        CHECK (outOfReach (w).isEmpty());
    }
}

TEST_CASE ("the columns of a small window are resized by a drag, halved again by a double click, undone and remembered", "[app][small]")
{
    WindowRig w ("dry_wood.json", small_width, small_height);
    auto& canvas = w.view->canvas();
    canvas.grabKeyboardFocus();
    const auto edge = [&]() -> juce::Component& {
        juce::Component* found = nullptr;
        for (auto* s : shown<Splitter> (*w.view))
            if (s->getHeight() > 100) found = s;
        REQUIRE (found != nullptr);
        return *found;
    };
    CHECK (shown<Splitter> (*w.view).size() == 1);
    const int half = canvas.getWidth();
    CHECK (half == small_width / 2);
    w.stage->drag (w.middleOf (edge()), w.middleOf (edge()).translated (30.0f, 0.0f));
    WindowRig::settle();
    CHECK (std::abs (canvas.getWidth() - (half + 30)) <= 1);
    CHECK (w.titled ("Scopes")->getWidth() == small_width - canvas.getWidth());
    CHECK (outOfReach (w).isEmpty());
    w.key ("ctrl + z");
    CHECK (canvas.getWidth() == half);
    w.key ("ctrl + y");
    CHECK (std::abs (canvas.getWidth() - (half + 30)) <= 1);
    for (const float way : { 2000.0f, -2000.0f })   // neither column goes away
    {
        w.stage->drag (w.middleOf (edge()), w.middleOf (edge()).translated (way, 0.0f));
        WindowRig::settle();
        CHECK (canvas.getWidth() >= 210);
        CHECK (w.titled ("Scopes")->getWidth() >= 210);
    }
    w.stage->doubleClick (w.middleOf (edge()));
    WindowRig::settle();
    CHECK (canvas.getWidth() == half);
    w.stage->drag (w.middleOf (edge()), w.middleOf (edge()).translated (30.0f, 0.0f));
    WindowRig::settle (1500);   // the settings are saved a little later
    const auto panels = loadSettings (w.home.path()).settings.panels;
    REQUIRE (panels.contains ("page"));
    CHECK (panels.at ("page") == Approx (static_cast<double> (canvas.getWidth()) / small_width).margin (0.01));
    w.key ("z");   // leaves the window to the page
    CHECK (shown<Splitter> (*w.view).empty());
    w.key ("z");
    w.stage->doubleClick (w.middleOf (edge()));
    WindowRig::settle();
    CHECK (canvas.getWidth() == half);
}

TEST_CASE ("in a small window, the tour leaves free what one is to try, and a dialog for files leaves STOP free", "[app][small]")
{
    const auto [width, height] = GENERATE (std::pair (small_width, small_height), std::pair (640, 360));
    INFO (width << " x " << height);
    WindowRig w ("dry_wood.json", width, height);
    w.key ("shift + F1");
    auto& tour = w.view->part<Tour>();
    REQUIRE (tour.isOpen());
    auto* surface = w.titled ("Surface");
    REQUIRE (surface != nullptr);
    const auto middle = w.middleOf (*surface).toInt();
    const auto* hit = w.stage->getComponentAt (middle);
    CHECK ((hit == surface || surface->isParentOf (hit)));
    for (int i = 0; i < 4; ++i)
    {
        for (auto* b : shown<juce::Button> (tour))
            CHECK (w.view->getLocalBounds().contains (w.view->getLocalArea (b, b->getLocalBounds())));
        const auto texts = host::test::readTexts (tour);
        CHECK (host::test::overlaps (texts, tour.getLocalBounds().toFloat()).joinIntoString ("; ") == "");
        CHECK (host::test::cutOff (texts, tour.getLocalBounds().toFloat()).joinIntoString ("; ") == "");
        w.click ("Next");
    }
    w.click ("Done");

    setenv ("TACTUS_GRAPHS", w.home.path().c_str(), 1);
    w.key ("ctrl + shift + s");
    unsetenv ("TACTUS_GRAPHS");
    auto* dialog = juce::Component::getCurrentlyModalComponent();
    REQUIRE (dialog != nullptr);
    CHECK (dialog->getY() >= SafetyStrip::height);
    CHECK (w.view->getLocalBounds().contains (dialog->getBounds()));
    for (auto* b : shown<juce::Button> (*dialog))
        CHECK (dialog->getLocalBounds().contains (dialog->getLocalArea (b, b->getLocalBounds())));
    w.key ("escape");
}

TEST_CASE ("the hand and the scopes share the width as one drags the edge between them", "[app][small]")
{
    WindowRig w ("dry_wood.json", 1280, 720);
    auto& surface = *w.titled ("Surface");
    const int before = surface.getWidth(), scopes = w.titled ("Scopes")->getWidth();
    juce::Component* edge = nullptr;
    for (auto* s : shown<Splitter> (*w.view))
        if (s->getHeight() > s->getWidth() && s->getY() > 400) edge = s;
    REQUIRE (edge != nullptr);
    w.stage->drag (w.middleOf (*edge), w.middleOf (*edge).translated (-80.0f, 0.0f));
    WindowRig::settle();
    CHECK (std::abs (surface.getWidth() - (before - 80)) <= 1);
    CHECK (std::abs (w.titled ("Scopes")->getWidth() - (scopes + 80)) <= 1);
    CHECK (outOfReach (w).joinIntoString ("; ") == "");
}

TEST_CASE ("on a small screen and at twice the size, at least 120 pixels of each plot are in view", "[app][scopes]")
{
    WindowRig w ("dry_wood.json", 1024, 700);
    for (const double scale : { 1.0, 2.0 })
    {
        INFO (scale);
        applyScale (scale);
        Stage::plugIn();
        w.stage->setSize (juce::roundToInt (1024 / scale), juce::roundToInt (700 / scale));
        WindowRig::settle();
        auto* panel = dynamic_cast<ScopePanel*> (w.titled ("Scopes"));
        REQUIRE (panel != nullptr);
        REQUIRE_FALSE (panel->shown().empty());
        for (const auto& v : panel->shown())
        {
            auto& plot = v->plot();
            const auto seen = panel->getLocalArea (&plot, plot.getLocalBounds()).withX (0).withWidth (10).getIntersection (panel->getLocalBounds());
            CHECK (seen.getHeight() * scale >= 120.0);
        }
        CHECK (w.view->canvas().getHeight() * scale >= 160.0);
    }
    applyScale (1.0);
    Stage::plugIn();
}

TEST_CASE ("an edge that was dragged beyond its limit follows the next drag at once", "[app][panels]")
{
    WindowRig w ("dry_wood.json", 1600, 900);
    std::vector<Splitter*> edges;
    for (auto* child : w.view->getChildren())
        if (auto* edge = dynamic_cast<Splitter*> (child); edge != nullptr && edge->isShowing()) edges.push_back (edge);
    REQUIRE (edges.size() == 4);
    for (auto* edge : edges)
    {
        const bool is_level = edge->getWidth() > edge->getHeight();
        INFO ((is_level ? "level, y " : "upright, x ") << (is_level ? edge->getY() : edge->getX()));
        const auto place = [&] { return is_level ? edge->getBounds().getCentreY() : edge->getBounds().getCentreX(); };
        const auto drag = [&] (int way) {
            const auto from = w.middleOf (*edge);
            const auto moved = static_cast<float> (place() + way);
            const auto to = is_level ? from.withY (moved) : from.withX (moved);
            const auto before = place();
            w.stage->drag (from, to);
            WindowRig::settle();
            return place() - before;
        };
        // Away from the panel that it sizes, as far as the mouse gets.
        const int room = is_level ? w.view->getHeight() : w.view->getWidth();
        const bool grows_up = is_level || place() > w.view->getWidth() / 2;
        drag (grows_up ? 10 - place() : room - 10 - place());
        const int back = grows_up ? 40 : -40;
        CHECK (std::abs (drag (back) - back) <= 2);
        w.key ("ctrl + z");
        w.key ("ctrl + z");
    }
}

TEST_CASE ("moving panels is a step that can be undone, which never touches the graph", "[app][panels][undo]")
{
    WindowRig w ("dry_wood.json", 1600, 900);
    w.view->canvas().grabKeyboardFocus();
    const auto text = writeGraph (w.graph());
    const auto undoAndRedo = [&] (const auto& isDone) {
        REQUIRE (isDone());
        for (int i = 0; i < 2; ++i)
        {
            w.key ("ctrl + z");
            CHECK_FALSE (isDone());
            w.key ("ctrl + y");
            CHECK (isDone());
            CHECK (writeGraph (w.graph()) == text);
        }
        CHECK_FALSE (w.view->document().isChanged());
    };
    const auto width = w.view->canvas().getWidth();
    for (auto* child : w.view->getChildren())
        if (child->getTitle() == "Panel edge" && child->getX() < 400 && child->getHeight() > child->getWidth())
        {
            w.stage->drag (w.middleOf (*child), w.middleOf (*child).translated (50.0f, 0.0f));
            break;
        }
    WindowRig::settle (60);
    undoAndRedo ([&] { return std::abs (w.view->canvas().getWidth() - (width - 50)) <= 1; });
    CHECK (latestStep (w.view->document()) == "move panels");
    w.key ("z");
    undoAndRedo ([&] { return w.view->canvas().getWidth() > width + 100; });
}
