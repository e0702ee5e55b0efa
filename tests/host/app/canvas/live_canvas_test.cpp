// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;

namespace
{
PortCard cardAt (juce::Point<float> at, PointedPort::Side side)
{
    auto course = std::make_shared<Course>();
    for (int i = 0; i < 240; ++i)
        course->push_back ({ { std::sin (0.1 * i) }, { std::sin (0.1 * i) + 0.1 } });
    return { .where = { "drag.force", at, side },
             .title = "drag.force",
             .values = { "0.5 N" },
             .quantity = Quantity::force,
             .high = "1.1 N",
             .low = "-1 N",
             .seconds = "2 s",
             .course = std::move (course),
             .columns = 240 };
}

/// How many pixels of a row of the picture differ between two pictures.
int differing (const juce::Image& a, const juce::Image& b, juce::Rectangle<int> area)
{
    int count = 0;
    for (int y = area.getY(); y < area.getBottom(); ++y)
        for (int x = area.getX(); x < area.getRight(); ++x)
            count += a.getPixelAt (x, y) != b.getPixelAt (x, y) ? 1 : 0;
    return count;
}

/// Of a colour of a pixel.
int largestDifference (const juce::Image& a, const juce::Image& b)
{
    int largest = 0;
    for (int y = 0; y < a.getHeight(); ++y)
        for (int x = 0; x < a.getWidth(); ++x)
        {
            const auto p = a.getPixelAt (x, y), q = b.getPixelAt (x, y);
            for (const int d : { p.getRed() - q.getRed(), p.getGreen() - q.getGreen(), p.getBlue() - q.getBlue() })
                largest = std::max (largest, std::abs (d));
        }
    return largest;
}
}   // namespace

TEST_CASE ("a wire glows by how much it carries, and only that wire", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto all = rig.canvas->getLocalBounds();
    const auto picture = [&] { return rig.canvas->createComponentSnapshot (all); };
    const auto still = picture();
    const auto& wires = rig.canvas->scene().wires();
    const auto wire = std::ranges::find (wires, "touch.gain -> grain_felt.gain", &SceneWire::text);
    REQUIRE (wire != wires.end());
    const auto changedAt = [&] (int level) {
        LiveState live;
        live.levels[wire->id] = level;
        rig.canvas->showLive (live);
        return picture();
    };
    const auto low = changedAt (1), high = changedAt (LiveState::most_level);
    const auto along = wire->path().getBounds().expanded (6.0f).transformedBy (rig.canvas->view().transform()).getSmallestIntegerContainer();
    CHECK (differing (still, low, all) > 0);
    CHECK (differing (still, low, all) == differing (still, low, along));
    CHECK (differing (still, high, all) > differing (still, low, all));
    rig.canvas->showLive ({});
    CHECK (differing (still, picture(), all) == 0);
}

TEST_CASE ("a card is inside the canvas and next to its port, wherever the port is", "[app][canvas]")
{
    const juce::Rectangle<int> canvas (0, 0, 600, 400);
    using Side = PointedPort::Side;
    for (const auto side : { Side::left, Side::right, Side::below })
        for (const juce::Point<float> at : { juce::Point<float> (300, 200), { 2, 2 }, { 598, 2 }, { 2, 398 }, { 598, 398 } })
        {
            const auto bounds = boundsOf (cardAt (at, side), at, canvas);
            INFO (static_cast<int> (side) << " " << at.x << " " << at.y);
            CHECK (canvas.contains (bounds));
            CHECK_FALSE (bounds.contains (at.toInt()));
        }
}

TEST_CASE ("a card is painted over the graph, and not during a drag", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto all = rig.canvas->getLocalBounds();
    const auto still = rig.canvas->createComponentSnapshot (all);
    LiveState live;
    const auto at = rig.canvas->view().toCanvas ({ 600.0f, 400.0f });
    live.card = cardAt (at, PointedPort::Side::below);
    const auto place = boundsOf (*live.card, { 600.0f, 400.0f }, all);
    rig.canvas->showLive (live);
    const auto shown = rig.canvas->createComponentSnapshot (all);
    CHECK (differing (still, shown, place) > 1000);
    CHECK (differing (still, shown, all) - differing (still, shown, place.expanded (4)) == 0);

    rig.hand().press (rig.nowhere());
    CHECK (differing (still, rig.canvas->createComponentSnapshot (all), place) == 0);
    rig.hand().release (rig.nowhere());
}

TEST_CASE ("nodes show readable names of their ports", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    CHECK (rig.node ("grain").box.find (Role::param, "spatial_frequency")->label == "Spatial frequency");
    CHECK (rig.node ("drag").box.find (Role::param, "d_max")->label == "d max");
    CHECK (rig.node ("drag").box.find (Role::output, "force")->label == "Force");
}

TEST_CASE ("a part of the canvas is painted with the pixels that it has in the whole picture", "[app][canvas]")
{
    const auto [preset, zoom] = GENERATE (table<std::string, float> ({ { "dry_wood", 1.0f }, { "dry_wood", 2.5f }, { "padded_bench", 0.5f } }));
    CanvasRig rig { CanvasRig::preset (preset) };
    rig.canvas->view().zoom *= zoom;
    LiveState live;
    for (const auto& w : rig.canvas->scene().wires())
        live.levels[w.id] = LiveState::most_level;
    rig.canvas->showLive (live);
    const auto all = rig.canvas->getLocalBounds();
    const auto whole = rig.canvas->createComponentSnapshot (all);
    constexpr int size = 60;   // pixels; most wires are longer
    for (int y = 0; y + size <= all.getHeight(); y += size)
        for (int x = 0; x + size <= all.getWidth(); x += size)
        {
            const juce::Rectangle<int> area { x, y, size, size };
            INFO (preset << ", " << area.toString());
            CHECK (largestDifference (rig.canvas->createComponentSnapshot (area), whole.getClippedImage (area))
                   < 40);   // of 255; JUCE rounds edges where it clips, by up to 25
        }
}
