// SPDX-License-Identifier: GPL-3.0-or-later
#include "block.hpp"

#include <cmath>

namespace tactus::host
{

Words::Words (juce::String t, Kind k) : text (std::move (t)), kind (k) { setInterceptsMouseClicks (false, false); }

int Words::heightFor (int width) { return static_cast<int> (std::ceil (layout (width).getHeight())) + (kind == Kind::heading ? 14 : 6); }

void Words::paint (juce::Graphics& g)
{
    auto area = getLocalBounds().toFloat();
    if (kind == Kind::heading) area.removeFromTop (8.0f);
    layout (getWidth()).draw (g, area);
}

juce::TextLayout Words::layout (int width) const
{
    const auto& look = lookOf (*this);
    juce::AttributedString s;
    const bool strong = kind == Kind::title || kind == Kind::heading, bright = kind == Kind::title || kind == Kind::text;
    const float size = kind == Kind::title ? 16.0f : kind == Kind::text ? 13.0f
                                                                        : 12.0f;
    s.append (text, look.font (size, strong), bright ? look.theme().text : look.theme().dim);
    juce::TextLayout l;
    l.createLayout (s, static_cast<float> (width));
    return l;
}

void Column::add (std::unique_ptr<Block> b)
{
    addAndMakeVisible (*b);
    b->onHeight = [this]
    {
        if (onHeight) onHeight();
    };
    blocks.push_back (std::move (b));
}

void Column::add (const juce::String& words, Words::Kind kind)
{
    if (words.isNotEmpty()) add (std::make_unique<Words> (words, kind));
}

void Column::refresh (const graph::Node* node)
{
    for (auto& b : blocks)
        b->refresh (node);
}

void Column::layOut (int width)
{
    constexpr int margin = 16;
    int y = margin;
    for (auto& b : blocks)
    {
        const int h = b->heightFor (width - 2 * margin);
        b->setBounds (margin, y, width - 2 * margin, h);
        y += h;
    }
    setSize (width, y + margin);
}

}   // namespace tactus::host
