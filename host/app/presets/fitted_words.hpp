// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>

namespace tactus::host
{

/// Wraps a text into an area, and ends it with an ellipsis after a whole word where it is too long.
inline void drawFittedWords (juce::Graphics& g, const juce::String& text, const juce::Font& font, juce::Colour colour, juce::Rectangle<int> area)
{
    const auto layOut = [&] (const juce::String& words)
    {
        juce::AttributedString s;
        s.append (words, font, colour);
        juce::TextLayout layout;
        layout.createLayout (s, static_cast<float> (area.getWidth()));
        return layout;
    };
    auto shown = text;
    auto layout = layOut (shown);
    while (layout.getHeight() > static_cast<float> (area.getHeight()) && shown.containsChar (' '))
    {
        shown = shown.upToLastOccurrenceOf (" ", false, false).trimEnd();
        layout = layOut (shown.trimCharactersAtEnd (".,:;") + juce::String::fromUTF8 (" \xe2\x80\xa6"));
    }
    if (layout.getHeight() <= static_cast<float> (area.getHeight())) layout.draw (g, area.toFloat());
}

}   // namespace tactus::host
