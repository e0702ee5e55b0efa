// SPDX-License-Identifier: GPL-3.0-or-later
#include "family.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace tactus::host
{

namespace
{
/// The palette of Okabe and Ito again, because it is safe for colour-blind people. A tint is far fainter than a port, so the two are not confused.
juce::Colour hueOf (std::string_view family)
{
    constexpr std::array<std::pair<std::string_view, juce::uint32>, 13> hues { {
        { "friction", 0xffe69f00 },
        { "cut", 0xffd55e00 },
        { "deform", 0xff009e73 },
        { "contact", 0xff009e73 },
        { "coupling", 0xff009e73 },
        { "field", 0xff009e73 },
        { "texture", 0xffcc79a7 },
        { "vibration", 0xff8f6fd6 },
        { "shock", 0xff8f6fd6 },
        { "device", 0xff56b4e9 },
        { "safety", 0xffd55e00 },
        { "layer", 0xff0072b2 },
        { "graph", 0xff0072b2 },
    } };
    const auto found = std::ranges::find (hues, family, &std::pair<std::string_view, juce::uint32>::first);
    return juce::Colour (found == hues.end() ? 0xff98a4b3 : found->second);
}
}   // namespace

juce::Colour headerColour (const Theme& theme, std::string_view family)
{
    return theme.raised.interpolatedWith (hueOf (family), theme.is_dark ? 0.20f : 0.18f);
}

juce::Colour glyphColour (const Theme& theme, std::string_view family) { return hueOf (family).interpolatedWith (theme.text, theme.is_dark ? 0.35f : 0.45f); }

}   // namespace tactus::host
