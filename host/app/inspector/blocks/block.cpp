// SPDX-License-Identifier: GPL-3.0-or-later
#include "block.hpp"

#include <host/app/look/fitted_text.hpp>

#include <cmath>

namespace tactus::host
{

TextBlock::TextBlock (juce::String t, Kind k, const juce::String& tooltip) : text (std::move (t)), kind (k)
{
    setTooltip (tooltip);
    setInterceptsMouseClicks (tooltip.isNotEmpty(), false);
}

int TextBlock::heightFor (int width) { return static_cast<int> (std::ceil (layout (width).getHeight())) + (kind == Kind::heading ? 14 : 6); }

void TextBlock::paint (juce::Graphics& g)
{
    auto area = getLocalBounds().toFloat();
    if (kind == Kind::heading) area.removeFromTop (8.0f);
    layout (getWidth()).draw (g, area);
}

juce::TextLayout TextBlock::layout (int width) const
{
    const auto& look = lookOf (*this);
    const bool bold = kind == Kind::title || kind == Kind::heading, bright = kind == Kind::title || kind == Kind::text;
    float size = 12.0f;
    if (kind == Kind::title) size = 16.0f;
    if (kind == Kind::text) size = 13.0f;
    return wrapText (text, look.font (size, bold), bright ? look.theme().text : look.theme().dim, static_cast<float> (width));
}

void Column::add (std::unique_ptr<Block> b)
{
    addAndMakeVisible (*b);
    b->onHeight = [this] {
        if (onHeight) onHeight();
    };
    blocks.push_back (std::move (b));
}

void Column::add (const juce::String& text, TextBlock::Kind kind, const juce::String& tooltip)
{
    if (text.isNotEmpty()) add (std::make_unique<TextBlock> (text, kind, tooltip));
}

void Column::refresh (const graph::Node* node)
{
    for (auto& b : blocks)
        b->refresh (node);
}

void Column::refreshLive()
{
    for (auto& b : blocks)
        b->refreshLive();
}

int Column::heightFor (int width)
{
    int height = 2 * margins.vertical;
    for (auto& b : blocks)
        height += b->heightFor (inner (width));
    return height;
}

void Column::resized()
{
    const int width = inner (getWidth());
    int y = margins.vertical;
    for (auto& b : blocks)
    {
        const int height = b->heightFor (width);
        b->setBounds (margins.left, y, width, height);
        y += height;
    }
}

void Column::layOut (int width)
{
    const juce::Rectangle<int> size (width, heightFor (width));
    if (size == getLocalBounds()) return resized();
    setSize (size.getWidth(), size.getHeight());
}

}   // namespace tactus::host
