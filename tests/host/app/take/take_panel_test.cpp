// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/run/views/hand_view.hpp>
#include <host/app/take/take_panel.hpp>
#include <host/base/assets/file_assets.hpp>
#include <tactus/file/csv.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/run/log/run_test.hpp>

#include "host/app/support/seen_text.hpp"
#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <filesystem>

using namespace tactus;
using namespace tactus::host;
namespace fs = std::filesystem;

namespace
{
struct TakeRig
{
    juce::ScopedJuceInitialiser_GUI juce_runs;
    Look look;
    TemporaryFolder folder;
    Document document { loadGraph (TACTUS_SOURCE_DIR "/graphs/dry_wood.json").graph };
    Sound sound;
    DeviceSetup setup;
    std::unique_ptr<Playback> playback;
    std::unique_ptr<TakePanel> panel;
    juce::String said;
    Clip clip;
    fs::path chosen;

    TakeRig()
    {
        juce::LookAndFeel::setDefaultLookAndFeel (&look);
        playback = std::make_unique<Playback> (document, catalogue(), sound, setup, [] {});
        panel = std::make_unique<TakePanel> (document, *playback, catalogue());
        panel->setBounds (0, 0, 600, 232);
        panel->onChoose = [this] (const std::string& name, const std::function<void (const fs::path&)>& then) {
            chosen = folder / name;
            then (chosen);
        };
        panel->onClip = [this] (const Clip& c, const Messages&, std::optional<double>, const fs::path&) {
            clip = c;
            return true;
        };
        panel->onSaid = [this] (const juce::String& title, const juce::String& text, const std::function<void()>&) { said = title + ": " + text; };
    }

    ~TakeRig()
    {
        panel.reset();
        playback.reset();
        juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
    }

    /// Does what the window's timer does, until the condition holds.
    template <typename F>
    bool until (F&& isSo)
    {
        return tactus::test::eventually ({}, [&] {
            poll();
            return isSo();
        });
    }

    void poll()
    {
        playback->poll();
        panel->refresh();
        tactus::test::letPass (std::chrono::milliseconds (5));
    }

    bool isReady() { return panel->take().state() == Take::State::ready && panel->plot().length() > 0.0; }

    /// Records at least these seconds of the run.
    void record (double s)
    {
        panel->toggleRecording();
        REQUIRE (panel->take().state() == Take::State::recording);
        REQUIRE (until ([&] { return fs::exists (panel->take().log()); }));   // the run has begun again
        REQUIRE (until ([&] { return playback->run().status() && static_cast<double> (playback->run().status()->ticks) > 4000.0 * s; }));
        panel->toggleRecording();
        REQUIRE (until ([&] { return isReady(); }));
    }
};
}   // namespace

TEST_CASE ("a take records the run from its first tick, and shows the force of the motor", "[take]")
{
    TakeRig rig;
    CHECK (rig.panel->port() == "motor.force");
    rig.record (0.3);
    CHECK (rig.panel->plot().length() > 0.29);
    CHECK (rig.panel->plot().from() == 0.0);
    CHECK (rig.panel->plot().until() == rig.panel->plot().length());
    CHECK (rig.panel->take().seconds() == rig.panel->plot().length());
    rig.panel->showPort ("drag.state");
    CHECK (rig.until ([&] { return rig.panel->take().state() == Take::State::ready; }));
    const auto log = rig.panel->take().log();
    CHECK (fs::exists (log));
    rig.record (0.05);
    CHECK (rig.panel->take().log() != log);
    CHECK (fs::exists (log));   // undo brings it back
}

TEST_CASE ("a marked stretch of a take becomes a clip, a gesture and a test", "[take]")
{
    TakeRig rig;
    rig.record (0.4);
    rig.panel->plot().mark (0.3, 0.1);
    CHECK (rig.panel->plot().from() == 0.1);

    rig.panel->makeClip();
    REQUIRE (rig.until ([&] { return ! rig.clip.tracks.empty(); }));
    CHECK (rig.clip.tracks.size() == 1);   // the force along its main direction
    CHECK (rig.clip.tracks[0].is_wave);
    CHECK (rig.clip.lastEvent() == Approx (0.2));

    rig.panel->makeGesture();
    REQUIRE (rig.until ([&] { return fs::exists (rig.folder / "gesture.csv"); }));
    const auto movement = readTable (rig.folder / "gesture.csv");
    REQUIRE (movement);
    CHECK (movement->rows() == 800);
    CHECK (rig.said.startsWith ("Saved gesture.csv"));

    rig.panel->makeTest();
    REQUIRE (rig.until ([&] { return fs::exists (rig.folder / "test.jsonl"); }));
    CHECK (rig.said.contains ("begins at the start of the run"));
    host::FileAssets assets;
    const auto played = playRunTest ((rig.folder / "test.jsonl").string(), { .assets = &assets, .program = "tactus" });
    INFO ((played ? std::string() : describe (played.error())));
    REQUIRE (played);
    CHECK (played->isSame());
    CHECK (played->ticks == 800);
}

TEST_CASE ("a gesture made from a take is felt as it was recorded: the tool goes where the device was", "[take]")
{
    TakeRig rig;
    rig.record (0.4);
    const auto gesture = [&] (double from, double until) {
        std::error_code ignored;
        fs::remove (rig.folder / "gesture.csv", ignored);
        rig.panel->plot().mark (from, until);
        rig.panel->makeGesture();
        REQUIRE (rig.until ([&] { return fs::exists (rig.folder / "gesture.csv"); }));
        const auto movement = readTable (rig.folder / "gesture.csv");
        REQUIRE (movement);
        return *movement;
    };
    const auto recorded = gesture (0.1, 0.3);
    REQUIRE (recorded.rows() == 800);
    rig.playback->moveBy ({ LiveRun::Hand::Kind::path, (rig.folder / "gesture.csv").string() });
    REQUIRE (rig.until ([&] { return rig.playback->run().transport() != nullptr; }));
    rig.record (0.25);
    const auto replayed = gesture (0.0, 0.15);
    REQUIRE (replayed.columns == recorded.columns);
    const auto width = recorded.columns.size();
    for (std::size_t row = 0; row < replayed.rows(); ++row)
        for (std::size_t c = 0; c < width; ++c)
            if (const auto& name = recorded.columns[c]; name == "x" || name == "y" || name == "z")
                REQUIRE (replayed.values[row * width + c] == Approx (recorded.values[row * width + c]).margin (1e-9));
}

TEST_CASE ("a take contains the edits that are made while it is recorded", "[take]")
{
    TakeRig rig;
    rig.panel->toggleRecording();
    REQUIRE (rig.until ([&] { return rig.playback->run().status() && rig.playback->run().status()->ticks > 400; }));
    REQUIRE (rig.document.perform (graph::SetParam { "", "drag", "mu", Json (0.9) }));
    const auto ticks = rig.playback->run().status()->ticks;
    REQUIRE (rig.until ([&] { return rig.playback->run().status()->ticks > ticks + 400; }));
    rig.panel->toggleRecording();
    REQUIRE (rig.until ([&] { return rig.isReady(); }));
    rig.panel->makeTest();
    REQUIRE (rig.until ([&] { return fs::exists (rig.folder / "test.jsonl"); }));
    host::FileAssets assets;
    const auto played = playRunTest ((rig.folder / "test.jsonl").string(), { .assets = &assets, .program = "tactus" });
    REQUIRE (played);
    CHECK (played->isSame());
}

TEST_CASE ("a graph that does not run gives no take, and the buttons stay disabled", "[take]")
{
    TakeRig rig;
    rig.document.open ({}, {}, "empty");
    rig.panel->toggleRecording();
    CHECK (rig.until ([&] { return rig.panel->take().state() != Take::State::recording || rig.playback->run().isRunning(); }));
    rig.panel->makeClip();
    CHECK (rig.clip.tracks.empty());
}

TEST_CASE ("a stop that comes while a take begins again with another hand lasts", "[take][safety]")
{
    const int polls = GENERATE (range (0, 8));
    const bool is_emergency = GENERATE (true, false);
    INFO (polls << (is_emergency ? " polls, emergency stop" : " polls, stop"));
    TakeRig rig;
    auto& run = rig.playback->run();
    auto& take = rig.panel->take();
    rig.panel->toggleRecording();
    REQUIRE (rig.until ([&] { return run.isLogged() && rig.panel->plot().length() > 0.05; }));
    HandView surface { *rig.playback };
    surface.steer (0.0, 0.0, true);
    for (int n = 0; n < polls; ++n)
        rig.poll();
    is_emergency ? rig.playback->emergencyStop() : rig.playback->stop();
    const bool goes_on = run.isWanted();   // an emergency stop leaves a run that has begun
    CHECK ((is_emergency || ! goes_on));
    REQUIRE (rig.until ([&] { return goes_on ? run.isStoppedForGood() : ! run.isRunning(); }));
    for (int n = 0; n < 20; ++n)
    {
        rig.poll();
        CHECK (run.isWanted() == goes_on);
        CHECK ((goes_on ? run.isStoppedForGood() : ! run.isRunning()));
    }
    CHECK (run.isHeld() == is_emergency);
    if (goes_on) rig.panel->toggleRecording();
    REQUIRE (rig.until ([&] { return take.state() == Take::State::ready; }));
    CHECK_FALSE (rig.panel->unsaved().empty());
    rig.playback->restart();
    REQUIRE (rig.until ([&] { return run.isRunning() && ! run.isStoppedForGood(); }));
    CHECK_FALSE (run.isLogging());   // no other take was requested
}

TEST_CASE ("the axis of a take that is longer than what is shown follows", "[take]")
{
    const juce::ScopedJuceInitialiser_GUI juce_runs;
    Look look;
    TakePlot plot;
    plot.setLookAndFeel (&look);
    plot.setSize (600, 200);
    const auto says = [&] (const juce::String& text) {
        const auto texts = host::test::readTexts (plot);
        return std::ranges::any_of (texts, [&] (const auto& t) { return t.text == text; });
    };
    const auto shown = [] (std::uint64_t from) {
        return Stretch { .rate_hz = 100.0, .from = from, .until = from + 1000, .names = { "motor.force.x" }, .values = std::vector<double> (1000, 1.0) };
    };
    plot.show (shown (0));
    CHECK ((says ("0 s") && says ("10.00 s")));
    plot.show (shown (1250));
    CHECK ((says ("12.50 s") && says ("22.50 s") && ! says ("0 s")));

    // The wheel zooms around the pointer, Shift and the wheel move, and a double click shows all.
    plot.show (shown (0));
    const juce::Point<float> middle { 300.0f, 90.0f };
    const auto event = [&] (int mods) {
        const auto now = juce::Time::getCurrentTime();
        return juce::MouseEvent (juce::Desktop::getInstance().getMainMouseSource(), middle, juce::ModifierKeys (mods), 1.0f, 0, 0, 0, 0, &plot, &plot, now,
                                 middle, now, 1, false);
    };
    plot.mouseWheelMove (event (0), { 0.0f, 0.5f, false, false, false });
    CHECK ((says ("2.50 s") && says ("7.50 s")));
    plot.mouseWheelMove (event (juce::ModifierKeys::shiftModifier), { 0.0f, -10.0f, false, false, false });
    CHECK ((says ("5.00 s") && says ("10.00 s")));
    plot.mouseWheelMove (event (0), { 0.0f, -10.0f, false, false, false });
    CHECK ((says ("0 s") && says ("10.00 s")));
    plot.mouseWheelMove (event (0), { 0.0f, 20.0f, false, false, false });
    CHECK_FALSE (says ("10.00 s"));
    plot.mouseDoubleClick (event (0));
    CHECK ((says ("0 s") && says ("10.00 s")));
    plot.setLookAndFeel (nullptr);
}

TEST_CASE ("the name of a take that is compared can be read where curves cross it", "[app][take]")
{
    TakeRig rig;
    auto& plot = rig.panel->plot();
    plot.setBounds (0, 0, 400, 120);
    Stretch dense { .rate_hz = 1000.0, .until = 4000, .names = { "motor.force" }, .unit = "N" };
    for (int k = 0; k < 4000; ++k)
        dense.values.push_back (k % 2 == 0 ? 1.0 : -1.0);   // fills the plot
    plot.show (dense);
    plot.pin ("Take 1, motor.force");
    const auto image = plot.createComponentSnapshot (plot.getLocalBounds());
    const auto like = [&] (juce::Colour wanted) {
        int count = 0;
        for (int y = 90; y < 99; ++y)
            for (int x = 300; x < 390; ++x)
            {
                const auto is = image.getPixelAt (x, y);
                count += std::abs (is.getRed() - wanted.getRed()) + std::abs (is.getGreen() - wanted.getGreen())
                             + std::abs (is.getBlue() - wanted.getBlue())
                         < 60;
            }
        return count;
    };
    CHECK (like (rig.look.theme().text) > 20);
    CHECK (like (rig.look.theme().canvas) > 200);
}

TEST_CASE ("a take that a crash has left has its length in the list before it is played", "[app][take]")
{
    TakeRig rig;
    rig.record (0.1);
    const double length = rig.panel->take().seconds();
    const auto left = rig.panel->take().log();
    REQUIRE (rig.panel->open (left, true));
    CHECK (rig.panel->take().log() != left);
    CHECK (rig.panel->take().seconds() == Approx (length).margin (0.01));
    CHECK (rig.panel->nameOf (1).startsWith ("Take 2: 0."));
    CHECK (rig.panel->nameOf (1).endsWith (" s, not saved"));
}
