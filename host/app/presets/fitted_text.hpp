// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/fitted_text.hpp>

namespace tactus::host
{

/// Draws wrapped text. Text that is too long for the area ends after a whole word, with an ellipsis.
inline void drawFittedText (juce::Graphics& g, const juce::String& text, const juce::Font& font, juce::Colour colour, juce::Rectangle<int> area)
{
    const auto layOut = [&] (const juce::String& s) { return wrapText (s, font, colour, static_cast<float> (area.getWidth())); };
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
