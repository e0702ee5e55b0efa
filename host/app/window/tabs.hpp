// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>

#include <memory>
#include <vector>

namespace tactus::host
{

/// Panels of which one is seen at a time, and a row of their names.
class Tabs final : public juce::Component
{
public:
    static constexpr int row_height = 32;

    void add (const juce::String& name, std::unique_ptr<juce::Component>);
    void clear();
    void name (const juce::Component& panel, const juce::String&, bool alarms = false);   ///< alarms: something there wants to be seen

    void show (int index);
    void show (const juce::Component& panel);
    int shown() const noexcept { return current; }

    /// The names, and where they are.
    std::vector<std::pair<juce::String, juce::Rectangle<float>>> titles() const;

    void paint (juce::Graphics&) override;
    void resized() override;
    void mouseDown (const juce::MouseEvent&) override;

private:
    struct Tab
    {
        juce::String name;
        std::unique_ptr<juce::Component> panel;
        bool alarms = false;
    };

    std::vector<Tab> tabs;
    int current = 0;
};

}   // namespace tactus::host
