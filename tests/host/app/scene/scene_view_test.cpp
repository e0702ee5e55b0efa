// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/hand.hpp"
#include "host/app/support/seen_text.hpp"
#include "preset_bodies.hpp"

#include "support/waiting.hpp"

#include <host/app/run/views/hand_panel.hpp>
#include <tactus/graph/endpoint_text.hpp>

#include <catch2/catch.hpp>

#include <chrono>

using namespace tactus;
using namespace tactus::host;
using host::test::Hand;

namespace
{
struct Rig
{
    juce::ScopedJuceInitialiser_GUI juce_runs;
    struct Dressed
    {
        Look look;
        Dressed() { juce::LookAndFeel::setDefaultLookAndFeel (&look); }
        ~Dressed() { juce::LookAndFeel::setDefaultLookAndFeel (nullptr); }
    } dressed;
    Document document;
    Sound sound;
    DeviceSetup setup;
    Playback playback { document, catalogue(), sound, setup, [] {} };
    HandPanel panel { playback, sound };
    SceneView& view = panel.scene();
    Hand hand { view };

    explicit Rig (const std::string& preset) : document (host::test::presetGraph (preset))
    {
        panel.setSize (420, 300);
        panel.showScene (true);
        panel.refresh();
    }
    ~Rig() { playback.run().letGo(); }

    juce::Point<float> middle() const { return view.getLocalBounds().toFloat().getCentre(); }
    /// How far away the camera is when it shows everything from where it looks now.
    double framedDistance()
    {
        scene::Scene all;
        all.setBodies (playback.run().scene().bodies());
        auto framed = view.camera();
        framed.frame (all.bounds());
        return framed.distance;
    }

    juce::Image picture() { return view.createComponentSnapshot (view.getLocalBounds()); }

    /// Attends to the run until the condition holds.
    template <typename F>
    bool until (F&& isSo)
    {
        return tactus::test::eventually (std::chrono::milliseconds (2), [&] {
            playback.poll();
            panel.refresh();
            return isSo();
        });
    }
};
}   // namespace

TEST_CASE ("dragging turns the scene, with Shift it moves, and the wheel zooms", "[app][scene]")
{
    Rig rig { "liver" };
    const auto& camera = rig.view.camera();
    const double yaw = camera.yaw, pitch = camera.pitch, distance = camera.distance;
    rig.hand.drag (rig.middle(), rig.middle() + juce::Point<float> (40.0f, 20.0f));
    CHECK (camera.yaw < yaw);
    CHECK (camera.pitch > pitch);
    CHECK (camera.distance == distance);
    const Vec3 target = camera.target;
    const double turned = camera.yaw;
    rig.hand.drag (rig.middle(), rig.middle() + juce::Point<float> (40.0f, 0.0f), Hand::left (juce::ModifierKeys::shiftModifier));
    CHECK (camera.yaw == turned);
    CHECK ((camera.target - target).norm() > 1e-3);
    rig.hand.wheel (rig.middle(), 0.5f);
    CHECK (camera.distance < distance);
    rig.hand.doubleClick (rig.middle());
    CHECK (camera.distance == Approx (rig.framedDistance()));
}

TEST_CASE ("the keyboard does what the mouse does in the scene", "[app][scene]")
{
    Rig rig { "liver" };
    const auto& camera = rig.view.camera();
    const double yaw = camera.yaw, distance = camera.distance;
    CHECK (rig.view.keyPressed (juce::KeyPress (juce::KeyPress::leftKey)));
    CHECK (camera.yaw != yaw);
    CHECK (rig.view.keyPressed (juce::KeyPress ('+', {}, '+')));
    CHECK (camera.distance < distance);
    CHECK (rig.view.keyPressed (juce::KeyPress ('f', {}, 'f')));
    CHECK (camera.distance == Approx (rig.framedDistance()));
    CHECK (rig.view.keyPressed (juce::KeyPress ('t', {}, 't')));
    CHECK (rig.view.follows());
    CHECK_FALSE (rig.view.keyPressed (juce::KeyPress ('z', juce::ModifierKeys::ctrlModifier, 'z')));
    CHECK (rig.view.keyPressed (juce::KeyPress (juce::KeyPress::homeKey)));
    CHECK (camera.yaw == scene::Camera {}.yaw);
}

TEST_CASE ("a hidden scene asks the run for nothing", "[app][scene]")
{
    Rig rig { "liver" };
    auto& feed = rig.playback.run().scene();
    CHECK_FALSE (feed.ports().empty());
    rig.panel.setSeen (false);
    rig.panel.refresh();
    CHECK (feed.ports().empty());
    rig.panel.setSeen (true);
    rig.panel.refresh();
    CHECK_FALSE (feed.ports().empty());
    rig.panel.showScene (false);
    rig.panel.refresh();
    CHECK (feed.ports().empty());
    CHECK_FALSE (rig.view.isVisible());
    CHECK (rig.panel.view().isVisible());
}

TEST_CASE ("the scene shows what is on the surface before anything runs, and the tool while it runs", "[app][scene]")
{
    Rig rig { "dry_wood" };
    rig.picture();
    CHECK (rig.view.triangles().drawn > 1000);
    CHECK (rig.playback.run().scene().now().tools.empty());
    rig.playback.start ({ LiveRun::Hand::Kind::path, "stroke" });
    CHECK (rig.until ([&] {
        const auto now = rig.playback.run().scene().now();
        return ! now.tools.empty() && now.tools[0].force.norm() > 0.01;
    }));
    rig.picture();
    rig.playback.run().letGo();
    CHECK (rig.playback.run().scene().now().tools.empty());
}

TEST_CASE ("the scene gets the values of ports while it is watched, and of edits as they are made", "[app][scene]")
{
    Rig rig { "liver" };
    rig.playback.start ({});
    auto& feed = rig.playback.run().scene();
    const auto touch = [&] { return feed.now().of (0, &Appearance::touch).has_value(); };
    CHECK (rig.until (touch));
    const auto before = feed.version();
    rig.document.renew();
    CHECK (feed.version() > before);
}

TEST_CASE ("the scene shows nothing of the graph before if the one that is open cannot run", "[app][scene]")
{
    Rig rig { "dry_wood" };
    const bool has_run = GENERATE (false, true);
    if (has_run)
    {
        rig.playback.start ({ LiveRun::Hand::Kind::path, "stroke" });
        CHECK (rig.until ([&] { return rig.playback.run().isRunning(); }));
    }
    CHECK_FALSE (rig.playback.run().scene().bodies().empty());
    auto broken = host::test::presetGraph (GENERATE ("liver", "dry_wood"));   // with other devices, or with the same ones
    broken.root.wires.push_back (*graph::parseWire ("hand.position -> nowhere.position"));
    rig.document.open (broken, {}, "open");
    if (has_run) rig.playback.startOther ({});
    const auto isEmpty = [&] { return rig.playback.run().scene().bodies().empty() && ! rig.playback.run().isRunning(); };
    CHECK (rig.until (isEmpty));
    rig.panel.showScene (false);   // and not when it is shown again
    rig.panel.showScene (true);
    rig.panel.refresh();
    CHECK (isEmpty());
    const auto texts = host::test::readTexts (rig.view);
    CHECK (std::ranges::any_of (texts, [] (const auto& t) { return t.text == "Cannot run: see Problems."; }));
    rig.document.open (host::test::presetGraph ("liver"), {}, "open");
    CHECK_FALSE (rig.playback.run().scene().bodies().empty());
}

TEST_CASE ("dragging the tool in the scene presses with it", "[app][scene]")
{
    Rig rig { "dry_wood" };
    rig.playback.start (LiveRun::Hand::pointer());
    REQUIRE (rig.until ([&] { return ! rig.playback.run().scene().now().tools.empty(); }));
    const auto tool = [&] { return rig.playback.run().scene().now().tools[0]; };
    rig.panel.refresh();
    rig.hand.press (rig.view.camera().pixel (tool().position));
    CHECK (rig.until ([&] { return tool().force.z() > 0.05; }));
    rig.hand.wheel (rig.view.camera().pixel (tool().position), -2.0f);   // as deep as it goes, five times as deep as before
    CHECK (rig.until ([&] { return tool().position.z() < -1e-3; }));
    rig.hand.release (rig.view.camera().pixel (tool().position));
    CHECK (rig.until ([&] { return tool().force.z() < 0.05; }));
}

TEST_CASE ("a tool that is released above the horizon stops pressing", "[app][scene]")
{
    Rig rig { "dry_wood" };
    rig.playback.start (LiveRun::Hand::pointer());
    REQUIRE (rig.until ([&] { return ! rig.playback.run().scene().now().tools.empty(); }));
    rig.view.lookAlong (0);   // from the side, so that the upper half of the picture is above the horizon
    struct Steered
    {
        double x, y;
        bool presses;
    };
    std::vector<Steered> steered;
    rig.view.onSteer = [&] (double x, double y, bool presses) { steered.push_back ({ x, y, presses }); };
    const auto at = rig.view.camera().pixel (rig.playback.run().scene().now().tools[0].position);
    rig.panel.refresh();
    rig.hand.press (at);
    REQUIRE_FALSE (steered.empty());
    CHECK (steered.back().presses);
    rig.hand.dragTo ({ at.x, 2.0f });
    const auto last = steered.back();
    rig.hand.release ({ at.x, 2.0f });
    CHECK_FALSE (steered.back().presses);
    CHECK (steered.back().x == last.x);
    CHECK (steered.back().y == last.y);
}

TEST_CASE ("an enlarged scene is shown next to the view from above", "[app][scene]")
{
    Rig rig { "liver" };
    int laid_out = 0;
    rig.panel.onEnlarge = [&] {
        ++laid_out;
        rig.panel.setSize (1000, 600);
    };
    rig.panel.enlarge (true);
    CHECK (laid_out == 1);
    CHECK (rig.panel.view().isVisible());
    CHECK (rig.view.isVisible());
    CHECK_FALSE (rig.panel.view().getBounds().intersects (rig.view.getBounds()));
    rig.panel.showScene (false);
    CHECK_FALSE (rig.panel.isEnlarged());
}

TEST_CASE ("any visible part of the tool can be dragged, and the tool does not jump to the pointer", "[app][scene]")
{
    Rig rig { "dry_wood" };
    rig.playback.start (LiveRun::Hand::pointer());
    REQUIRE (rig.until ([&] { return ! rig.playback.run().scene().now().tools.empty(); }));
    rig.panel.refresh();
    const auto tool = rig.playback.run().scene().now().tools[0];
    std::vector<juce::Point<double>> steered;
    rig.view.onSteer = [&] (double x, double y, bool presses) {
        if (presses) steered.push_back ({ x, y });
    };
    scene::Scene all;
    all.setBodies (rig.playback.run().scene().bodies());
    const auto lines = all.linesOf (tool, rig.view.camera(), {});
    REQUIRE (lines.size() == 1);
    std::optional<juce::Point<double>> by_tip;
    for (const double part : { 0.0, 0.3, 0.6, 0.95 })
    {
        INFO (part);
        const auto at = rig.view.camera().pixel (lines[0][0] + part * (lines[0][1] - lines[0][0]));
        steered.clear();
        const double yaw = rig.view.camera().yaw;
        rig.hand.press (at);
        REQUIRE_FALSE (steered.empty());
        if (! by_tip) by_tip = steered.back();
        CHECK (steered.back().getDistanceFrom (*by_tip) < 1e-3);
        rig.hand.dragTo (at.translated (12.0f, 0.0f));
        rig.hand.release (at.translated (12.0f, 0.0f));
        CHECK (rig.view.camera().yaw == yaw);   // it did not turn the scene
    }
}

TEST_CASE ("Frame shows the tool, wherever it is, and the plate is under it", "[app][scene]")
{
    Rig rig { "dry_wood" };
    rig.playback.start (LiveRun::Hand::pointer());
    REQUIRE (rig.until ([&] { return ! rig.playback.run().scene().now().tools.empty(); }));
    for (const juce::Point<float> corner : { juce::Point<float> (6.0f, 6.0f), { 330.0f, 200.0f } })
    {
        rig.panel.view().setSize (400, 400);
        Hand (rig.panel.view()).move (corner);   // far from the middle
        const auto tool = [&] { return rig.playback.run().scene().now().tools[0]; };
        REQUIRE (rig.until ([&] { return tool().position.head<2>().norm() > 0.03; }));
        for (int i = 0; i < 200; ++i)
            rig.until ([] { return true; });
        rig.panel.refresh();
        REQUIRE (rig.view.keyPressed (juce::KeyPress ('f', {}, 'f')));
        scene::Scene all;
        for (const auto& line : all.linesOf (tool(), rig.view.camera(), {}))
            for (const auto& end : line)
            {
                const auto at = rig.view.camera().pixel (end);
                INFO (at.toString());
                CHECK (rig.view.getLocalBounds().toFloat().expanded (2.0f).contains (at));
            }
    }
    for (const Vec3& p : { Vec3 (0.0, 0.0, 0.0), Vec3 (0.058, -0.05, 0.0), Vec3 (0.09, 0.0, 0.0), Vec3 (0.02, -0.21, -0.01) })
    {
        scene::Sheet3D sheet;
        sheet.cover (p);
        CHECK (sheet.half >= std::max (std::abs (p.x()), std::abs (p.y())));
        CHECK (sheet.half >= scene::Sheet3D::half_width);
    }
}
