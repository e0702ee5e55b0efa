// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "stage.hpp"
#include "wait_for.hpp"

#include <host/app/look/tabs.hpp>
#include <host/app/model/document.hpp>

#include <catch2/catch.hpp>

#include <functional>
#include <memory>
#include <optional>

namespace tactus::host::test
{

/// The name of the latest step of the history.
inline std::string latestStep (const Document& d) { return d.stepName (d.history().size() - 1); }

/// A screen with a mouse and a keyboard that reach only what is visible, and ways to find what is on it.
struct OnStage
{
    std::unique_ptr<Stage> stage;
    int clicks = 0;

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
        if (const auto tab = tabIn (*stage, *stage, text))
        {
            stage->click (*tab);
            ++clicks;
            return settle();
        }
        auto* b = buttonIn (*stage, text);
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

    /// The part on the screen with this title or name; null if it is not showing.
    juce::Component* titled (const juce::String& title) { return titledIn (*stage, title); }

    static juce::Component* titledIn (juce::Component& c, const juce::String& title)
    {
        if (c.isShowing() && (c.getTitle() == title || c.getName() == title)) return &c;
        for (auto* child : c.getChildren())
            if (auto* found = titledIn (*child, title)) return found;
        return nullptr;
    }

    juce::Point<float> middleOf (juce::Component& c) { return stage->getLocalPoint (&c, c.getLocalBounds().getCentre()).toFloat(); }

    /// Clicks the part with this title.
    void clickTitled (const juce::String& title, int button = juce::ModifierKeys::leftButtonModifier)
    {
        INFO (title);
        auto* c = titled (title);
        REQUIRE (c != nullptr);
        stage->click (middleOf (*c), button);
        settle();
    }

    /// Opens a menu, and uses it until it is closed. It is used in the message after the one that opens it, because JUCE closes a menu at its first timer
    /// call if no window of the program has the keyboard of the X server.
    static void withMenu (const std::function<void()>& open, const std::function<void (juce::Component&)>& use)
    {
        bool opened = false;
        int waits = 0;
        const std::function<void()> useIfOpen = [&] {
            opened = juce::Component::getNumCurrentlyModalComponents() == 1;
            if (! opened && ++waits < 1000) return void (juce::MessageManager::callAsync (useIfOpen));
            waits = 1000;
            if (opened) use (*juce::Component::getCurrentlyModalComponent());
        };
        open();
        useIfOpen();
        while (waits < 1000 || juce::Component::getNumCurrentlyModalComponents() > 0)
            settle();
        REQUIRE (opened);
        settle();
    }

    /// Opens a menu, goes down in it (or up, if `steps` is negative), and presses a key.
    static void useMenu (Stage& stage, const std::function<void()>& open, int steps, const juce::String& end)
    {
        withMenu (open, [&] (juce::Component&) {
            for (int i = 0; i < std::abs (steps); ++i)
                stage.key (steps > 0 ? "cursor down" : "cursor up");
            stage.key (end);
        });
    }

    /// The same for the menu that a click there opens.
    static void chooseFrom (Stage& stage, juce::Point<float> at, int steps, int button = juce::ModifierKeys::rightButtonModifier,
                            const juce::String& end = "return")
    {
        useMenu (
            stage, [&] { stage.click (at, button); }, steps, end);
    }

    /// Chooses from a menu, see chooseFrom().
    void choose (juce::Point<float> at, int steps, int button = juce::ModifierKeys::rightButtonModifier, const juce::String& end = "return")
    {
        chooseFrom (*stage, at, steps, button, end);
    }

    static juce::Component* focused() { return juce::Component::getCurrentlyFocusedComponent(); }
};

}   // namespace tactus::host::test
