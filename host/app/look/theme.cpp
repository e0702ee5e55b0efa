// SPDX-License-Identifier: GPL-3.0-or-later
#include "theme.hpp"

#include <host/tools/figures/colours.hpp>

namespace tactus::host
{

juce::Colour Theme::of (Quantity q) const
{
    auto colour = colourFor (name (q));
    if (! is_dark) colour = onPaper (colour);
    return { colour.red, colour.green, colour.blue };
}

const Theme& Theme::dark()
{
    static const Theme theme {
        .canvas = juce::Colour (0xff14171b),
        .dots = juce::Colour (0xff262c34),
        .panel = juce::Colour (0xff1b1f25),
        .raised = juce::Colour (0xff232931),
        .hairline = juce::Colour (0xff2e3640),
        .text = juce::Colour (0xffe8ecf1),
        .dim = juce::Colour (0xff98a4b3),
        .accent = juce::Colour (0xff56b4e9),
        .warning = juce::Colour (0xffe69f00),
        .stop = juce::Colour (0xffe5484d),
        .axes = { juce::Colour (0xffff7a45), juce::Colour (0xff2fc48d), juce::Colour (0xff56b4e9) },
        .is_dark = true,
    };
    return theme;
}

const Theme& Theme::light()
{
    static const Theme theme {
        .canvas = juce::Colour (0xffeef1f4),
        .dots = juce::Colour (0xffd3d9e0),
        .panel = juce::Colour (0xfff8f9fb),
        .raised = juce::Colour (0xffffffff),
        .hairline = juce::Colour (0xffccd3db),
        .text = juce::Colour (0xff14171b),
        .dim = juce::Colour (0xff56616e),
        .accent = juce::Colour (0xff0072b2),
        .warning = juce::Colour (0xff9a5b00),
        .stop = juce::Colour (0xffc62a2f),
        .axes = { juce::Colour (0xffb34700), juce::Colour (0xff00724f), juce::Colour (0xff005f9e) },
        .is_dark = false,
    };
    return theme;
}

}   // namespace tactus::host
