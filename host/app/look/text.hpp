// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

inline juce::String fromUtf8 (std::string_view s) { return juce::String::fromUTF8 (s.data(), static_cast<int> (s.size())); }

/// Wraps text to a width.
inline juce::TextLayout wrapText (const juce::String& text, const juce::Font& font, juce::Colour colour, float width)
{
    juce::AttributedString s;
    s.append (text, font, colour);
    juce::TextLayout layout;
    layout.createLayout (s, width);
    return layout;
}

}   // namespace tactus::host
