// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/scene/preset_bodies.hpp"
#include "host/tools/figures/played_png.hpp"

#include "support/waiting.hpp"

#include <host/app/run/views/hand_panel.hpp>
#include <host/base/files/wav.hpp>
#include <host/devices/audio/listening.hpp>
#include <support/temporary_folder.hpp>
#include <tactus/file/csv.hpp>
#include <tactus/file/text_file.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <numbers>

using namespace tactus;
using namespace tactus::host;
namespace fs = std::filesystem;
using tactus::test::PlayedPng;

namespace
{
constexpr double film_rate = 2000.0;
const juce::Rectangle<int> seen_area { 0, 0, 320, 200 };

/// Sets the window's look, which everything that draws text needs.
struct Dressing
{
    juce::ScopedJuceInitialiser_GUI juce_runs;
    Look look;
    Dressing() { juce::LookAndFeel::setDefaultLookAndFeel (&look); }
    ~Dressing() { juce::LookAndFeel::setDefaultLookAndFeel (nullptr); }
};

/// A tool that strokes a board for some seconds.
Film strokeFilm (double seconds)
{
    Film film { .rate_hz = film_rate };
    scene::Scene stage;
    stage.setBodies (host::test::bodiesIn ("dry_wood"));
    scene::Camera camera;
    camera.setSize (320.0f, 200.0f);
    camera.frame (stage.bounds());
    const auto shared = std::make_shared<const scene::Scene> (stage);
    const auto count = static_cast<std::uint64_t> (seconds * film_rate);
    for (std::uint64_t i = 0; i < count; ++i)
    {
        const double t = static_cast<double> (i) / film_rate;
        const Vec3 position (0.02 * std::sin (4.0 * t), 0.0, -1e-3), force (0.3 * std::sin (2.0 * std::numbers::pi * 200.0 * t), 0.0, 1.0);
        film.ticks.push_back ({ 1000 + i, position, force });
        if (i % 60 != 0) continue;
        scene::SceneState now;
        now.tools.push_back ({ "stylus", position, force });
        film.states.push_back ({ 1000 + i, shared, now, camera });
    }
    return film;
}

const std::function<bool (double)> continues = [] (double) { return true; };

std::string bytesOf (const fs::path& file)
{
    std::ifstream in (file, std::ios::binary);
    return { std::istreambuf_iterator<char> (in), {} };
}
}   // namespace

TEST_CASE ("a film has a picture every 40 ms, in the requested size", "[app][film]")
{
    const Dressing dressing;
    const TemporaryFolder folder;
    const auto film = strokeFilm (1.0);
    FilmPicture picture { Theme::dark(), seen_area, 480 };
    const auto written = writeFilm (film, picture, folder / "film.png", continues, "a-program-that-does-not-exist");
    INFO ((written ? "" : describe (written.error())));
    REQUIRE (written);
    const PlayedPng played { bytesOf (folder / "film.png") };
    REQUIRE (played.frames.size() == 25);
    for (const double s : played.seconds)
        CHECK (s == 0.04);
    for (const auto& frame : played.frames)
        CHECK (frame.getBounds() == juce::Rectangle<int> (0, 0, 480, 300));
    CHECK_FALSE (tactus::test::isSame (played.frames.front(), played.frames.back()));
    for (const std::size_t i : { 0u, 12u, 24u })   // each shows the state of its time
        CHECK (tactus::test::isSame (played.frames[i], picture.draw (*stateAt (film, static_cast<double> (i) * 0.04)), film_tolerance));
    REQUIRE (written->notes.size() == 1);
    CHECK (written->notes.front().id == "film/no_video");
    CHECK (written->files.size() == 3);
}

TEST_CASE ("the sound of a film is what --listen writes for the same force, and its table has every tick", "[app][film]")
{
    const Dressing dressing;
    const TemporaryFolder folder;
    auto film = strokeFilm (0.5);
    film.ticks.erase (film.ticks.begin() + 300);   // a tick that was lost
    FilmPicture picture { Theme::light(), seen_area, 64 };
    REQUIRE (writeFilm (film, picture, folder / "film.png", continues, "a-program-that-does-not-exist"));

    const auto table = readTable (folder / "film.csv");
    REQUIRE (table);
    CHECK (table->columns == std::vector<std::string> { "t", "x", "y", "z", "force.x", "force.y", "force.z" });
    REQUIRE (table->rows() == film.ticks.size());
    for (std::size_t i = 0; i < film.ticks.size(); ++i)
    {
        const auto& t = film.ticks[i];
        const double seconds = static_cast<double> (t.tick - 1000) / film_rate;
        const std::array expected { seconds, t.position.x(), t.position.y(), t.position.z(), t.force.x(), t.force.y(), t.force.z() };
        CHECK (std::ranges::equal (table->row (i), expected));
    }

    std::vector<Tap> taps (3);
    for (std::size_t i = 0; i < 3; ++i)
        taps[i].name = std::string ("m.force.") + "xyz"[i];
    Listening listening { (folder / "direct.wav").string(), taps, film_rate, 1 };
    for (std::size_t i = 0; i < film.ticks.size(); ++i)
        for (int n = 0; n < (i == 299 ? 2 : 1); ++n)   // the lost tick repeats the one before
        {
            const auto& f = film.ticks[i].force;
            listening.frame (std::array { f.x(), f.y(), f.z() });
        }
    Messages warnings;
    REQUIRE (listening.write (warnings));
    CHECK (bytesOf (folder / "film.wav") == bytesOf (folder / "direct.wav"));
    const auto sound = readWav (folder / "film.wav");
    REQUIRE (sound);
    CHECK (sound->rate_hz == 48e3);
    CHECK (static_cast<double> (sound->channels[0].size()) == Approx (0.5 * 48e3).margin (2.0));
}

TEST_CASE ("a film that is stopped or empty writes nothing, and a video is written by ffmpeg if it is there", "[app][film]")
{
    const Dressing dressing;
    const TemporaryFolder folder;
    FilmPicture picture { Theme::dark(), seen_area, 64 };
    const auto entries = [&] { return std::distance (fs::directory_iterator (folder.path()), {}); };
    const auto stopped = writeFilm (strokeFilm (0.5), picture, folder / "film.png", [] (double part) { return part < 0.4; });
    REQUIRE_FALSE (stopped);
    CHECK (stopped.error().id == "film/stopped");
    const auto empty = writeFilm ({}, picture, folder / "film.png", continues);
    REQUIRE_FALSE (empty);
    CHECK (empty.error().id == "film/empty");
    CHECK (entries() == 0);

    const auto program = folder / "ffmpeg";   // writes into its last argument what it was asked
    std::ofstream (program) << "#!/bin/sh\nfor last; do :; done\necho \"$@\" > \"$last\"\n";
    fs::permissions (program, fs::perms::owner_all);
    const auto written = writeFilm (strokeFilm (0.1), picture, folder / "film.png", continues, program.string());
    REQUIRE (written);
    CHECK (written->files.size() == 4);
    CHECK (written->notes.empty());
    CHECK (bytesOf (folder / "film.webm").find ((folder / "film.wav").string()) != std::string::npos);
    CHECK (entries() == 5);

    std::ofstream (program) << "#!/bin/sh\nexit 1\n";
    fs::remove (folder / "film.webm");
    const auto failed = writeFilm (strokeFilm (0.1), picture, folder / "film.png", continues, program.string());
    REQUIRE (failed);
    REQUIRE (failed->notes.size() == 1);
    CHECK (failed->notes.front().id == "film/no_video");
    CHECK (entries() == 4);
}

TEST_CASE ("a tape keeps the last seconds, and forgets an earlier run", "[app][film]")
{
    FilmTape tape;
    scene::Scene stage;
    tape.begin (1000.0);
    tape.keep (2.0);
    tape.note (0, Vec3::Zero(), Vec3::Zero());   // while it is not watched
    tape.collect();
    CHECK (tape.end() == 0);
    tape.watch (true);
    for (std::uint64_t tick = 0; tick < 5000; ++tick)
    {
        tape.note (tick, Vec3 (static_cast<double> (tick), 0.0, 0.0), Vec3::Zero());
        if (tick % 10 != 0) continue;
        tape.collect();
        tape.add (stage, 1, {}, {});
    }
    tape.collect();
    const auto all = tape.last (100.0);
    CHECK (all.seconds() == Approx (2.0));
    CHECK (all.ticks.front().tick == 3000);
    CHECK (all.ticks.front().position.x() == 3000.0);
    CHECK (all.states.size() == Approx (51).margin (2));   // one in 40 ticks, and the one before
    CHECK (all.states.front().tick <= 3000);               // what is shown at the beginning
    CHECK (tape.last (0.5).seconds() == Approx (0.5));
    CHECK (tape.since (4900).ticks.size() == 100);
    CHECK (tape.secondsSince (4900) == Approx (0.1));
    CHECK (tape.secondsSince (0) == Approx (2.0));
    CHECK (tape.secondsSince (5000) == 0.0);
    CHECK (stateAt (all, 0.0)->tick <= 3000);
    CHECK (stateAt (all, 100.0) == &all.states.back());
    tape.note (0, Vec3::Zero(), Vec3::Zero());   // another run
    tape.collect();
    CHECK (tape.last (100.0).ticks.size() == 1);
    CHECK (tape.last (100.0).states.empty());
}

TEST_CASE ("the button saves what the scene showed, while the run continues", "[app][film]")
{
    const Dressing dressing;
    const TemporaryFolder folder;
    Document document { host::test::presetGraph ("dry_wood") };
    Sound sound;
    DeviceSetup setup;
    Playback playback { document, catalogue(), sound, setup, [] {} };
    HandPanel panel { playback, sound };
    juce::String hint;
    panel.onHint = [&hint] (const juce::String& text) { hint = text; };
    panel.setSize (420, 300);
    panel.showScene (true);
    auto& film = panel.film();
    const auto until = [&] (auto&& isSo) {
        return tactus::test::eventually (std::chrono::milliseconds (5), [&] {
            playback.poll();
            panel.refresh();
            return isSo();
        });
    };
    CHECK (film.isVisible());
    panel.refresh();
    film.saveLast();
    CHECK (hint.contains ("no film"));
    playback.start ({ LiveRun::Hand::Kind::path, "stroke" });
    auto& tape = playback.run().film();
    const auto secondsOf = [&] { return static_cast<double> (tape.end()) / tape.rate(); };
    REQUIRE (until ([&] { return tape.end() > 0 && secondsOf() > 1.0; }));
    film.begin();
    CHECK (film.isFilming());
    const auto from = tape.end();
    REQUIRE (until ([&] { return tape.end() > from + 1000; }));
    auto filmed = tape.since (from);
    CHECK (filmed.ticks.front().tick >= from);
    CHECK (filmed.states.size() > 1);
    const auto ticks = filmed.ticks;
    const auto before = playback.run().status()->ticks;
    film.save (std::make_shared<Film> (std::move (filmed)), folder / "film.png");
    CHECK (film.isSaving());
    REQUIRE (until ([&] { return ! film.isSaving(); }));
    CHECK (playback.run().status()->ticks > before);   // it kept running
    INFO (hint);
    CHECK (hint.contains ("Saved"));
    const auto table = readTable (folder / "film.csv");
    REQUIRE (table);
    REQUIRE (table->rows() == ticks.size());
    CHECK (table->at (ticks.size() - 1, 1) == ticks.back().position.x());
    CHECK (table->at (ticks.size() - 1, 6) == ticks.back().force.z());
    const PlayedPng played { bytesOf (folder / "film.png") };
    CHECK (static_cast<double> (played.frames.size()) == Approx (static_cast<double> (ticks.size()) / tape.rate() / 0.04).margin (1.5));
    CHECK (played.frames.front().getWidth() == 800);
    playback.run().letGo();
}

TEST_CASE ("a film is made of the scene while it is hidden, too", "[app][film]")
{
    const Dressing dressing;
    Document document { host::test::presetGraph ("dry_wood") };
    Sound sound;
    DeviceSetup setup;
    Playback playback { document, catalogue(), sound, setup, [] {} };
    HandPanel panel { playback, sound };
    panel.setSize (420, 300);
    REQUIRE_FALSE (panel.showsScene());
    CHECK (panel.film().isVisible());
    playback.start ({ LiveRun::Hand::Kind::path, "stroke" });
    auto& tape = playback.run().film();
    const auto poll = [&] {
        playback.poll();
        panel.refresh();
        tactus::test::letPass (std::chrono::milliseconds (5));
    };
    const auto until = [&] (auto&& isSo) {
        return tactus::test::eventually ({}, [&] {
            poll();
            return isSo();
        });
    };
    REQUIRE (until ([&] { return playback.run().status() && playback.run().status()->ticks > 2000; }));
    CHECK (tape.end() == 0);   // a hidden scene costs nothing
    panel.film().begin();
    REQUIRE (until ([&] { return tape.secondsSince (0) > 0.5; }));
    CHECK (panel.film().isFilming());
    panel.setSeen (false);
    const auto before = tape.end();
    REQUIRE (until ([&] { return tape.end() > before + 1000; }));
    const auto film = tape.since (0);
    CHECK (film.states.size() > 5);
    CHECK_FALSE (film.states.back().stage->isEmpty());
    CHECK_FALSE (film.states.back().now.tools.empty());
    playback.run().letGo();
}

TEST_CASE ("a film takes only names that are free, and keeps a dot in its name", "[app][film]")
{
    const TemporaryFolder folder;
    CHECK (filmFile (folder / "strokes.png", ".wav") == folder / "strokes.wav");
    CHECK (filmFile (folder / "film v1.2", ".wav") == folder / "film v1.2.wav");
    CHECK (filmFile (folder / "film v1.2.png", ".csv") == folder / "film v1.2.csv");
    CHECK_FALSE (fileInTheWay (folder / "strokes.png"));
    std::ofstream (folder / "strokes.csv") << "t,x\n";
    CHECK (fileInTheWay (folder / "strokes.png") == folder / "strokes.csv");
    CHECK_FALSE (fileInTheWay (folder / "strokes v1.png"));
}
