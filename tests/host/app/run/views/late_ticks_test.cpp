// SPDX-License-Identifier: GPL-3.0-or-later
// The window does nothing that could make a tick of the run late.
#include "host/app/scene/preset_bodies.hpp"

#include "support/waiting.hpp"

#include <host/app/run/views/hand_panel.hpp>
#include <host/app/scopes/scope_panel.hpp>
#include <support/no_allocation.hpp>
#include <tactus/run/device/gesture_device.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <iostream>

using namespace tactus;
using namespace tactus::host;

namespace
{
/// Everything that the window reads from a run, and a film.
struct Watchers final : RunListener
{
    Traces traces;
    SceneFeed scene;
    PortFeed ports_on_canvas;
    FilmTape film;

    void after (const Plan& plan, std::uint64_t tick, bool) noexcept override
    {
        const auto& device = *plan.roles().front().state;
        film.note (tick, device.reading.position, device.applied.force);
    }

    void read()
    {
        traces.collect();
        ports_on_canvas.refresh();
        film.collect();
        static_cast<void> (scene.now());
    }
};

double medianOf (std::vector<double> all)
{
    std::ranges::nth_element (all, all.begin() + static_cast<std::ptrdiff_t> (all.size() / 2));
    return all[all.size() / 2];
}
}   // namespace

TEST_CASE ("a window that shows scopes, the scene and a film takes no lock and no memory on the tick thread", "[app][run][late_ticks]")
{
    const auto graph = host::test::presetGraph ("dry_wood");
    FileAssets assets;
    Watchers all;
    Traces::Client client { all.traces };
    client.want ({ "motor.force", "drag.force", "hand.position" });
    all.ports_on_canvas.portsNow = [] { return std::vector<std::string> { "board.depth", "grain.force" }; };
    all.film.watch (true);
    all.scene.watch (true);
    Run run { catalogue(), { .assets = &assets }, [] (const std::string&, const graph::Graph&, const Plan&, Messages&) {
                 return Run::RoleDevice { std::make_unique<GestureDevice> (*findGesture ("stroke")) };
             } };
    for (RunListener* one : std::initializer_list<RunListener*> { &all.traces, &all.scene, &all.ports_on_canvas, &all })
        run.add (*one);
    auto messages = run.load (graph);
    REQUIRE (run.hasEngine());
    all.scene.show (&run.engine().newest());
    all.film.begin (run.rate());
    run.openDevices (graph, messages);
    run.tick();   // whatever happens only once
    int locks = 0, allocations = 0;
    for (int k = 0; k < 8000; ++k)
    {
        {
            const NoAllocation watched;
            run.tick();
            locks = std::max (locks, watched.locks());
            allocations = std::max (allocations, watched.allocations());
        }
        if (k % 130 == 0) all.read();
    }
    all.read();
    CHECK (locks == 0);
    CHECK (allocations == 0);
    CHECK (all.film.end() > 7000);   // all of them were active
    CHECK (client.of ("drag.force").size() == 3);
    CHECK (client.of ("drag.force").front()->end() > 7000);
    CHECK (all.scene.now().tools.size() == 1);
    CHECK (all.ports_on_canvas.of ("board.depth").has_value());
}

TEST_CASE ("with the scene and the scopes on the screen, ticks are late no more often than without", "[app][run][late_ticks]")
{
    const juce::ScopedJuceInitialiser_GUI juce_runs;
    Look look;
    juce::LookAndFeel::setDefaultLookAndFeel (&look);
    {
        Document document { host::test::presetGraph ("dry_wood") };
        Sound sound;
        DeviceSetup setup;
        Playback playback { document, catalogue(), sound, setup, [] {} };
        HandPanel panel { playback, sound };
        ScopePanel scopes { document, playback.run().traces(), catalogue() };
        panel.setSize (640, 400);
        scopes.setSize (1100, 260);
        for (const auto kind : { ScopeKind::spectrum, ScopeKind::spectrogram })
            scopes.add (kind);
        playback.start ({ LiveRun::Hand::Kind::path, "stroke" });
        constexpr auto half = std::chrono::milliseconds (300), picture = std::chrono::milliseconds (33);
        juce::Image image (juce::Image::ARGB, 1100, 400, true);

        // Parts of one run, in turn: the window shows everything, or nothing. Other work of the computer disturbs both in the same way.
        std::vector<double> with, without;
        for (int part = 0; part < 16; ++part)
        {
            const bool is_shown = part % 2 == 1;
            panel.showScene (is_shown);
            const tactus::test::Stopwatch watch;
            tactus::test::Pace pace { picture };
            const auto before = playback.run().status();
            while (! watch.hasRun (half))
            {
                playback.poll();
                if (is_shown)
                {
                    panel.refresh();
                    scopes.refresh();
                    juce::Graphics g (image);
                    panel.paintEntireComponent (g, false);
                    scopes.paintEntireComponent (g, false);
                }
                pace.next();
            }
            const auto after = playback.run().status();
            if (! before || ! after || after->ticks <= before->ticks || part < 2) continue;   // the first two are a warm-up
            (is_shown ? with : without).push_back (static_cast<double> (after->misses - before->misses) / static_cast<double> (after->ticks - before->ticks));
        }
        playback.run().letGo();
        REQUIRE (with.size() >= 3);
        REQUIRE (without.size() >= 3);
        const double share_with = medianOf (with), share_without = medianOf (without);
        std::cout << "late ticks, median of parts: " << 100.0 * share_with << " % with the window, " << 100.0 * share_without << " % without\n";
        CHECK (share_with <= share_without + 0.25);   // loose, because the painting competes with the ticks where there is no real-time priority
    }
    juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
}
