// SPDX-License-Identifier: MIT
// Measures what a device outputs when its sound card goes away: the table on sound cards in docs/safety.md.
//
//     TACTUS_UPDATE=1 build/release/bin/tactus_device_tests "the table of sound cards*"       rewrites it

#include "fake_cards.hpp"

#include "support/sketch.hpp"
#include "support/waiting.hpp"

#include <host/devices/audio/open_audio.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace tactus;
using namespace tactus::host::audio;
using test::FakeCards;

namespace
{
constexpr double rate_hz = 4000.0, wanted = 2.0;

struct Played
{
    Played()
    {
        auto made = openAudio (
            Json::parse (R"({ "driver": "audio", "outputs": [ { "channel": 1, "full_scale": "4 N" } ], "guard": { "max_signal": 3.3, "ramp": "100 ms" } })"),
            rig);
        REQUIRE (made.device);
        device = std::move (made.device);
        engine.attach ("stylus", *device, made.limits);
        REQUIRE (rig.begin (engine.plan(), rate_hz, &engine).empty());
    }

    static std::shared_ptr<Plan> plan()
    {
        return test::Sketch {}
            .node ("two", "signal.constant", { { "value", wanted } })
            .node ("out", "device.signal_out")
            .wire ("two.out -> out.in")
            .compile ({ .rate_hz = rate_hz })
            .plan;
    }

    /// Runs one tick, and the blocks that are due.
    void tick()
    {
        for (; blocks * card.block / card.rate_hz < ticks / rate_hz; ++blocks)
            card.play();
        rig.before();
        engine.tick();
        rig.after (engine.plan(), false);
        ++ticks;
        const double now = engine.role (0).applied.signals[0];
        largest_step = std::max (largest_step, std::abs (now - before));
        before = now;
    }

    /// The time until the channel reaches this level, in ms.
    double until (double value)
    {
        for (int k = 1; k <= 8000; ++k)
        {
            tick();
            if (before == value) return 1e3 * k / rate_hz;
        }
        FAIL ("the channel never reaches " << value);
        return 0.0;
    }

    FakeCards card;
    AudioRig rig { {}, card };
    Engine engine { plan() };
    std::unique_ptr<Device> device;
    double ticks = 0.0, blocks = 0.0, before = 0.0, largest_step = 0.0;
};

std::string inWords (double v)
{
    std::ostringstream text;
    text.imbue (std::locale::classic());
    text << std::round (v * 100.0) / 100.0;
    return text.str();
}
}   // namespace

TEST_CASE ("the table of sound cards in docs/safety.md matches the measurement", "[audio][safety]")
{
    Played run;
    run.until (wanted);
    for (int k = 0; k < 400; ++k)
        run.tick();
    REQUIRE (run.before == wanted);
    run.largest_step = 0.0;
    run.card.there = false;
    const double to_zero = run.until (0.0);
    const auto said = describe (run.engine.guardOf ("stylus").latest());
    for (int k = 0; k < 4000; ++k)
        run.tick();
    CHECK (run.before == 0.0);
    run.card.there = true;
    run.blocks = run.ticks / rate_hz * run.card.rate_hz / run.card.block;
    const double back = run.until (wanted);
    CHECK (run.largest_step <= wanted / (Guard::fade_s * rate_hz) + 1e-12);
    const auto row = "| audio device gone (no block for 100 ms) | " + inWords (to_zero) + " | " + inWords (run.largest_step) + " | \"" + said + "\" | "
                     + inWords (back) + " |\n";

    const auto document = std::filesystem::path { TACTUS_SOURCE_DIR } / "docs/safety.md";
    std::ifstream in (document);
    std::stringstream all;
    all << in.rdbuf();
    auto text = all.str();
    const std::string head = "| sound card | ms to zero | largest step | message | ms to full signal |\n|---|---:|---:|---|---:|\n";
    const auto from = text.find (head);
    REQUIRE (from != std::string::npos);
    const auto first = from + head.size();
    if (std::getenv ("TACTUS_UPDATE")) std::ofstream (document) << text.replace (first, text.find ("\n\n", first - 1) + 1 - first, row);
    CHECK (text.substr (first, row.size()) == row);
}

TEST_CASE ("a card that went away is closed and reopened when it is back, and until then the reason is available", "[audio]")
{
    using namespace std::chrono_literals;
    struct NoUser final : CardUser
    {
        void begin (const OpenedFormat&) override {}
        void block (const float* const*, int, float* const*, int, int) noexcept override {}
    } silent;
    FakeCards cards;
    CardKeeper keeper { cards, silent };
    auto now = tactus::test::fromNow (0ms);
    const auto attendFor = [&] (std::chrono::milliseconds time, bool plays) {
        for (const auto end = now + time; now < end; now += 20ms)
        {
            if (plays) cards.play();
            keeper.poll (now);
        }
    };
    REQUIRE (keeper.open ({}, 2, 0));
    attendFor (2s, true);
    CHECK (keeper.isOpen());
    CHECK (keeper.departures() == 0);

    cards.there = false;
    attendFor (2s, true);
    CHECK_FALSE (keeper.isOpen());
    CHECK (keeper.departures() == 1);
    REQUIRE_FALSE (keeper.lastAttempt());
    CHECK (keeper.lastAttempt().error().id == "audio/no_card");

    cards.there = true;
    attendFor (1s, true);
    CHECK (keeper.isOpen());
    CHECK (cards.opened == 2);
    CHECK (keeper.lastAttempt());
    attendFor (2s, true);
    CHECK (keeper.departures() == 1);
    CHECK (keeper.xruns() == 6);   // from both times that it was open

    attendFor (2s, false);   // the card is there but plays nothing, so it is reopened each time
    CHECK (keeper.departures() >= 2);
    keeper.close();
    attendFor (2s, true);
    CHECK_FALSE (keeper.isOpen());
}
