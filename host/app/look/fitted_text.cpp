// SPDX-License-Identifier: GPL-3.0-or-later
#include "fitted_text.hpp"

namespace tactus::host
{

namespace
{
const juce::String dots = juce::String::fromUTF8 ("\xe2\x80\xa6");

/// The word with only its first and last characters, as many as fit.
juce::String withoutMiddle (const juce::String& before, const juce::String& word, const juce::Font& font, float room)
{
    for (int kept = word.length() - 1; kept > 1; --kept)
        if (const auto text = before + word.substring (0, kept / 2) + dots + word.substring (word.length() - (kept + 1) / 2);
            font.getStringWidthFloat (text) <= room)
            return text;
    return before + dots;
}
}   // namespace

juce::String fittedPath (const juce::String& path, const juce::Font& font, float room)
{
    const auto fits = [&] (const juce::String& text) { return font.getStringWidthFloat (text) <= room; };
    if (fits (path)) return path;
    const auto parts = juce::StringArray::fromTokens (path, "/", {});
    const int first = path.startsWithChar ('/') ? 2 : 1;   // the parts before the gap: "", "home"
    for (int next = first + 1; next < parts.size(); ++next)
        if (const auto text = parts.joinIntoString ("/", 0, first) + "/" + dots + "/" + parts.joinIntoString ("/", next); fits (text)) return text;
    const auto before = parts.size() > 1 ? dots + "/" : juce::String();
    const auto& name = parts[parts.size() - 1];
    return fits (before + name) ? before + name : withoutMiddle (before, name, font, room);
}

juce::String withFittedPath (const juce::String& text, const juce::Font& font, float room)
{
    const float over = font.getStringWidthFloat (text) - room;
    const int from = text.startsWithChar ('/') ? 0 : text.indexOf (" /") + 1;
    if (over <= 0.0f || text.indexOfChar (from, '/') < 0) return text;
    // The path ends with the word that has the last slash; before that, spaces belong to it.
    const int last = text.lastIndexOfChar ('/'), space = text.indexOfChar (last, ' ');
    const int to = space < 0 ? text.length() : space;
    const auto path = text.substring (from, to);
    const float rest = font.getStringWidthFloat (text) - font.getStringWidthFloat (path);
    return text.substring (0, from) + fittedPath (path, font, room - rest) + text.substring (to);
}

juce::TextLayout wrapText (const juce::String& text, const juce::Font& font, juce::Colour colour, float width)
{
    juce::AttributedString s;
    const auto add = [&] (const juce::String& part) { s.append (part, font, colour); };
    // InlineArray words are so long that they have to be measured.
    const auto mayBeWide = [&] (const juce::String& word) { return static_cast<float> (word.length()) * font.getHeight() > width; };
    int written = 0, begin = 0;
    for (int i = 0; i <= text.length(); ++i)
    {
        if (i < text.length() && ! juce::CharacterFunctions::isWhitespace (text[i])) continue;
        if (const auto word = text.substring (begin, i); mayBeWide (word) && font.getStringWidthFloat (word) > width)
        {
            add (text.substring (written, begin));
            add (fittedPath (word, font, width));
            written = i;
        }
        begin = i + 1;
    }
    add (text.substring (written));
    juce::TextLayout layout;
    layout.createLayout (s, width);
    return layout;
}

void drawFittedText (juce::Graphics& g, const juce::String& text, const juce::Font& font, juce::Colour colour, juce::Rectangle<int> area)
{
    const auto layOut = [&] (const juce::String& s) { return wrapText (s, font, colour, static_cast<float> (area.getWidth())); };
    auto shown = text;
    auto layout = layOut (shown);
    while (layout.getHeight() > static_cast<float> (area.getHeight()) && shown.containsChar (' '))
    {
        shown = shown.upToLastOccurrenceOf (" ", false, false).trimEnd();
        layout = layOut (shown.trimCharactersAtEnd (".,:;") + " " + dots);
    }
    if (layout.getHeight() <= static_cast<float> (area.getHeight())) layout.draw (g, area.toFloat());
}

}   // namespace tactus::host
