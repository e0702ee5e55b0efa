// SPDX-License-Identifier: GPL-3.0-or-later
#include "key_text.hpp"

#include <array>
#include <utility>

namespace tactus::host
{

juce::String keyText (const juce::String& described)
{
    static constexpr std::array<std::pair<const char*, const char*>, 6> names { {
        { "spacebar", "Space" },
        { "return", "Enter" },
        { "escape", "Esc" },
        { "page up", "Page Up" },
        { "page down", "Page Down" },
        { "insert", "Insert" },
    } };
    juce::String text, rest = described.trim();
    for (const char* modifier : { "ctrl", "alt", "shift" })
        if (rest.startsWithIgnoreCase (juce::String (modifier) + " +"))
        {
            text << juce::String (modifier).substring (0, 1).toUpperCase() << juce::String (modifier).substring (1) << "+";
            rest = rest.fromFirstOccurrenceOf ("+", false, false).trim();
        }
    for (const auto& [from, to] : names)
        if (rest.equalsIgnoreCase (from)) return text + to;
    if (rest.startsWithIgnoreCase ("cursor ")) rest = rest.substring (7);
    return text + rest.substring (0, 1).toUpperCase() + rest.substring (1);
}

}   // namespace tactus::host
