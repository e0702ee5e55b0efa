// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"
#include "host/app/support/desk_stage.hpp"

#include "support/sketch.hpp"

#include <host/tools/figures/figure/vector_canvas.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <utility>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;
using host::test::DeskStage;
using tactus::test::Sketch;

namespace
{
/// Notes what a component asks to be painted again.
struct Asked final : juce::CachedComponentImage
{
    juce::RectangleList<int>& areas;
    juce::Component& of;

    Asked (juce::RectangleList<int>& a, juce::Component& c) : areas (a), of (c) {}
    void paint (juce::Graphics&) override {}
    bool invalidateAll() override
    {
        areas.add (of.getLocalBounds());
        return false;
    }
    bool invalidate (const juce::Rectangle<int>& area) override
    {
        areas.add (area);
        return false;
    }
    void releaseResources() override {}
};

int areaOf (const juce::RectangleList<int>& areas)
{
    int sum = 0;
    for (const auto& a : areas)
        sum += a.getWidth() * a.getHeight();
    return sum;
}

/// How many of the paths of an SVG are more than a box.
int curvesIn (const std::string& svg)
{
    constexpr std::size_t box = 120;   // characters
    int n = 0;
    for (auto at = svg.find ("<path"); at != std::string::npos; at = svg.find ("<path", at + 1))
        n += svg.find ("/>", at) - at > box;
    return n;
}
}   // namespace

TEST_CASE ("after an edit, a canvas paints again only what it changes", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    juce::RectangleList<int> asked;
    rig.canvas->setVisible (true);
    rig.canvas->setCachedComponentImage (new Asked (asked, *rig.canvas));
    const auto whole = rig.canvas->getWidth() * rig.canvas->getHeight();
    const auto boxOf = [&] (const std::string& name) {
        return rig.node (name).bounds().transformedBy (rig.canvas->view().transform()).getSmallestIntegerContainer();
    };
    const auto performs = [&] (graph::Command command) {
        asked.clear();
        REQUIRE (rig.document.perform (std::move (command)));
    };
    SECTION ("a value: its node")
    {
        performs (graph::SetParam { "", "grain", "angle", Json (0.1) });
        CHECK (asked.containsRectangle (boxOf ("grain")));
        CHECK (areaOf (asked) < whole / 4);
        asked.clear();
        rig.document.undo();
        CHECK (asked.containsRectangle (boxOf ("grain")));
    }
    SECTION ("a place: where the node was, where it is, and its wires")
    {
        const auto before = boxOf ("drag");
        rig.canvas->select ({ rig.node ("drag").id });
        asked.clear();
        rig.canvas->commands().nudgeSelection ({ 8.0f, 0.0f });
        CHECK (asked.containsRectangle (before));
        CHECK (asked.containsRectangle (boxOf ("drag")));
    }
    SECTION ("nothing that is shown: nothing")
    {
        performs (graph::SetHeader { .name = "Another" });
        CHECK (asked.isEmpty());
    }
    SECTION ("a node that goes: the place where it was")
    {
        const auto before = boxOf ("drag");
        performs (graph::RemoveNode { "", "drag" });
        CHECK (asked.containsRectangle (before));
    }
    rig.canvas->setCachedComponentImage (nullptr);
}

namespace
{
/// A patch with very many wires, one of which ends at each node but the first.
graph::Graph crowded()
{
    constexpr int wires = 600;
    Sketch sketch;
    sketch.node ("from", "signal.constant");
    for (int i = 0; i < wires; ++i)
        sketch.node ("to" + std::to_string (i), "signal.lfo").wire ("from.value -> to" + std::to_string (i) + ".frequency");
    return sketch.graph;
}

juce::Image pictureOf (juce::Component& c) { return c.createComponentSnapshot (c.getLocalBounds()); }

/// How many pixels differ by more than rounding does.
int pixelsThatDiffer (const juce::Image& a, const juce::Image& b)
{
    constexpr int rounding = 40;   // of 255; JUCE rounds edges where it clips, by up to 25
    int n = 0;
    for (int y = 0; y < a.getHeight(); ++y)
        for (int x = 0; x < a.getWidth(); ++x)
        {
            const auto p = a.getPixelAt (x, y), q = b.getPixelAt (x, y);
            n += std::max ({ std::abs (p.getRed() - q.getRed()), std::abs (p.getGreen() - q.getGreen()), std::abs (p.getBlue() - q.getBlue()) }) > rounding;
        }
    return n;
}
}   // namespace

TEST_CASE ("a scene in which nodes have moved is like one that is made from scratch", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto* face = rig.node ("drag").face.get();
    rig.canvas->select ({ rig.node ("drag").id });
    rig.canvas->commands().nudgeSelection ({ 48.0f, 80.0f });
    CHECK (rig.node ("drag").face.get() == face);   // what has not changed is not made again
    const Canvas other (rig.document, catalogue());
    const auto &moved = rig.canvas->scene(), &scratch = other.scene();
    REQUIRE (moved.nodes().size() == scratch.nodes().size());
    for (std::size_t i = 0; i < moved.nodes().size(); ++i)
    {
        CHECK (moved.nodes()[i].bounds() == scratch.nodes()[i].bounds());
        CHECK (moved.nodes()[i].carried == scratch.nodes()[i].carried);
    }
    REQUIRE (moved.wires().size() == scratch.wires().size());
    for (std::size_t i = 0; i < moved.wires().size(); ++i)
        CHECK (moved.wires()[i].path() == scratch.wires()[i].path());
    REQUIRE (rig.document.perform (graph::SetParam { "", "drag", "d_max", Json (0.001) }));
    CHECK (rig.node ("drag").face.get() != face);
}

TEST_CASE ("a patch that has very many wires keeps a picture of them, and paints only squares of it again that have changed", "[app][canvas]")
{
    CanvasRig rig { crowded() };
    auto& canvas = *rig.canvas;
    canvas.frameAll();
    auto painted = [&, last = std::size_t {}]() mutable {
        pictureOf (canvas);
        return canvas.below().squaresPainted() - std::exchange (last, canvas.below().squaresPainted());
    };
    const auto looksAsNew = [&] {
        Canvas other (rig.document, catalogue());
        other.setBounds (canvas.getBounds());
        other.view() = canvas.view();
        other.select (canvas.selection());
        return pixelsThatDiffer (pictureOf (canvas), pictureOf (other));
    };
    const auto all = painted();
    REQUIRE (all == canvas.below().squares());
    CHECK (painted() == 0);

    canvas.commands().nudgeSelection ({ 8.0f, 0.0f });   // nothing is selected
    CHECK (painted() == 0);
    canvas.select ({ rig.node ("to7").id });   // its wire is now above the others
    CHECK (painted() < all / 2);
    canvas.commands().nudgeSelection ({ 0.0f, 800.0f });
    CHECK (painted() == 0);
    CHECK (looksAsNew() == 0);

    rig.document.undo();
    CHECK (painted() == 0);
    canvas.select ({});
    const auto let_go = painted();
    CHECK (let_go > 0);
    CHECK (let_go < all / 2);
    CHECK (looksAsNew() == 0);

    REQUIRE (rig.document.perform (graph::RemoveNode { "", "to300" }));
    CHECK (painted() < all / 2);
    CHECK (looksAsNew() == 0);

    canvas.select ({ rig.node ("from").id });   // too many of its wires are beside it
    CHECK (painted() == 0);
    canvas.view().origin.x += 40.0f;
    CHECK (painted() == all);
    CHECK (looksAsNew() == 0);
}

TEST_CASE ("the wires of a patch that has very many are painted several at a time", "[app][canvas]")
{
    CanvasRig rig { crowded() };
    constexpr std::size_t wires = 600;
    REQUIRE (rig.canvas->scene().wires().size() == wires);
    const auto pathsIn = [&] (const Highlights& highlights) {
        const auto area = rig.canvas->scene().bounds();
        VectorCanvas shapes (area.getWidth(), area.getHeight());
        juce::Graphics g (shapes);
        View view;
        view.zoom = 0.1f;   // nodes are boxes without names
        paintScene (g, rig.canvas->scene(), view, lookOf (*rig.canvas), highlights);
        return curvesIn (shapes.svg ("", 96.0));
    };
    const auto few = pathsIn ({});
    CHECK (few > 0);
    CHECK (few < static_cast<int> (wires) / 3);
    Highlights marked;
    marked.selected.insert (rig.canvas->scene().wires()[7].id);
    CHECK (pathsIn (marked) > few);   // a selected one is on top of the others, alone
}

TEST_CASE ("while a node is dragged, the others are painted from pictures, which look as they do", "[app][canvas][paint]")
{
    DeskStage w ("layered_cloth.json", 1280, 720);
    auto& canvas = w.canvas;
    canvas.toggleMap();
    const auto bounds = canvas.getLocalBounds();
    const auto paintedNow = [&] { return canvas.createComponentSnapshot (bounds, true, 1.0f); };
    const auto asNew = [&] {
        juce::Image image (juce::Image::RGB, bounds.getWidth(), bounds.getHeight(), true, juce::SoftwareImageType());
        juce::Graphics g (image);
        paintGrid (g, canvas.view(), bounds, lookOf (canvas).theme());
        paintScene (g, canvas.scene(), canvas.view(), lookOf (canvas), canvas.highlighted());
        return image;
    };
    // Glyphs are placed to a 256th of a pixel, which is rounded from another corner in a picture: some of their edges differ a little.
    const auto looksAsNew = [&] {
        const auto a = paintedNow(), b = asNew();
        int most = 0, differing = 0;
        for (int y = 0; y < bounds.getHeight(); ++y)
            for (int x = 0; x < bounds.getWidth(); ++x)
            {
                const auto p = a.getPixelAt (x, y), q = b.getPixelAt (x, y);
                const int by = std::max ({ std::abs (p.getRed() - q.getRed()), std::abs (p.getGreen() - q.getGreen()), std::abs (p.getBlue() - q.getBlue()) });
                most = std::max (most, by);
                differing += by > 2 ? 1 : 0;
            }
        INFO (differing << " pixels differ by up to " << most << " of 255");
        CHECK (most <= 24);
        CHECK (differing < 200);
    };
    const auto& dragged = canvas.scene().nodes().front();
    const auto from = w.onStage (dragged.at + juce::Point<float> (20.0f, 0.5f * Box::header_height));
    w.stage->move (from);
    w.stage->press();
    for (int step = 1; step <= 6; ++step)
    {
        w.stage->move (from.translated (30.0f * static_cast<float> (step), 10.0f * static_cast<float> (step)));
        looksAsNew();
    }
    CHECK (canvas.pictures().size() > 3);
    CHECK (canvas.pictures().size() < canvas.scene().nodes().size());   // the dragged one has none
    w.stage->release();
    looksAsNew();
    CHECK (canvas.pictures().size() == 0);
}
