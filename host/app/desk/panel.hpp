// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "desk.hpp"

namespace tactus::host
{

/// A panel of the window, as a function `Panel NAME (Desk&)` of its folder makes it. It needs a name and a component; the window calls the functions that
/// are set. docs/panels.md says how to add one. [main thread]
struct Panel
{
    /// A key that acts wherever the keyboard is, unless a dialog is open or a field takes it; and its line in the list of shortcuts.
    struct Key
    {
        const char* key;     ///< as juce::KeyPress::createFromDescription() reads it; "" if it is a key of the component
        const char* shown;   ///< how the list names it, in English
        const char* help;    ///< what it does, in English
        std::function<void()> act {};
    };

    /// An entry of the search for commands (Ctrl+K).
    struct Action
    {
        juce::String name, about;
        std::function<void()> act;
    };

    /// The title of a tab that changes.
    struct Title
    {
        juce::String text;
        bool alarms = false;   ///< drawn in red
    };

    juce::String name;
    std::unique_ptr<juce::Component> component;
    std::vector<Key> keys {};
    std::function<std::vector<Action>()> actions {};
    std::function<Title()> title {};

    std::function<void()> escape {};               ///< Esc, of a panel that covers the window: it must close, and does nothing else
    std::function<void()> reload {};               ///< the settings were read, or a graph was opened or saved
    std::function<void()> refresh {};              ///< many times a second
    std::function<void (graph::Graph&)> keep {};   ///< stores what the file of a graph keeps of the panel in a graph that is about to be saved
    std::function<void()> restore {};              ///< another graph is open: shows what Document::ui() keeps of it

    /// The window is about to close: asks about what would be lost, and then calls the function.
    std::function<void (std::function<void()>)> close {};
    std::function<const void*()> work {};   ///< another pointer once there is something else that close() asks about
    std::function<bool()> leave {};         ///< the program must close now; returns true if it leaves something for the next start
};

}   // namespace tactus::host
