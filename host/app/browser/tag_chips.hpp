// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>
#include <host/app/text/filled.hpp>

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tactus::host
{

/// Filter tags, wrapped into rows. A click toggles a tag. Tags that do not fit are behind "more".
class TagChips final : public juce::Component
{
public:
    TagChips() { setTitle (TRANS ("Tags")); }

    /// In this order, selected ones first. After a click, the chips stay where they are until the pointer has left them.
    void show (std::vector<std::string> tags);
    const std::set<std::string>& chosen() const noexcept { return selected; }

    int heightFor (int width, int rows) const;   ///< at most this many rows; all rows after a click on "more"

    std::function<void()> onChange;
    std::function<void()> onResize;   ///< called when the height has changed

    void paint (juce::Graphics&) override;
    void mouseUp (const juce::MouseEvent&) override;
    void mouseExit (const juce::MouseEvent&) override;

private:
    struct Chip
    {
        std::string tag;   // empty for "more" and "fewer"
        juce::Rectangle<int> place;
    };

    std::vector<Chip> layOut (int width, int rows) const;
    int chipWidth (const juce::String&) const;

    static constexpr int chip_height = 24, gap = 4;
    std::vector<std::string> all;
    std::set<std::string> selected;
    mutable int shown_rows = 1;
    bool unfolded = false, is_held = false;
    std::optional<std::vector<std::string>> pending;   // what to show once the pointer has left
};

}   // namespace tactus::host
