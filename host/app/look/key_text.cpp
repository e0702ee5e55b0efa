// SPDX-License-Identifier: GPL-3.0-or-later
#include "key_text.hpp"

#include <host/app/text/filled.hpp>

#include <array>
#include <utility>

namespace tactus::host
{

juce::String keyText (const juce::String& described)
{
    static constexpr std::array<std::pair<const char*, const char*>, 14> names { {
        { "spacebar", NEEDS_TRANS ("Space") },
        { "return", NEEDS_TRANS ("Enter") },
        { "escape", NEEDS_TRANS ("Esc") },
        { "page up", NEEDS_TRANS ("Page Up") },
        { "page down", NEEDS_TRANS ("Page Down") },
        { "insert", NEEDS_TRANS ("Insert") },
        { "delete", NEEDS_TRANS ("Delete") },
        { "backspace", NEEDS_TRANS ("Backspace") },
        { "home", NEEDS_TRANS ("Home") },
        { "tab", NEEDS_TRANS ("Tab") },
        { "cursor left", NEEDS_TRANS ("Left") },
        { "cursor right", NEEDS_TRANS ("Right") },
        { "cursor up", NEEDS_TRANS ("Up") },
        { "cursor down", NEEDS_TRANS ("Down") },
    } };
    static constexpr std::array<std::pair<const char*, const char*>, 3> modifiers { {
        { "ctrl", NEEDS_TRANS ("Ctrl") },
        { "alt", NEEDS_TRANS ("Alt") },
        { "shift", NEEDS_TRANS ("Shift") },
    } };
    juce::String text, rest = described.trim();
    for (const auto& [modifier, name] : modifiers)
        if (rest.startsWithIgnoreCase (juce::String (modifier) + " +"))
        {
            text << juce::translate (name) << "+";
            rest = rest.fromFirstOccurrenceOf ("+", false, false).trim();
        }
    for (const auto& [from, to] : names)
        if (rest.equalsIgnoreCase (from)) return text + juce::translate (to);
    return text + rest.substring (0, 1).toUpperCase() + rest.substring (1);
}

}   // namespace tactus::host
