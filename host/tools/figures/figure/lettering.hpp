// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_graphics/juce_graphics.h>

#include <string_view>
#include <vector>

namespace tactus::host
{

/// Text from a file, which may contain any bytes.
juce::String textOf (std::string_view utf8);

enum class Align
{
    left,
    centre,
    right
};

/// A typeface at one height, drawn as outlines. All digits are laid out with the same width, so that columns of numbers line
/// up: Inter has such digits, but JUCE 7 cannot select them.
class Lettering
{
public:
    Lettering (juce::Typeface::Ptr typeface, float height_px);

    float height() const noexcept { return size; }
    float width (const juce::String& text) const;

    /// Wraps the text at spaces. If it does not fit into this many lines, it ends in an ellipsis.
    std::vector<juce::String> wrapped (const juce::String& text, float width_px, std::size_t most_lines) const;

    /// Draws a line of text; `at.y` is the middle of the line.
    void draw (juce::Graphics& graphics, const juce::String& text, juce::Point<float> at, Align align) const;

    /// Draws text that runs from bottom to top; `at` is the middle of the text.
    void drawUpwards (juce::Graphics& graphics, const juce::String& text, juce::Point<float> at) const;

private:
    float layOut (const juce::String& text, juce::Path* outline) const;
    juce::String shortened (const juce::String& text, float width_px) const;

    juce::Typeface::Ptr face;
    float size;
    float figure_width = 0.0f;   // width of a digit at a height of 1
};

}   // namespace tactus::host
