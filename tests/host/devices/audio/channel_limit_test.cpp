// SPDX-License-Identifier: MIT
// What reaches a channel of the card stays within the limits of the roles that drive the channel, whatever comes after the guard.

#include "fake_cards.hpp"

#include "support/sketch.hpp"

#include <host/devices/audio/audio_device.hpp>
#include <host/devices/audio/open_audio.hpp>
#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace tactus;
using namespace tactus::host::audio;
using test::FakeCards;

namespace
{
constexpr double rate_hz = 4000.0, full_scale = 4.0, most = 0.1, slew = 1.0;   // ticks; in N; in N/s

using Roles = std::vector<std::pair<std::string, Json>>;

Json roleOn (const std::string& outputs, const std::string& limits)
{
    return Json::parse (R"({ "driver": "audio", "outputs": [ )" + outputs + R"( ], "guard": { "ramp": "10 ms")" + limits + " } }");
}

const std::string plain = R"({ "channel": 1, "full_scale": "4 N" })", limited = R"(, "max_signal": "0.1 N", "max_signal_slew": "1 N/s")";

/// A node that plays on a channel of a role.
test::Sketch& addOut (test::Sketch& s, const std::string& name, int channel, const std::string& role, const std::string& from)
{
    s.node (name, "device.signal_out", Json::object(), { { "channel", channel } });
    s.graph.root.nodes.back().role = role;
    return s.wire (from + " -> " + name + ".in");
}

test::Sketch constant (double value)
{
    test::Sketch s;
    s.node ("wave", "signal.constant", { { "value", value } });
    return s;
}

/// A run with a card, in virtual time. The ticks are slower than the card, so everything is resampled.
struct Bench
{
    Bench (const test::Sketch& s, const Roles& roles, std::vector<Route> routes = {}) : rig ({ .card = {}, .reserve_s = 0.005, .routes = routes }, card)
    {
        auto compiled = s.compile ({ .rate_hz = rate_hz, .records = rig.ports() });
        INFO (test::text (compiled.messages));
        REQUIRE (compiled.plan);
        engine = std::make_unique<Engine> (compiled.plan);
        for (const auto& [name, description] : roles)
        {
            auto made = openAudio (description, rig);
            INFO (test::text (made.messages));
            REQUIRE (made.device);
            engine->attach (name, *made.device, made.limits);
            devices.push_back (std::move (made.device));
        }
        const auto said = rig.begin (engine->plan(), rate_hz, engine.get());
        INFO (test::text (said));
        REQUIRE (said.empty());
    }

    void run (double seconds)
    {
        for (end += seconds; ticks / rate_hz < end; ++ticks)
        {
            for (; blocks * card.block / card.rate_hz < ticks / rate_hz; ++blocks)
                card.play();
            rig.before();
            engine->tick();
            rig.after (engine->plan(), false);
        }
    }

    /// The largest absolute value that a channel has played, in N.
    double peak (std::size_t channel = 0) const
    {
        double largest = 0.0;
        for (const float sample : card.played[channel])
            largest = std::max (largest, std::abs (static_cast<double> (sample)));
        return largest * full_scale;
    }

    /// The largest change from one sample to the next, in N per s.
    double steepest() const
    {
        double before = 0.0, largest = 0.0;
        for (const float sample : card.played[0])
            largest = std::max (largest, std::abs (static_cast<double> (sample) - std::exchange (before, static_cast<double> (sample))));
        return largest * full_scale * card.rate_hz * card.speed;
    }

    FakeCards card;
    AudioRig rig;
    std::unique_ptr<Engine> engine;
    std::vector<std::unique_ptr<Device>> devices;
    double ticks = 0.0, blocks = 0.0, end = 0.0;
};

/// The limits hold, and the channel plays as much as they allow.
void checkWithin (const Bench& b)
{
    CHECK (b.peak() <= most);
    CHECK (b.peak() > 0.99 * most);
    CHECK (b.steepest() <= slew * (1.0 + 0.001 * b.card.speed));   // a sample is a float, so its difference to the next is rounded
}

Route route (std::string port, int channel)
{
    Route r;
    r.port = std::move (port);
    r.channel = channel;
    r.full_scale.value = full_scale;
    r.where = "/audio/routes/0";
    return r;
}
}   // namespace

TEST_CASE ("a gain after the guard cannot exceed the limits of the role", "[audio][safety]")
{
    auto s = constant (3.0);
    Bench b { addOut (s, "out", 1, "stylus", "wave.out"),
              { { "stylus", roleOn (R"({ "channel": 1, "full_scale": "4 N", "gain": 30 })", limited) } } };
    b.run (0.5);
    checkWithin (b);
    b.engine->emergencyStop();
    b.run (0.5);
    checkWithin (b);
    CHECK (std::abs (b.card.played[0].back()) < 1e-6f);
}

TEST_CASE ("a card that plays faster than it says cannot exceed the slew of the role", "[audio][safety]")
{
    auto s = constant (3.0);
    Bench b { addOut (s, "out", 1, "stylus", "wave.out"),
              { { "stylus", roleOn (R"({ "channel": 1, "full_scale": "4 N", "gain": 30 })", limited) } } };
    b.card.speed = 4.0;
    b.run (0.5);
    checkWithin (b);
}

TEST_CASE ("two outputs of a role on one channel of the card share the limits of the role", "[audio][safety]")
{
    auto s = constant (3.0);
    addOut (s, "out", 1, "stylus", "wave.out");
    Bench b { addOut (s, "other", 2, "stylus", "wave.out"), { { "stylus", roleOn (plain + ", " + plain, limited) } } };
    b.run (0.5);
    checkWithin (b);
}

TEST_CASE ("two roles on one channel of the card share the stricter limits", "[audio][safety]")
{
    auto s = constant (3.0);
    addOut (s, "out", 1, "stylus", "wave.out");
    Bench b { addOut (s, "other", 1, "thumb", "wave.out"),
              { { "thumb", roleOn (plain, R"(, "max_signal": "0.3 N", "max_signal_slew": "20 N/s")") }, { "stylus", roleOn (plain, limited) } } };
    b.run (0.5);
    checkWithin (b);
}

TEST_CASE ("the overshoot of a high-pass filter stays within the limits of the role", "[audio][safety]")
{
    test::Sketch s;
    s.node ("wave", "signal.lfo", { { "shape", "square" }, { "frequency", 5.0 }, { "amplitude", 3.0 } });
    const std::string filtered = R"({ "channel": 1, "full_scale": "4 N", "high_pass": "20 Hz" })";
    addOut (s, "out", 1, "stylus", "wave.out");
    Bench without { s, { { "stylus", roleOn (filtered, "") } } };
    without.run (1.0);
    REQUIRE (without.peak() > 3.5);   // the filter doubles the step
    Bench b { s, { { "stylus", roleOn (filtered, R"(, "max_signal": "0.1 N")") } } };
    b.run (1.0);
    CHECK (b.peak() <= most);
    CHECK (b.peak() > 0.99 * most);
    Bench slow { s, { { "stylus", roleOn (filtered, limited) } } };
    slow.run (1.0);
    CHECK (slow.peak() <= most);
    CHECK (slow.steepest() <= slew * 1.001);
}

TEST_CASE ("a stop does not push through a high-pass filter that has removed a steady signal", "[audio][safety]")
{
    for (const auto* cutoff : { "20 Hz", "5 Hz" })
    {
        INFO (cutoff);
        const auto output = R"({ "channel": 1, "full_scale": "4 N", "high_pass": ")" + std::string (cutoff) + R"(" })";
        auto wave = constant (2.0);
        Bench b { addOut (wave, "out", 1, "stylus", "wave.out"), { { "stylus", roleOn (output, "") } } };
        b.run (1.0);
        REQUIRE (std::abs (b.card.played[0].back()) < 1e-3f);   // the filter has removed it
        const auto from = b.card.played[0].size();
        b.engine->emergencyStop();
        b.run (0.5);
        for (auto i = from; i < b.card.played[0].size(); ++i)
            REQUIRE (std::abs (b.card.played[0][i]) < 1e-3f);   // 0.3 without the gate
        b.engine->rearm();
        b.run (0.5);
        CHECK (b.peak() < 2.5);   // at the first start; never a step by twice the signal
    }
}

TEST_CASE ("a filtered output of a role falls to zero within the time of the guard, from whatever it played", "[audio][safety]")
{
    test::property ("for any signal and any stops", [] {
        constexpr double dt = 1.0 / 4000.0;
        AudioRole role;
        role.outputs.push_back ({ .channel = 1, .high_pass_hz = *rc::gen::elementOf (std::vector { 1.0, 20.0, 300.0 }) });
        const std::atomic<bool> plays = true;
        AudioDevice device { role, plays, [] (const AudioDevice&) {} };
        device.prepare (dt);
        const auto stops = *rc::gen::container<std::vector<bool>> (40, rc::gen::arbitrary<bool>());   // 50 ticks each
        const double frequency = *rc::gen::elementOf (std::vector { 0.0, 7.0, 150.0 });
        double open = 0.0, before = 0.0;
        for (std::size_t k = 0; k < 50 * stops.size(); ++k)
        {
            const bool is_stopped = stops[k / 50];
            open = is_stopped ? std::max (0.0, open - dt / Guard::fade_s) : std::min (1.0, open + dt / 0.05);
            Effort effort;
            effort.signals.set (0, 2.0 * open * std::cos (2.0 * std::numbers::pi * frequency * static_cast<double> (k) * dt));
            if (is_stopped) device.withhold();
            device.write (effort);
            double played = 0.0;
            device.addTo ({ &played, 1 });
            if (is_stopped) RC_ASSERT (std::abs (played) <= std::abs (before));
            if (is_stopped && k % 50 > 20) RC_ASSERT (played == 0.0);
            before = played;
        }
    });
}

TEST_CASE ("a route onto the channel of a role obeys the limits of the role, and other channels are unchanged, bit for bit", "[audio][safety]")
{
    auto s = constant (2.0);
    addOut (s, "out", 1, "stylus", "wave.out");
    const std::vector<Route> routes { route ("wave.out", 1), route ("wave.out", 2) };
    Bench b { s, { { "stylus", roleOn (plain, limited) } }, routes };
    b.run (0.5);
    checkWithin (b);
    CHECK (b.rig.limitsFirst (2));
    CHECK_FALSE (b.rig.limitsFirst (0));
    Bench without { s, { { "stylus", roleOn (plain, "") } }, routes };
    without.run (0.5);
    CHECK_FALSE (without.rig.limitsFirst (2));
    CHECK (without.peak() > 3.9);
    CHECK (b.peak (1) == Approx (2.0).margin (0.3));
    CHECK (b.card.played[1] == without.card.played[1]);
}

TEST_CASE ("the limit of a channel rounds towards zero and turns a sample that is not a number into silence", "[audio][safety]")
{
    const std::vector<float> played { 0.05f, 0.2f, -3.0f, std::numeric_limits<float>::quiet_NaN(), 0.5f };
    auto samples = played;
    const auto count = static_cast<int> (samples.size());
    ChannelLimit limit;
    limit (samples.data(), count - 2, 1.0 / 48'000.0);
    CHECK (std::equal (samples.begin(), samples.begin() + count - 2, played.begin()));
    for (const double strictest : { 0.1, 0.7, 1e-3, 0.0 })
    {
        samples = played;
        ChannelLimit role;
        role.tighten (1.0, std::numeric_limits<double>::infinity());
        role.tighten (strictest, std::numeric_limits<double>::infinity());
        role (samples.data(), count, 1.0 / 48'000.0);
        for (const float sample : samples)
            CHECK (std::abs (static_cast<double> (sample)) <= strictest);
        CHECK (samples[3] == 0.0f);
    }
}

TEST_CASE ("a channel whose limits are tightened while it plays falls to them without a step, also from no limit at all", "[audio][safety]")
{
    const bool had_limits = GENERATE (false, true);
    constexpr double card_hz = 48000.0;
    ChannelLimit limit;
    if (had_limits) limit.tighten (0.9, 5000.0);
    std::vector<float> block (480, 0.8f);
    limit (block.data(), 480, 1.0 / card_hz);
    REQUIRE (block.back() == 0.8f);
    limit.tighten (0.1, 0.2);   // the new slew alone would take seconds
    float before = block.back();
    for (int k = 0; k < 20; ++k)
    {
        std::ranges::fill (block, 0.8f);
        limit (block.data(), 480, 1.0 / card_hz);
        for (const float sample : block)
        {
            REQUIRE (sample <= before);
            REQUIRE (before - sample <= 0.7f / 239.0f);
            before = sample;
        }
    }
    CHECK (before == Approx (0.1));
    std::ranges::fill (block, 0.0f);
    limit (block.data(), 480, 1.0 / card_hz);
    CHECK (block.back() == Approx (0.1 - 0.2 * 480 / card_hz));   // the new slew, once the channel is within the new limit
}
