// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace tactus::host
{

/// Tags to filter by, wrapped. A click takes one in or out; what does not fit waits behind "more".
class TagChips final : public juce::Component
{
public:
    TagChips() { setTitle ("Tags"); }

    void show (std::vector<std::string> tags);   ///< in this order; those that are chosen come first
    const std::set<std::string>& chosen() const noexcept { return selected; }
    void clear();

    int heightFor (int width, int rows) const;   ///< for so many rows at most, or all of them once "more" was clicked

    std::function<void()> onChange;
    std::function<void()> onResize;   ///< another height is wanted

    void paint (juce::Graphics&) override;
    void mouseUp (const juce::MouseEvent&) override;

private:
    struct Chip
    {
        std::string tag;   // empty: more, or fewer
        juce::Rectangle<int> place;
    };

    std::vector<Chip> layOut (int width, int rows) const;
    int chipWidth (const juce::String&) const;

    static constexpr int chip_height = 24, gap = 4;
    std::vector<std::string> all;
    std::set<std::string> selected;
    mutable int shown_rows = 1;
    bool unfolded = false;
};

}   // namespace tactus::host
