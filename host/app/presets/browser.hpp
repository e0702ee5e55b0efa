// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "preset_list.hpp"

#include <host/app/look/look.hpp>

#include <functional>

namespace tactus::host
{

/// The presets there are, with what they feel like. A click opens one.
class PresetBrowser final : public juce::Component, private juce::ListBoxModel
{
public:
    explicit PresetBrowser (std::filesystem::path folder);

    std::function<void (const Preset&)> onOpen;
    void showOpen (const std::filesystem::path&);   ///< marks the one that is open

    void paint (juce::Graphics&) override;
    void resized() override;

private:
    int getNumRows() override { return static_cast<int> (found.size()); }
    void paintListBoxItem (int row, juce::Graphics&, int w, int h, bool selected) override;
    void listBoxItemClicked (int row, const juce::MouseEvent&) override;
    juce::String getTooltipForRow (int row) override;
    void update();

    std::filesystem::path folder, open;
    std::vector<Preset> all, found;
    juce::TextEditor query;
    juce::ListBox list { {}, this };
};

}   // namespace tactus::host
