// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "stage.hpp"
#include "wait_for.hpp"

#include <host/app/window/main_view.hpp>

#include "support/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <functional>
#include <optional>

namespace tactus::host::test
{

/// The name of the latest step of the history.
inline std::string latestStep (const Document& d) { return d.stepName (d.history().size() - 1); }

/// The whole window on a screen, with a mouse and a keyboard that reach only what is visible.
struct WindowRig
{
    juce::ScopedJuceInitialiser_GUI gui;
    Look look;
    TemporaryFolder home;
    std::unique_ptr<Stage> stage;
    std::unique_ptr<MainView> view;
    int clicks = 0;

    /// Opens a preset, or the graph at an absolute path. Without: the welcome page. In safe mode, nothing runs until START. `session`: the devices of the
    /// user, as in the file.
    explicit WindowRig (const std::string& preset = {}, int width = 1280, int height = 720, bool safe = true, const std::string& session = {})
    {
        if (! session.empty()) home.write ("session.json", session);
        juce::LookAndFeel::setDefaultLookAndFeel (&look);
        setenv ("TACTUS_PRESETS", TACTUS_SOURCE_DIR "/graphs", 1);
        stage = std::make_unique<Stage> (width, height);
        view = std::make_unique<MainView> (catalogue());
        stage->fill (*view);
        MainView::StartOptions start { .home = home.path(), .safe = safe };
        if (! preset.empty()) start.files = { std::filesystem::path (TACTUS_SOURCE_DIR "/graphs") / preset };
        view->begin (start);
        if (! view->asked().isOpen()) view->grabKeyboardFocus();   // as the program does
        settle();
    }

    ~WindowRig()
    {
        view.reset();
        stage.reset();
        juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
    }

    static void settle (int ms = 20) { test::settle (ms); }   ///< see wait_for.hpp

    static juce::Button* buttonIn (juce::Component& c, const juce::String& text)
    {
        if (auto* b = dynamic_cast<juce::Button*> (&c); b != nullptr && b->isShowing() && b->getButtonText() == text) return b;
        for (auto* child : c.getChildren())
            if (auto* b = buttonIn (*child, text)) return b;
        return nullptr;
    }

    static std::optional<juce::Point<float>> tabIn (juce::Component& c, const juce::Component& root, const juce::String& text)
    {
        if (const auto* tabs = dynamic_cast<Tabs*> (&c); tabs != nullptr && c.isShowing())
            for (const auto& [name, place] : tabs->titles())
                if (name == text && ! place.isEmpty()) return root.getLocalPoint (&c, place.getCentre());
        for (auto* child : c.getChildren())
            if (const auto at = tabIn (*child, root, text)) return at;
        return {};
    }

    /// Clicks the middle of the button or the tab with this text.
    void click (const juce::String& text)
    {
        INFO (text);
        if (const auto tab = tabIn (*view, *stage, text))
        {
            stage->click (*tab);
            ++clicks;
            return settle();
        }
        auto* b = buttonIn (*view, text);
        REQUIRE (b != nullptr);
        REQUIRE (b->isEnabled());
        const auto at = stage->getLocalPoint (b, b->getLocalBounds().getCentre());
        REQUIRE (stage->getComponentAt (at) == b);   // nothing covers it
        stage->click (at.toFloat());
        ++clicks;
        settle();
    }

    void key (const juce::String& described)
    {
        stage->key (described);
        settle (2);   // JUCE reports the focus, and Enter in a field, later
    }

    /// The part of the window with this title or name; null if it is not showing.
    juce::Component* titled (const juce::String& title) { return titledIn (*view, title); }

    static juce::Component* titledIn (juce::Component& c, const juce::String& title)
    {
        if (c.isShowing() && (c.getTitle() == title || c.getName() == title)) return &c;
        for (auto* child : c.getChildren())
            if (auto* found = titledIn (*child, title)) return found;
        return nullptr;
    }

    juce::Point<float> middleOf (juce::Component& c) { return stage->getLocalPoint (&c, c.getLocalBounds().getCentre()).toFloat(); }

    /// Clicks the part of the window with this title.
    void clickTitled (const juce::String& title, int button = juce::ModifierKeys::leftButtonModifier)
    {
        INFO (title);
        auto* c = titled (title);
        REQUIRE (c != nullptr);
        stage->click (middleOf (*c), button);
        settle();
    }

    /// Clicks there, goes down in the menu that opens (or up, if `steps` is negative), and presses a key. The keys are in the message after the one
    /// that opens the menu, because JUCE closes a menu at its first timer call if no window of the program has the keyboard of the X server.
    static void chooseFrom (Stage& stage, juce::Point<float> at, int steps, int button = juce::ModifierKeys::rightButtonModifier,
                            const juce::String& end = "return")
    {
        bool opened = false;
        int waits = 0;
        const std::function<void()> chooseIfOpen = [&] {
            opened = juce::Component::getNumCurrentlyModalComponents() == 1;
            if (! opened && ++waits < 1000) return void (juce::MessageManager::callAsync (chooseIfOpen));
            for (int i = 0; i < std::abs (steps); ++i)
                stage.key (steps > 0 ? "cursor down" : "cursor up");
            stage.key (end);
            waits = 1000;
        };
        stage.click (at, button);
        chooseIfOpen();
        while (waits < 1000 || juce::Component::getNumCurrentlyModalComponents() > 0)
            settle();
        REQUIRE (opened);
        settle();
    }

    /// Chooses from a menu of this window, see chooseFrom().
    void choose (juce::Point<float> at, int steps, int button = juce::ModifierKeys::rightButtonModifier, const juce::String& end = "return")
    {
        chooseFrom (*stage, at, steps, button, end);
    }

    static juce::Component* focused() { return juce::Component::getCurrentlyFocusedComponent(); }

    const graph::Graph& graph() { return view->document().graph(); }
};

}   // namespace tactus::host::test
