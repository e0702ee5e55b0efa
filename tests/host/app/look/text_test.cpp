// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/look/fitted_text.hpp>
#include <host/app/look/look.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

using namespace tactus::host;

namespace
{
struct Fonts
{
    juce::ScopedJuceInitialiser_GUI gui;
    Look look;
    juce::Font font = look.font (12.0f);

    float width (const juce::String& text) const { return font.getStringWidthFloat (text); }
};

const juce::String gap = juce::String::fromUTF8 ("\xe2\x80\xa6");

juce::String randomPath()
{
    const auto name = [] { return juce::String (*rc::gen::container<std::string> (*rc::gen::inRange<std::size_t> (1, 24), rc::gen::inRange ('a', 'z'))); };
    juce::String path;
    for (int i = *rc::gen::inRange (0, 9); --i >= 0;)
        path << "/" << name();
    return path + "/" + name() + ".json";
}
}   // namespace

TEST_CASE ("a path is as wide as there is room, and keeps its ends as long as possible", "[app][look]")
{
    const Fonts f;
    tactus::test::property ("any path in any room", [&] {
        const auto path = randomPath();
        const float room = static_cast<float> (*rc::gen::inRange (30, 600));
        const auto shown = fittedPath (path, f.font, room);
        if (f.width (path) <= room)
        {
            RC_ASSERT (shown == path);
            return;
        }
        RC_ASSERT (f.width (shown) <= room);
        RC_ASSERT (shown.contains (gap));
        const auto name = path.fromLastOccurrenceOf ("/", false, false);
        if (f.width (gap + "/" + name) <= room) RC_ASSERT (shown.endsWith ("/" + name));
        const auto first = path.upToLastOccurrenceOf ("/", false, false).substring (1).upToFirstOccurrenceOf ("/", false, false);
        const auto ends = "/" + first + "/" + gap + "/" + name;
        if (first.isNotEmpty() && f.width (ends) <= room) RC_ASSERT (shown.startsWith ("/" + first + "/" + gap));
    });
    CHECK (fittedPath ("/data/anna/graphs/boards/oak.json", f.font, f.width ("/data/" + gap + "/oak.json") + 1.0f) == "/data/" + gap + "/oak.json");
    CHECK (fittedPath ("a_very_long_name.json", f.font, 60.0f).startsWith ("a_"));
    CHECK (fittedPath ("a_very_long_name.json", f.font, 60.0f).endsWith ("n"));
}

TEST_CASE ("the path in a line is shortened until the line fits, and the words around it stay", "[app][look]")
{
    const Fonts f;
    const juce::String text = "Saved /data/anna/My graphs/of boards/and of other things/oak.json in time";
    const auto shown = withFittedPath (text, f.font, 260.0f);
    CHECK (f.width (shown) <= 260.0f);
    CHECK (shown.startsWith ("Saved /data/" + gap));
    CHECK (shown.endsWith ("/oak.json in time"));
    CHECK (withFittedPath (text, f.font, 2000.0f) == text);
    CHECK (withFittedPath ("no path in this line", f.font, 20.0f) == "no path in this line");
}

TEST_CASE ("no line of wrapped text is wider than its area, also with a path in it", "[app][look]")
{
    const Fonts f;
    tactus::test::property ("any path in any width", [&] {
        const float width = static_cast<float> (*rc::gen::inRange (60, 400));
        const auto layout = wrapText ("Saved in " + randomPath() + ", not in the graph.", f.font, juce::Colours::black, width);
        for (int i = 0; i < layout.getNumLines(); ++i)
            RC_ASSERT (layout.getLine (i).getLineBoundsX().getLength() <= width + 1.0f);
    });
}
