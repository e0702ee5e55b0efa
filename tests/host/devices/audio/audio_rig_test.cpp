// SPDX-License-Identifier: MIT
// A run with a sound card: routing, levels, and what happens when the card goes away.

#include "fake_cards.hpp"

#include "support/no_allocation.hpp"
#include "support/sketch.hpp"
#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <host/devices/audio/open_audio.hpp>
#include <support/property.hpp>
#include <tactus/file/graph_file.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>

using namespace tactus;
using namespace tactus::host::audio;
using test::FakeCards;

namespace
{
Route route (std::string port, int channel, double full_scale = 1.0)
{
    Route r;
    r.port = std::move (port);
    r.channel = channel;
    r.full_scale.value = full_scale;
    r.where = "/audio/routes/0";
    return r;
}

/// A graph, an engine, a card and the rig between them, in virtual time.
struct Stage
{
    explicit Stage (const test::Sketch& s, std::vector<Route> routes, const Json& role = nullptr, double hz = 4000.0, bool card_ticks = false)
        : rate_hz (hz), rig ({ .card = {}, .reserve_s = 0.005, .routes = std::move (routes) }, card),
          compiled (s.compile ({ .rate_hz = hz, .records = portsOr ("motor.applied") }))
    {
        INFO (test::text (compiled.messages));
        REQUIRE (compiled.plan);
        engine = std::make_unique<Engine> (compiled.plan);
        if (card_ticks) rig.tickBy (rate_hz);
        if (! role.is_null())
        {
            auto made = openAudio (role, rig);
            said = made.messages;
            device = std::move (made.device);
            if (device) engine->attach ("stylus", *device, made.limits);
        }
        for (auto& m : rig.begin (engine->plan(), rate_hz, engine.get()))
            said.push_back (std::move (m));
    }

    std::vector<std::string> portsOr (const char* otherwise) const
    {
        auto ports = rig.ports();
        if (ports.empty()) ports.push_back (otherwise);
        return ports;
    }

    void tick (bool halts = false)
    {
        rig.before();
        engine->tick();
        rig.after (engine->plan(), halts);
    }

    void run (double seconds, bool halts = false)
    {
        for (end += seconds; ticks / rate_hz < end; ++ticks)
        {
            for (; blocks * card.block / card.rate_hz < ticks / rate_hz; ++blocks)
                card.play();
            tick (halts);
        }
    }

    double level (std::size_t channel) const { return card.played[channel].empty() ? 0.0 : static_cast<double> (card.played[channel].back()); }

    FakeCards card;
    double rate_hz;
    AudioRig rig;
    Compiled compiled;
    std::unique_ptr<Engine> engine;
    std::unique_ptr<Device> device;
    Messages said;
    double ticks = 0.0, blocks = 0.0, end = 0.0;
};

test::Sketch constants()
{
    return test::Sketch {}
        .node ("two", "signal.constant", { { "value", 2.0 } })
        .node ("three", "signal.constant", { { "value", 3.0 } })
        .node ("join", "vector.join")
        .node ("out", "device.signal_out")
        .node ("motor", "device.force")
        .wire ("two.out -> join.x")
        .wire ("three.out -> join.y")
        .wire ("two.out -> out.in")
        .wire ("join.out -> motor.force");
}
}   // namespace

TEST_CASE ("the calibration sets full scale, and several routes on one channel are summed", "[audio]")
{
    auto turned = route ("three.out", 2, 10.0);
    turned.gain = -2.0;
    Stage s { constants(), { route ("two.out", 1, 8.0), route ("three.out", 1, 6.0), turned, route ("join.out", 3, 10.0), route ("join.out.y", 4, 10.0) } };
    INFO (test::text (s.said));
    REQUIRE (s.said.empty());
    s.run (0.5);
    CHECK (s.level (0) == Approx (0.25 + 0.5).margin (1e-3));
    CHECK (s.level (1) == Approx (-0.6).margin (1e-3));
    CHECK (s.level (2) == Approx (0.5).margin (1e-3));   // the sum of the components
    CHECK (s.level (3) == Approx (0.3).margin (1e-3));
    CHECK (s.rig.status().clipped == 0);
    CHECK (s.rig.status().xruns == 3);
}

TEST_CASE ("samples beyond full scale are limited and counted, and values that are not numbers are silent and counted", "[audio]")
{
    Stage s { constants(), { route ("two.out", 1, 1.0) } };
    s.run (0.5);
    CHECK (s.level (0) == 1.0);
    CHECK (s.rig.status().clipped > 10'000);

    Stage fed { test::Sketch {}.node ("a", "signal.constant").node ("b", "signal.gain").wire ("a.out -> b.in"), { route ("b.out", 1) } };
    fed.engine->plan();
    test::property ("for any value, the card gets numbers from -1 to 1", [] {
        const double value =
            *rc::gen::elementOf (std::vector<double> { 0.5, 1e300, -1e300, std::numeric_limits<double>::infinity(), std::nan (""), 1e-320, -3.0 });
        double now = 0.0;
        const Plan plan ({ { .name = "b.out", .unit = {}, .value = &now } });
        PortMixer mixer { { route ("b.out", 1) }, { 1 }, 1000.0 };
        double sum = 0.0;
        for (int k = 0; k < 600; ++k)
        {
            now = k == 300 ? value : 0.25;
            mixer.poll (plan, false);
            double channel = 0.0;
            mixer.addTo ({ &channel, 1 }, 0, 1);
            RC_ASSERT (std::abs (channel) <= PortMixer::most_sample);
            if (k == 299) sum = channel;
            const bool goes_on = std::isfinite (value);
            const bool as_it_should = goes_on ? channel == sum : channel < sum;
            if (k == 301) RC_ASSERT (as_it_should);
        }
        const std::uint64_t broken = std::isfinite (value) ? 0 : 1;
        RC_ASSERT (mixer.notNumbers() == broken);
    });
}

TEST_CASE ("a role plays the signal that its guard passes, and its inputs are calibrated", "[audio]")
{
    const auto sketch = constants().node ("in", "device.signal_in").node ("gain", "signal.gain").wire ("in.out -> gain.in");
    const Json role = Json::parse (
        R"({ "driver": "audio", "outputs": [ { "channel": 3, "full_scale": "4 N" } ], "inputs": [ { "channel": 2, "full_scale": "20 m/s2" } ],
             "guard": { "max_signal": 1, "ramp": "50 ms" } })");
    Stage s { sketch, { route ("in.out", 1, 20.0) }, role };
    INFO (test::text (s.said));
    REQUIRE (s.said.empty());
    s.card.spoken[1] = { 0.25f };
    s.run (0.5);
    CHECK (s.level (2) == Approx (0.25).margin (1e-3));   // 2 requested, 1 allowed, full scale 4
    CHECK (s.level (0) == Approx (0.25).margin (1e-3));   // the input, 5 m/s2, full scale 20
    CHECK (s.rig.status().in.underruns == 0);
}

TEST_CASE ("a section that runs several times per tick is played at its own rate", "[audio]")
{
    // 6 kHz with ticks at 4 kHz: only possible because the section runs at 48 kHz.
    const auto loaded = readGraph (R"({ "format": "tactus-graph", "version": 1, "rate_hz": 4000,
        "nodes": { "fast": { "type": "graph:tone", "times": 12 } }, "wires": [],
        "graphs": { "tone": { "nodes": { "wave": { "type": "signal.lfo", "params": { "frequency": 6000 } } }, "wires": [],
                              "expose": { "outputs": { "out": "wave.out" } } } } })");
    INFO (test::text (loaded.messages));
    REQUIRE (loaded.messages.empty());
    Stage s { test::Sketch { loaded.graph }, { route ("fast.out", 1) } };
    REQUIRE (s.said.empty());
    s.run (0.5);
    const auto tail = std::span (s.card.played[0]).last (4800);
    double power = 0.0;
    int rises = 0;
    for (std::size_t i = 1; i < tail.size(); ++i)
    {
        power += tail[i] * tail[i];
        rises += tail[i - 1] < 0.0f && tail[i] >= 0.0f;
    }
    CHECK (power / static_cast<double> (tail.size()) == Approx (0.5).epsilon (0.02));
    CHECK (rises == Approx (600).margin (2));
}

TEST_CASE ("routes fade to silence when the run halts and on an emergency stop", "[audio][safety]")
{
    Stage s { constants(), { route ("two.out", 1, 4.0) } };
    s.run (0.5);
    REQUIRE (s.level (0) == Approx (0.5).margin (1e-3));
    const auto stopAndGo = [&] (const std::function<void()>& stop, bool halts) {
        const auto from = s.card.played[0].size();
        stop();
        s.run (0.05, halts);
        CHECK (s.level (0) == Approx (0.0).margin (1e-6));
        double largest = 0.0;
        for (std::size_t i = from; i < s.card.played[0].size(); ++i)
            largest = std::max (largest, std::abs (static_cast<double> (s.card.played[0][i] - s.card.played[0][i - 1])));
        CHECK (largest < 0.5 * 1.5 / (PortMixer::shut_s * 48'000.0));
    };
    stopAndGo ([&] { s.engine->emergencyStop(); },
               false);
    s.engine->rearm();
    s.run (0.5);
    CHECK (s.level (0) == Approx (0.5).margin (1e-3));
    stopAndGo ([] {}, true);
}

TEST_CASE ("routes survive edits, and a route whose port is removed is silent until it is back", "[audio]")
{
    Stage s { constants(), { route ("two.out", 1, 4.0) } };
    s.run (0.5);
    const auto submit = [&] (const test::Sketch& next, std::vector<std::string> records) {
        auto compiled = tactus::compile (next.graph, catalogue(), { .rate_hz = s.rate_hz, .records = std::move (records), .before = &s.engine->newest() });
        REQUIRE (compiled.plan);
        s.engine->submit (compiled.plan);
    };
    submit (constants(), { "join.out", "three.out", "two.out" });   // the tap now has a different index
    s.run (0.2);
    CHECK (s.level (0) == Approx (0.5).margin (1e-3));
    submit (constants(), { "three.out" });
    s.run (0.2);
    CHECK (s.level (0) == Approx (0.0).margin (1e-3));
    submit (constants(), { "three.out", "two.out" });
    s.run (0.2);
    CHECK (s.level (0) == Approx (0.5).margin (1e-3));
}

TEST_CASE ("routes that cannot be played are reported before anything sounds", "[audio]")
{
    Stage absent { constants(), { route ("two.out", 5) } };
    CHECK (test::has (absent.said, "audio/channel"));
    auto wrong_unit = route ("motor.applied", 1);
    wrong_unit.full_scale = { 1.0, Dimension { 1, 0, -2 } };
    Stage unit { constants(), { wrong_unit } };
    CHECK (test::has (unit.said, "audio/unit"));
    CHECK (unit.card.opened == 0);

    FakeCards card;
    AudioRig rig { { .card = {}, .routes = { route ("two.out", 1) } }, card };
    const auto plan = constants().compile ({ .rate_hz = 100.0, .records = { "two.out" } }).plan;
    CHECK (test::has (rig.begin (*plan, 100.0), "audio/rate"));
    AudioRig other { { .card = {}, .routes = { route ("two.out", 1) } }, card };
    const auto without = constants().compile ({ .records = { "three.out" } }).plan;
    CHECK (test::has (other.begin (*without, 4000.0), "audio/port"));
    // The routes of a session serve all graphs: a route that this graph cannot play gives a warning, and the other routes are played.
    auto missing = route ("mix.out", 1), right = route ("two.out", 2);
    for (auto* r : { &missing, &right })
        r->if_there = true;
    AudioRig session { { .card = {}, .routes = { missing, right } }, card };
    const auto begun = session.begin (*plan, 1000.0);
    CHECK (test::has (begun, "audio/port"));
    CHECK_FALSE (hasErrors (begun));
    CHECK (session.status().is_open);

    {
        AudioRig forgetful { {}, card };
        Messages of_it;
        forgetful.open ({ .outputs = { ChannelUse { .channel = 50 } }, .inputs = {} }, of_it).reset();   // as if its binding had failed
        CHECK_FALSE (forgetful.isNeeded());
    }

    Messages messages;
    AudioRig late { {}, card };
    late.begin (*plan, 1000.0);
    CHECK (late.open ({}, messages) == nullptr);
    CHECK (test::has (messages, "audio/late"));
    AudioRig two { { .card = { .type = "JACK", .output = "a", .input = "" }, .routes = {} }, card };
    CHECK (two.nameCard ("jack:a"));
    REQUIRE_FALSE (two.nameCard ("ALSA:a"));
    CHECK (two.nameCard ("ALSA:a").error().id == "audio/two_cards");
}

TEST_CASE ("the output of the card is recorded as a WAV file, bit for bit", "[audio]")
{
    const TemporaryFolder folder;
    const auto file = folder / "given.wav";
    Stage s { constants(), { route ("two.out", 2, 4.0) } };
    REQUIRE (s.rig.captureTo (file));
    for (int k = 0; k < 10; ++k)
    {
        s.run (0.05);
        CHECK (s.rig.poll());
    }
    CHECK_FALSE (std::filesystem::exists (file));
    CHECK (s.rig.end());
    const auto wav = host::readWav (file);
    REQUIRE (wav);
    CHECK (wav->rate_hz == 48'000.0);
    REQUIRE (wav->channels.size() == 2);
    REQUIRE (wav->channels[1].size() == s.card.played[1].size());
    for (std::size_t i = 0; i < wav->channels[1].size(); ++i)
        if (wav->channels[1][i] != static_cast<double> (s.card.played[1][i])) FAIL ("sample " << i);

    Stage back { constants(), { route ("two.out", 1, 4.0) } };
    REQUIRE (back.rig.captureTo (folder / "back.wav"));
    back.run (0.1);
    back.card.rate_hz = 44'100.0;
    int reported = 0;
    for (int ms = 0; ms < 2000; ms += 100)   // silent for so long that the card is reopened
        reported += ! back.rig.poll (tactus::test::fromNow (std::chrono::milliseconds (ms)));
    CHECK (back.card.opened == 2);
    CHECK (reported == 1);
    CHECK (back.rig.end());
    CHECK (host::readWav (folder / "back.wav")->rate_hz == 48'000.0);

    Stage other { constants(), { route ("two.out", 1) } };
    const auto captures = other.rig.captureTo (folder / "no folder" / "given.wav");
    REQUIRE_FALSE (captures);
    CHECK (captures.error().id.starts_with ("output/"));
}

TEST_CASE ("a full disk ends the recording with one error, and the run continues", "[audio]")
{
    if (! std::filesystem::exists ("/dev/full")) return;
    Stage s { constants(), { route ("two.out", 1, 4.0) } };
    if (! s.rig.captureTo ("/dev/full")) return;   // an immediate refusal is fine too
    int reported = 0;
    for (int k = 0; k < 20; ++k)
    {
        s.run (0.05);
        reported += ! s.rig.poll();
    }
    CHECK (reported == 1);
    CHECK (s.level (0) == Approx (0.5).margin (1e-3));
}

TEST_CASE ("the tick thread and the audio thread neither allocate nor lock", "[audio]")
{
    if (! NoAllocation::watches) return;
    const Json role = Json::parse (R"({ "driver": "audio", "outputs": [ { "channel": 3, "high_pass": 20 } ], "inputs": [ { "channel": 1 } ] })");
    Stage s { constants(), { route ("two.out", 1, 4.0) }, role };
    s.run (0.1);
    const NoAllocation watch;
    for (int k = 0; k < 1000; ++k)
        s.tick();
    CHECK (watch.allocations() == 0);
    CHECK (watch.locks() == 0);
}
