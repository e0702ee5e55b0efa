// SPDX-License-Identifier: MIT
// What a canvas shows of a graph when it is opened.
#include "host/app/support/canvas_rig.hpp"
#include "host/app/support/seen_text.hpp"

#include <host/app/canvas/minimap.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;

namespace
{
/// The canvas in a window of 1920x1080 at 200 %, 1024x700, 1280x720, 1920x1080 and 2560x1440.
constexpr std::pair<int, int> sizes[] { { 424, 240 }, { 488, 326 }, { 744, 346 }, { 1384, 706 }, { 2024, 1066 } };

/// The first device, from the left; the first node if all devices are in subgraphs.
const SceneNode& handIn (const Scene& scene)
{
    const auto isHand = [] (const SceneNode& n) { return n.type.starts_with ("device."); };
    return *std::ranges::min_element (scene.nodes(), {}, [&] (const SceneNode& n) { return std::pair (! isHand (n), n.at.x); });
}

bool shows (const std::vector<host::test::SeenText>& texts, const juce::String& word)
{
    return std::ranges::any_of (texts, [&] (const auto& t) { return t.text.contains (word); });
}
}   // namespace

TEST_CASE ("every preset opens so that its labels can be read, with the hand in view, and a map if there is more", "[app][canvas]")
{
    for (const auto& entry : std::filesystem::directory_iterator (std::filesystem::path (TACTUS_SOURCE_DIR) / "graphs"))
    {
        if (entry.path().extension() != ".json") continue;
        for (const auto& [width, height] : sizes)
        {
            INFO (entry.path().stem().string() << " in " << width << " x " << height);
            CanvasRig rig { loadGraph (entry.path()).graph };
            rig.canvas->setSize (width, height);
            rig.canvas->frameStart();
            const auto& view = rig.canvas->view();
            const auto& scene = rig.canvas->scene();
            CHECK (view.zoom >= View::readable);
            const auto window = rig.canvas->getLocalBounds().toFloat();
            const juce::Rectangle<float> seen { view.toCanvas (window.getTopLeft()), view.toCanvas (window.getBottomRight()) };
            CHECK (seen.contains (handIn (scene).bounds().getCentre()));
            // No room is wasted: in a direction in which the graph does not fit, the view does not go far beyond it.
            const auto all = scene.bounds().expanded (48.0f / view.zoom);
            CHECK ((seen.getWidth() > all.getWidth() || (seen.getX() >= all.getX() - 1.0f && seen.getRight() <= all.getRight() + 1.0f)));
            CHECK ((seen.getHeight() > all.getHeight() || (seen.getY() >= all.getY() - 1.0f && seen.getBottom() <= all.getBottom() + 1.0f)));
            CHECK (Minimap (scene, view, rig.canvas->getLocalBounds()).isShown() == ! seen.contains (scene.bounds()));
        }
    }
}

TEST_CASE ("in the smallest window, Dry wood opens with labels at its ports; Home shows all of it", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    rig.canvas->setSize (424, 240);
    CHECK (shows (host::test::readTexts (*rig.canvas), "Position"));
    rig.hand().key ("home");
    for (const auto& n : rig.canvas->scene().nodes())
        CHECK (rig.canvas->getLocalBounds().toFloat().contains (rig.canvas->view().toPixels (n.bounds().getCentre())));
    CHECK_FALSE (shows (host::test::readTexts (*rig.canvas), "Position"));
    rig.canvas->setSize (500, 250);   // it still shows all
    for (const auto& n : rig.canvas->scene().nodes())
        CHECK (rig.canvas->getLocalBounds().toFloat().contains (rig.canvas->view().toPixels (n.bounds().getCentre())));
}

TEST_CASE ("a node that appears out of view comes into view without making the labels unreadable", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    rig.canvas->setSize (424, 240);
    rig.canvas->frameStart();
    const auto right = rig.canvas->scene().bounds().getTopRight();
    rig.canvas->addNodeAt ("signal.lfo", { .at = right + juce::Point<float> (300.0f, 200.0f) });
    const auto& added = rig.canvas->scene().nodes().back();
    REQUIRE (added.type == "signal.lfo");
    CHECK (rig.canvas->getLocalBounds().toFloat().contains (rig.canvas->view().toPixels (added.bounds().getCentre())));
    CHECK (rig.canvas->view().zoom >= View::readable);
}

TEST_CASE ("inside a subgraph, the names of the exposed ports are in view", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    rig.canvas->select ({ rig.node ("grain").id, rig.node ("grain_felt").id });
    rig.hand().key ("g");
    const auto& nodes = rig.canvas->scene().nodes();
    const auto group = std::ranges::find_if (nodes, [] (const SceneNode& n) { return n.type.starts_with ("graph:"); });
    REQUIRE (group != nodes.end());
    rig.canvas->enter (*group);
    REQUIRE (rig.canvas->scene().exposed().size() >= 3);
    for (const auto& e : rig.canvas->scene().exposed())
    {
        INFO (e.name);
        CHECK (rig.canvas->getLocalBounds().toFloat().contains (rig.canvas->view().toPixels (e.label.getTopLeft())));
        CHECK (rig.canvas->getLocalBounds().toFloat().contains (rig.canvas->view().toPixels (e.label.getBottomRight())));
    }
}
