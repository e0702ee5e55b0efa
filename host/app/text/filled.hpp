// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <concepts>
#include <span>
#include <string>
#include <string_view>

#include <juce_core/juce_core.h>

// The texts of the window are in English in the sources, in TRANS or NEEDS_TRANS. TRANS ("Save") is the text in the language of the user.
// NEEDS_TRANS ("Save") is the English text, such as in a table, for juce::translate where it is shown. Messages of other code, names and
// numbers are not translated.

namespace tactus::host
{

/// A text in which %1 is replaced by the first value, %2 by the second, and so on. A translation may change their order, and may use a
/// value more than once. What is in the values stays as it is. A % without a value stays, too. [any thread]
juce::String filledWith (const juce::String& text, std::span<const juce::String> values);

/// A value as filled() writes it. Text is UTF-8.
inline juce::String valueText (const juce::String& s) { return s; }
juce::String valueText (std::integral auto n)
{
    return juce::String (static_cast<juce::int64> (n));
}
juce::String valueText (const std::convertible_to<std::string_view> auto& s)
{
    const std::string_view text (s);
    return juce::String::fromUTF8 (text.data(), static_cast<int> (text.size()));
}

/// Like filledWith: filled (TRANS ("Stopped after %1 ticks"), n).
template <typename... Values>
juce::String filled (const juce::String& text, const Values&... values)
{
    const std::array<juce::String, sizeof...(Values)> all { valueText (values)... };
    return filledWith (text, all);
}

/// The same text, kept until the program ends: for sheets of numbers, which only refer to their texts. [any thread]
std::string_view lasting (const juce::String&);

}   // namespace tactus::host
