// SPDX-License-Identifier: GPL-3.0-or-later
// A window of 1024 by 700 pixels at a scale of 200 % has 512 by 350 units: too few for all panels side by side.
#include "host/app/support/seen_text.hpp"
#include "host/app/support/window_rig.hpp"

#include <host/app/scopes/scope_view.hpp>

using namespace tactus;
using namespace tactus::host;
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

TEST_CASE ("a window of 1024 by 700 at 200 % has a canvas\\, a hand and a scope that can be used", "[app][small]")
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

TEST_CASE ("in a small window\\, every panel can be opened\\, and no button is out of reach", "[app][small]")
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

TEST_CASE ("the titles of tabs are all in the row or in its menu\\, whatever the width", "[app][small]")
{
    juce::ScopedJuceInitialiser_GUI gui;
    Look look;
    juce::LookAndFeel::setDefaultLookAndFeel (&look);
    {
        Tabs tabs;
        for (const char* name : { "Scopes", "Take", "Layers", "Devices", "Problems 12" })
            tabs.add<juce::Component> (name);
        for (int width = 120; width < 600; width += 13)
            for (int current = 0; current < 5; ++current)
            {
                tabs.setSize (width, 100);
                tabs.show (current);
                float right = 0.0f;
                bool is_any_hidden = false;
                for (const auto& [name, place] : tabs.titles())
                {
                    is_any_hidden = is_any_hidden || place.isEmpty();
                    if (place.isEmpty()) continue;
                    CHECK (place.getX() >= right);
                    right = place.getRight();
                }
                INFO (width << ", tab " << current);
                CHECK_FALSE (tabs.titles()[static_cast<std::size_t> (current)].second.isEmpty());
                CHECK (right <= static_cast<float> (width) - (is_any_hidden ? 28.0f : 0.0f));
                if (width >= 420) CHECK_FALSE (is_any_hidden);
            }
    }
    juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
}
