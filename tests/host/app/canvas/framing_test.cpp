// SPDX-License-Identifier: GPL-3.0-or-later
// What a canvas shows of a graph when it is opened.
#include "host/app/support/canvas_rig.hpp"
#include "host/app/support/seen_text.hpp"

#include <host/app/canvas/actions.hpp>
#include <host/app/canvas/minimap.hpp>
#include <host/app/layers/mixer.hpp>

#include <catch2/catch.hpp>

#include <set>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;

namespace
{
/// The canvas in a window of 1920x1080 at 200 %, 1024x700, 1280x720, 1920x1080 and 2560x1440.
constexpr std::pair<int, int> sizes[] { { 424, 200 }, { 488, 326 }, { 744, 346 }, { 1384, 706 }, { 2024, 1066 } };

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

TEST_CASE ("the map is in a corner without nodes, if there is one", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    auto& view = rig.canvas->view();
    const auto& scene = rig.canvas->scene();
    const auto window = rig.canvas->getLocalBounds().toFloat();
    const auto isFree = [&] (juce::Rectangle<float> place) {
        return std::ranges::none_of (scene.nodes(), [&] (const SceneNode& n) {
            const auto b = n.bounds();
            return place.intersects (juce::Rectangle<float> (view.toPixels (b.getTopLeft()), view.toPixels (b.getBottomRight())));
        });
    };
    view.zoom = 1.5f;
    int moved = 0;
    for (int x = -8; x <= 2; ++x)
        for (int y = -6; y <= 2; ++y)
        {
            view.origin = { 200.0f * static_cast<float> (x), 150.0f * static_cast<float> (y) };
            const auto place = Minimap (scene, view, rig.canvas->getLocalBounds()).bounds();
            REQUIRE_FALSE (place.isEmpty());
            CHECK (window.contains (place));
            const auto left = place.withX (window.getRight() - place.getRight()), up = place.withY (window.getBottom() - place.getBottom());
            const auto across = left.withY (up.getY());
            CHECK ((isFree (place) || (! isFree (left) && ! isFree (up) && ! isFree (across))));
            moved += static_cast<int> (place.getCentreX() < window.getCentreX() || place.getCentreY() < window.getCentreY());
        }
    CHECK (moved > 0);
}

TEST_CASE ("in the smallest window, Dry wood opens with labels at its ports, and Home shows all of it", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    rig.canvas->setSize (424, 200);
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
    rig.canvas->commands().addNodeAt ("signal.lfo", { .at = right + juce::Point<float> (300.0f, 200.0f) });
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

TEST_CASE ("undoing an edit that moved the view moves it back, and redoing it moves it again", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    rig.canvas->setSize (424, 200);
    rig.canvas->frameStart();
    const auto before = rig.canvas->view();
    rig.canvas->commands().addNodeAt ("signal.lfo", { .at = rig.canvas->scene().bounds().getTopRight() + juce::Point<float> (300.0f, 200.0f) });
    const auto after = rig.canvas->view();
    REQUIRE_FALSE (after == before);
    rig.document.undo();
    CHECK (rig.canvas->view() == before);
    rig.document.redo();
    CHECK (rig.canvas->view() == after);
}

TEST_CASE ("after the user has moved the view, an undo moves it only if nothing that has changed is in view", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto change = [&] (const char* value) { REQUIRE (rig.document.perform (graph::SetParam { {}, "drag", "d_max", Json (value) })); };
    const auto isSeen = [&] { return rig.canvas->getLocalBounds().toFloat().contains (rig.canvas->view().toPixels (rig.node ("drag").bounds().getCentre())); };
    change ("0.5 mm");
    rig.canvas->view().origin += juce::Point<float> (30.0f, 10.0f);
    const auto moved = rig.canvas->view();
    rig.document.undo();
    CHECK (rig.canvas->view() == moved);
    rig.document.redo();
    CHECK (rig.canvas->view() == moved);

    rig.canvas->view().origin += juce::Point<float> (9000.0f, 0.0f);
    REQUIRE_FALSE (isSeen());
    change ("0.6 mm");
    CHECK_FALSE (isSeen());   // an edit in another panel leaves the view alone
    rig.document.undo();
    CHECK (isSeen());
    const auto shown = rig.canvas->view();
    rig.document.redo();
    CHECK (rig.canvas->view() == shown);
}

TEST_CASE ("a mixer is placed left of what it feeds and right of what it mixes, with room around it", "[app][canvas][layers]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    REQUIRE (rig.canvas->commands().perform (placeNodes (rig.graph(), {}, { { rig.node ("motor").id, rig.node ("motor").at } })));   // stores all positions
    const auto text = rig.text();
    auto mixer = addMixer (rig.graph(), catalogue());
    REQUIRE (mixer);
    REQUIRE (rig.document.perform (std::move (mixer->command)));
    const auto desk = mixer->place.node;
    auto layer = addLayer (rig.graph(), mixer->place, catalogue(), "texture.grating");
    REQUIRE (layer);
    REQUIRE (rig.document.perform (std::move (layer->command)));
    const auto& scene = rig.canvas->scene();
    for (const auto& w : scene.wires())
    {
        INFO (w.text);
        const auto &from = scene.nodes()[static_cast<std::size_t> (w.start)], &to = scene.nodes()[static_cast<std::size_t> (w.end)];
        if (from.name == desk || to.name == desk || from.name == "grating") CHECK (from.bounds().getRight() + 48.0f <= to.at.x);
    }
    for (const auto& a : scene.nodes())
        for (const auto& b : scene.nodes())
        {
            INFO (a.name << ", " << b.name);
            if (a.id != b.id) CHECK_FALSE (a.bounds().expanded (16.0f).intersects (b.bounds()));
        }
    rig.document.undo();
    rig.document.undo();
    CHECK (rig.text() == text);
}

TEST_CASE ("a canvas that is zoomed out shows names without labels and sockets, then coloured boxes", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto show = [&] (float zoom) {
        rig.canvas->view().zoom = zoom;
        rig.canvas->view().centreOn (rig.canvas->scene().bounds().getCentre(), rig.canvas->getLocalBounds().toFloat());
        return rig.canvas->createComponentSnapshot (rig.canvas->getLocalBounds());
    };
    // The colours of a node's body, without its edge and the rest of the wires that end at it.
    const auto coloursOf = [&] (const juce::Image& image, const std::string& name) {
        const auto& view = rig.canvas->view();
        const auto box = rig.node (name).bounds();
        const auto inside = juce::Rectangle<float> (view.toPixels (box.getTopLeft()), view.toPixels (box.getBottomRight())).reduced (2.0f).toNearestInt();
        std::set<juce::uint32> all;
        for (int y = inside.getY(); y < inside.getBottom(); ++y)
            for (int x = inside.getX(); x < inside.getRight(); ++x)
                all.insert (image.getPixelAt (x, y).getARGB());
        return all;
    };
    const auto socketsIn = [&] (const juce::Image& image) {
        int count = 0;
        const auto place = rig.port ("board", Role::output, "force").toInt();   // the half of the socket that lies on the node
        for (int x = place.x - 2; x < place.x; ++x)
            count += image.getPixelAt (x, place.y) == lookOf (*rig.canvas).theme().of (Quantity::force);
        return count;
    };
    CHECK (socketsIn (show (0.6f)) > 0);
    CHECK (shows (host::test::readTexts (*rig.canvas), "Position"));
    CHECK (socketsIn (show (0.3f)) == 0);
    CHECK (shows (host::test::readTexts (*rig.canvas), "board"));
    CHECK_FALSE (shows (host::test::readTexts (*rig.canvas), "Position"));
    const auto small = show (0.15f);
    for (const auto& n : rig.canvas->scene().nodes())
    {
        INFO (n.name);
        CHECK (coloursOf (small, n.name).size() == 1);
        CHECK_FALSE (shows (host::test::readTexts (*rig.canvas), n.name));
    }
    CHECK (coloursOf (small, "board") != coloursOf (small, "drag"));   // another family

    rig.canvas->select ({ rig.node ("board").id });   // still shows what is selected
    const auto box = rig.node ("board").bounds();
    const auto selected = show (0.15f);
    const auto corner = rig.canvas->view().toPixels (box.getTopLeft()).toInt();
    CHECK (selected.getPixelAt (corner.x, corner.y) == lookOf (*rig.canvas).theme().accent);
}

TEST_CASE ("all of a graph with two thousand nodes can be seen at once", "[app][canvas]")
{
    graph::Graph g;
    for (int i = 0; i < 2000; ++i)
    {
        auto& node = g.root.nodes.emplace_back();
        node.name = "n" + std::to_string (i);
        node.type = "signal.gain";
    }
    CanvasRig rig { std::move (g) };
    rig.hand().key ("home");
    const auto& view = rig.canvas->view();
    const auto all = rig.canvas->scene().bounds();
    CHECK (rig.canvas->getLocalBounds().toFloat().contains (juce::Rectangle<float> (view.toPixels (all.getTopLeft()), view.toPixels (all.getBottomRight()))));
    CHECK (view.zoom * rig.canvas->scene().nodes().front().box.width > 4.0f);   // pixels
}

TEST_CASE ("a subgraph is where its nodes were, and grouping is one step", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto before = rig.text();
    for (const char* name : { "board", "drag", "grain" })
    {
        INFO (name);
        const auto place = rig.node (name).bounds();
        rig.canvas->select ({ rig.node (name).id });
        rig.hand().key ("g");
        const auto made = rig.node ("group").bounds();
        CHECK (place.contains (made.getCentre()));
        for (const auto& n : rig.canvas->scene().nodes())
            if (n.name != "group") CHECK_FALSE (n.bounds().intersects (made));
        rig.hand().key ("ctrl + z");
        CHECK (rig.text() == before);
    }
}

TEST_CASE ("nodes that are added without a wire make a row that can be read, with the hand at its left", "[app][canvas]")
{
    CanvasRig rig;
    rig.canvas->setSize (744, 346);
    rig.canvas->frameStart();
    const auto add = [&] (const char* type) {
        rig.canvas->commands().addNodeAt (type, { rig.canvas->view().toCanvas ({ 320.0f, 230.0f }) });   // the pointer stays where it is
    };
    for (const auto* type : { "deform.plane", "friction.elasto_plastic", "device.position", "device.force", "texture.grating" })
        add (type);
    const auto& nodes = rig.canvas->scene().nodes();
    REQUIRE (nodes.size() == 5);
    CHECK (rig.canvas->view().zoom >= View::readable);
    const auto window = rig.canvas->getLocalBounds().toFloat();
    for (const auto& n : nodes)
    {
        INFO (n.name);
        CHECK (window.contains (rig.canvas->view().toPixels (n.bounds().getTopLeft())));
        CHECK (window.contains (rig.canvas->view().toPixels (n.bounds().getBottomRight())));
        for (const auto& other : nodes)
            CHECK ((other.id == n.id || ! other.bounds().intersects (n.bounds())));
        if (n.name != "hand") CHECK (rig.node ("hand").at.x < n.at.x);
    }
}

TEST_CASE ("nodes that are added with the keyboard make rows whose labels can be read", "[app][canvas]")
{
    CanvasRig rig;
    rig.canvas->setSize (744, 400);
    rig.canvas->frameStart();
    std::vector<juce::Point<float>> places;
    for (int i = 0; i < 8; ++i)
    {
        rig.hand().key ("spacebar");
        REQUIRE (rig.request);
        rig.canvas->commands().addNodeAt ("friction.elasto_plastic", *rig.request);
        places.push_back (rig.canvas->scene().nodes().back().at);
        CHECK (rig.canvas->view().zoom >= View::readable);
    }
    CHECK (places[0].y == places[1].y);
    CHECK (places[1].y == places[2].y);
    CHECK (places[0].x < places[1].x);
    CHECK (places[1].x < places[2].x);
    CHECK (places.back().y > places.front().y);
}

TEST_CASE ("a new node covers no other one, however large it is, and one undo removes it", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto& board = rig.node ("board").bounds();
    // A node of the usual size fits into the gap above the board. These do not.
    const auto gap = board.getPosition().translated (0.0f, -104.0f);
    for (const auto& type : rig.canvas->types())
    {
        const auto before = rig.text();
        std::set<graph::Id> old;
        for (const auto& n : rig.canvas->scene().nodes())
            old.insert (n.id);
        rig.canvas->commands().addNodeAt (std::string (type.info.id), { gap });
        for (const auto& made : rig.canvas->scene().nodes())
            for (const auto& n : rig.canvas->scene().nodes())
            {
                INFO (made.name << " and " << n.name);
                if (! old.contains (made.id) && n.id != made.id) CHECK_FALSE (made.bounds().intersects (n.bounds()));
            }
        rig.hand().key ("ctrl + z");
        CHECK (rig.text() == before);
    }
}

TEST_CASE ("in a view that the user has moved, a new node is still where it can be seen", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    rig.canvas->setSize (424, 400);
    rig.canvas->frameStart();
    const auto& board = rig.node ("board");
    rig.canvas->view().zoom = 1.0f;
    rig.canvas->view().centreOn (board.bounds().getCentre(), rig.canvas->getLocalBounds().toFloat());
    const auto before = rig.canvas->view();
    rig.canvas->commands().addNodeAt ("signal.lfo", { rig.node ("board").bounds().getCentre() });
    CHECK (rig.canvas->getLocalBounds().toFloat().contains (rig.canvas->view().toPixels (rig.node ("lfo").bounds().getCentre())));
    rig.hand().key ("ctrl + z");
    CHECK (rig.canvas->view() == before);
}

TEST_CASE ("an undo that removes the subgraph on the screen shows the graph around it", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    rig.canvas->setSize (744, 346);
    rig.canvas->frameStart();
    const auto before = rig.canvas->view();
    rig.canvas->select ({ rig.node ("board").id });
    rig.hand().key ("g");
    rig.hand().key ("return");
    REQUIRE (rig.canvas->breadcrumbs().size() == 1);
    REQUIRE_FALSE (rig.canvas->view() == before);
    rig.hand().key ("ctrl + z");
    CHECK (rig.canvas->breadcrumbs().empty());
    CHECK (rig.canvas->view() == before);
    rig.hand().key ("ctrl + y");
    CHECK (rig.canvas->view() == before);
}
