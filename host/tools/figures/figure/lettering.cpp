// SPDX-License-Identifier: GPL-3.0-or-later
#include "lettering.hpp"

#include <algorithm>
#include <utility>

namespace tactus::host
{

namespace
{
bool isFigure (juce::juce_wchar c) noexcept
{
    return c >= '0' && c <= '9';
}
}   // namespace

juce::String textOf (std::string_view utf8)
{
    const auto bytes = static_cast<int> (utf8.size());
    if (juce::CharPointer_UTF8::isValidString (utf8.data(), bytes))
        return juce::String::fromUTF8 (utf8.data(), bytes);

    juce::String text;   // if it is not UTF-8, it is read as Latin-1, which has a character for every byte
    for (const char c : utf8)
        text += static_cast<juce::juce_wchar> (static_cast<unsigned char> (c));
    return text;
}

Lettering::Lettering (juce::Typeface::Ptr typeface, float height_px) : face (std::move (typeface)), size (height_px)
{
    for (juce::juce_wchar figure = '0'; figure <= '9'; ++figure)
        figure_width = std::max (figure_width, face->getStringWidth (juce::String::charToString (figure)));
}

/// The width of the text at a height of 1 and, on request, its outline on a baseline at 0.
float Lettering::layOut (const juce::String& text, juce::Path* outline) const
{
    juce::Array<int> glyphs;
    juce::Array<float> offsets;
    face->getGlyphPositions (text, glyphs, offsets);

    float pen = 0.0f;
    for (int i = 0; i < glyphs.size(); ++i)
    {
        const float natural = offsets[i + 1] - offsets[i];
        const float advance = isFigure (text[i]) ? figure_width : natural;

        if (juce::Path glyph; outline != nullptr && face->getOutlineForGlyph (glyphs[i], glyph))
            outline->addPath (glyph, juce::AffineTransform::translation (pen + 0.5f * (advance - natural), 0.0f));
        pen += advance;
    }
    return pen;
}

float Lettering::width (const juce::String& text) const
{
    return size * layOut (text, nullptr);
}

void Lettering::draw (juce::Graphics& graphics, const juce::String& text, juce::Point<float> at, Align align) const
{
    juce::Path outline;
    const float drawn = size * layOut (text, &outline);
    float before = 0.0f;
    if (align == Align::centre)
        before = 0.5f * drawn;
    if (align == Align::right)
        before = drawn;

    const float baseline = at.y + size * (face->getAscent() - 0.5f);
    graphics.fillPath (outline, juce::AffineTransform::scale (size).translated (at.x - before, baseline));
}

void Lettering::drawUpwards (juce::Graphics& graphics, const juce::String& text, juce::Point<float> at) const
{
    const juce::Graphics::ScopedSaveState restore (graphics);
    graphics.addTransform (juce::AffineTransform::rotation (-juce::MathConstants<float>::halfPi, at.x, at.y));
    draw (graphics, text, at, Align::centre);
}

juce::String Lettering::shortened (const juce::String& text, float width_px) const
{
    if (width (text) <= width_px)
        return text;

    const auto ellipsis = juce::String::charToString (0x2026);
    int kept = text.length();
    while (kept > 0 && width (text.substring (0, kept).trimEnd() + ellipsis) > width_px)
        --kept;
    return text.substring (0, kept).trimEnd() + ellipsis;
}

std::vector<juce::String> Lettering::wrapped (const juce::String& text, float width_px, std::size_t most_lines) const
{
    // Text longer than any line can show need not be measured letter by letter.
    constexpr int longest = 500;
    const auto words = juce::StringArray::fromTokens (text.substring (0, longest), " \t\r\n", "");

    std::vector<juce::String> lines;
    for (int i = 0; i < words.size(); ++i)
    {
        if (words[i].isEmpty())
            continue;

        const auto longer = lines.empty() ? words[i] : lines.back() + " " + words[i];
        if (! lines.empty() && width (longer) <= width_px)
            lines.back() = longer;
        else if (lines.size() < most_lines)
            lines.push_back (words[i]);
        else
            lines.back() = longer;
    }

    for (auto& line : lines)
        line = shortened (line, width_px);
    return lines;
}

}   // namespace tactus::host
