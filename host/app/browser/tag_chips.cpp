// SPDX-License-Identifier: GPL-3.0-or-later
#include "tag_chips.hpp"

#include <host/app/text/filled.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host
{

namespace
{
juce::String more() { return TRANS ("more"); }
juce::String fewer() { return TRANS ("fewer"); }
}   // namespace

void TagChips::show (std::vector<std::string> tags)
{
    if (is_held)
    {
        pending = std::move (tags);
        return repaint();
    }
    std::stable_partition (tags.begin(), tags.end(), [this] (const std::string& t) { return selected.contains (t); });
    all = std::move (tags);
    repaint();
}

int TagChips::chipWidth (const juce::String& text) const { return juce::roundToInt (lookOf (*this).font (12.0f).getStringWidthFloat (text)) + 16; }

std::vector<TagChips::Chip> TagChips::layOut (int width, int rows) const
{
    std::vector<Chip> chips;
    int x = 0, row = 0;
    const int room_for_more = chipWidth (more()) + gap;
    for (const auto& tag : all)
    {
        const int w = std::min (chipWidth (juce::String (tag)), width);
        const bool is_last_row = ! unfolded && row + 1 == rows;
        if (x > 0 && x + w > width - (is_last_row && tag != all.back() ? room_for_more : 0))
        {
            if (is_last_row)
            {
                chips.push_back ({ {}, { x, row * (chip_height + gap), chipWidth (more()), chip_height } });
                return chips;
            }
            x = 0;
            ++row;
        }
        chips.push_back ({ tag, { x, row * (chip_height + gap), w, chip_height } });
        x += w + gap;
    }
    if (unfolded)
    {
        const int w = chipWidth (fewer());
        if (x + w > width)
        {
            x = 0;
            ++row;
        }
        chips.push_back ({ {}, { x, row * (chip_height + gap), w, chip_height } });
    }
    return chips;
}

int TagChips::heightFor (int width, int rows) const
{
    shown_rows = rows;
    const auto chips = layOut (width, rows);
    return chips.empty() ? 0 : chips.back().place.getBottom();
}

void TagChips::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    g.setFont (look.font (12.0f));
    for (const auto& chip : layOut (getWidth(), shown_rows))
    {
        const auto area = chip.place.toFloat().reduced (0.5f);
        const bool is_on = selected.contains (chip.tag);
        if (! chip.tag.empty())
        {
            g.setColour (is_on ? theme.accent.withAlpha (0.25f) : theme.raised);
            g.fillRoundedRectangle (area, 12.0f);
            g.setColour (is_on ? theme.accent : theme.hairline);
            g.drawRoundedRectangle (area, 12.0f, 1.0f);
        }
        const auto tag_colour = is_on ? theme.text : theme.dim;
        g.setColour (chip.tag.empty() ? theme.accent : tag_colour);
        g.drawText (chip.tag.empty() ? (unfolded ? fewer() : more()) : juce::String (chip.tag), chip.place, juce::Justification::centred, false);
    }
}

void TagChips::mouseUp (const juce::MouseEvent& e)
{
    if (! e.mods.isLeftButtonDown()) return;
    for (const auto& chip : layOut (getWidth(), shown_rows))
    {
        if (! chip.place.contains (e.getPosition())) continue;
        if (chip.tag.empty())
        {
            unfolded = ! unfolded;
            if (onResize) onResize();
        }
        else
        {
            if (selected.erase (chip.tag) == 0) selected.insert (chip.tag);
            is_held = true;
            if (onChange) onChange();
        }
        return repaint();
    }
}

void TagChips::mouseExit (const juce::MouseEvent&)
{
    if (! std::exchange (is_held, false)) return;
    if (pending) show (*std::exchange (pending, std::nullopt));
    if (onResize) onResize();
}

}   // namespace tactus::host
