// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

inline juce::String fromUtf8 (std::string_view s) { return juce::String::fromUTF8 (s.data(), static_cast<int> (s.size())); }

/// A path that is at most `room` pixels wide. Folders in the middle are left out first: "/data/â¦/session.json". The name of the file is
/// shortened only if it does not fit alone.
juce::String fittedPath (const juce::String& path, const juce::Font&, float room);

/// One line of text that is at most `room` pixels wide, if shortening the path in it is enough; else the text with the shortest path.
juce::String withFittedPath (const juce::String& text, const juce::Font&, float room);

/// Wraps text to a width. A word that is wider, such as a path, is shortened in the middle.
juce::TextLayout wrapText (const juce::String& text, const juce::Font&, juce::Colour, float width);

/// Draws wrapped text. Text that is too long for the area ends after a whole word, with an ellipsis.
void drawFittedText (juce::Graphics&, const juce::String& text, const juce::Font&, juce::Colour, juce::Rectangle<int> area);

}   // namespace tactus::host
