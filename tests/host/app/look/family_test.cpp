// SPDX-License-Identifier: MIT
#include <host/app/look/family.hpp>

#include <tactus/node/catalogue.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <set>
#include <string>

using namespace tactus;
using namespace tactus::host;

namespace
{
/// The contrast of two colours after WCAG 2.1: 1 to 21.
double contrast (juce::Colour a, juce::Colour b)
{
    const auto light = [] (juce::Colour c) {
        const auto part = [] (float v) { return v <= 0.04045f ? v / 12.92 : std::pow ((static_cast<double> (v) + 0.055) / 1.055, 2.4); };
        return 0.2126 * part (c.getFloatRed()) + 0.7152 * part (c.getFloatGreen()) + 0.0722 * part (c.getFloatBlue());
    };
    return (std::max (light (a), light (b)) + 0.05) / (std::min (light (a), light (b)) + 0.05);
}
}   // namespace

TEST_CASE ("names and glyphs can be read on the header of every family, in both themes", "[app][look]")
{
    std::set<std::string> families { "graph", "unknown" };
    for (const auto& type : catalogue())
        families.insert (std::string (type.info.id.substr (0, type.info.id.find ('.'))));
    for (const auto* theme : { &Theme::dark(), &Theme::light() })
        for (const auto& family : families)
        {
            INFO (family << (theme->is_dark ? " dark" : " light"));
            const auto header = headerColour (*theme, family);
            CHECK (contrast (theme->text, header) >= 4.5);
            CHECK (contrast (glyphColour (*theme, family), header) >= 3.0);
            CHECK (header != theme->raised);
        }
}

TEST_CASE ("families that feel different have different headers", "[app][look]")
{
    const auto& theme = Theme::dark();
    CHECK (headerColour (theme, "friction") != headerColour (theme, "deform"));
    CHECK (headerColour (theme, "texture") != headerColour (theme, "vibration"));
    CHECK (headerColour (theme, "device") != headerColour (theme, "signal"));
    CHECK (headerColour (theme, "deform") == headerColour (theme, "contact"));
}
