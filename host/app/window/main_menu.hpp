// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "window_parts.hpp"

#include <filesystem>
#include <functional>

namespace tactus::host
{

/// The menu of a window. [main thread]
class MainMenu
{
public:
    explicit MainMenu (WindowParts& p) : parts (p) {}

    juce::PopupMenu items();
    void open (juce::Component& at);

    std::function<void()> onTour, onFind, onOsc;
    std::function<void()> onQuit;   ///< the menu has Quit only if this is set

private:
    juce::PopupMenu::Item item (const juce::String& text, const juce::String& keys, std::function<void()> act, bool is_ticked = false) const;
    juce::PopupMenu languages() const;
    juce::PopupMenu scales() const;
    juce::PopupMenu recentFiles() const;
    juce::PopupMenu templates() const;
    void addFiles (juce::PopupMenu&);
    void addGraph (juce::PopupMenu&);
    void addLook (juce::PopupMenu&);
    void addHelp (juce::PopupMenu&);

    WindowParts& parts;
};

}   // namespace tactus::host
