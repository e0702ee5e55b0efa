// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/look/component_colour.hpp>
#include <host/app/look/family.hpp>

#include "host/app/support/contrast.hpp"

#include <tactus/node/catalogue.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <set>
#include <string>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::contrast;

TEST_CASE ("x, y and z have three hues that can be read on every background, in both themes", "[app][look]")
{
    for (const auto* theme : { &Theme::dark(), &Theme::light() })
        for (std::size_t i = 0; i < 3; ++i)
        {
            INFO ("xyz"[i] << (theme->is_dark ? " dark" : " light"));
            const auto colour = componentColour (*theme, theme->text, i, 3);
            for (const auto& background : { theme->canvas, theme->panel, theme->raised })
                CHECK (contrast (colour, background) >= 4.5);
            const double apart = std::abs (static_cast<double> (colour.getHue() - componentColour (*theme, theme->text, (i + 1) % 3, 3).getHue()));
            CHECK (std::min (apart, 1.0 - apart) > 0.1);   // of the circle of hues
            CHECK (componentColour (*theme, theme->text, 0, 1) == theme->text);
        }
}

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
