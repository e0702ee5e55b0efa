// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace tactus::host
{

/// Tabbed panels, with a row of titles. While it has the keyboard, arrow keys go from tab to tab, and Tab goes into the panel.
class Tabs final : public juce::Component
{
public:
    static constexpr int row_height = 32;

    Tabs()
    {
        setWantsKeyboardFocus (true);
        setMouseClickGrabsKeyboardFocus (false);
        setOpaque (true);
    }

    juce::Component& add (const juce::String& name, std::unique_ptr<juce::Component> panel);
    void rename (const juce::Component& panel, const juce::String&, bool alarms = false);   ///< alarms: the title is drawn in red

    void show (int index);
    void show (const juce::Component& panel);
    int shown() const noexcept { return current; }
    juce::Component* panel (int index) const { return tabs[static_cast<std::size_t> (index)].panel.get(); }

    std::function<void()> onShow;   ///< called when another tab is in front

    /// The titles and their bounds, which are empty for titles that there is no room for: these are in a menu at the end of the row.
    std::vector<std::pair<juce::String, juce::Rectangle<float>>> titles() const;

    void paint (juce::Graphics&) override;
    void resized() override;
    void mouseDown (const juce::MouseEvent&) override;
    bool keyPressed (const juce::KeyPress&) override;
    void focusGained (FocusChangeType) override { repaint(); }
    void focusLost (FocusChangeType) override { repaint(); }

private:
    struct Tab
    {
        juce::String name;
        std::unique_ptr<juce::Component> panel;
        bool alarms = false;
    };

    juce::Rectangle<float> placeOfMenu() const;   ///< empty if there is room for all titles
    void openMenu();

    std::vector<Tab> tabs;
    int current = 0;
};

}   // namespace tactus::host
