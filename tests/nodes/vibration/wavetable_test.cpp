// SPDX-License-Identifier: MIT
#include <tactus/nodes/vibration/wavetable.hpp>

#include <golden/golden.hpp>
#include <support/no_allocation.hpp>
#include <support/property.hpp>
#include <support/rig.hpp>
#include <tactus/node/catalogue.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

using namespace tactus;
using nodes::Wavetable;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

const std::vector<Mode> wood { { 100, 80, 1.5 }, { 430, 120, 0.7 }, { 1210, 300, 0.2 } };

Wavetable playing (const Wavetable::Table& table, double rate_hz = 4000.0, int voices = 8)
{
    Wavetable node;
    node.settings = { .table = table, .voices = voices };
    REQUIRE (node.problem() == "");
    node.prepare ({ .rate_hz = rate_hz });
    return node;
}

Wavetable::Table ofModes (std::vector<Mode> modes, double rate, int length) { return { .modes = std::move (modes), .rate = rate, .length = length }; }

Wavetable::Table recorded (double rate_hz, std::vector<std::vector<double>> channels, int channel = 1)
{
    return { .wav = std::make_shared<const Signal> (Signal { rate_hz, std::move (channels) }), .channel = channel };
}

std::vector<double> tone (double frequency, double rate_hz, std::size_t samples)
{
    std::vector<double> all (samples);
    for (std::size_t i = 0; i < samples; ++i)
        all[i] = std::sin (2.0 * M_PI * frequency * static_cast<double> (i) / rate_hz);
    return all;
}

double ring (const std::vector<Mode>& modes, double t)
{
    double sum = 0.0;
    for (const Mode& m : modes)
        sum += m.amplitude * std::exp (-m.decay * t) * std::sin (2.0 * M_PI * m.frequency * t);
    return sum;
}

/// The output after a hit of this speed, starting with the tick of the hit.
std::vector<double> struck (Wavetable node, int ticks, double v = 1.0)
{
    std::vector<double> all { node.tick ({ .hit = v }).value };
    for (int k = 1; k < ticks; ++k)
        all.push_back (node.tick ({}).value);
    return all;
}

double loudest (const std::vector<double>& values, std::size_t from = 0, std::size_t to = std::numeric_limits<std::size_t>::max())
{
    double most = 0.0;
    for (std::size_t i = from; i < std::min (to, values.size()); ++i)
        most = std::max (most, std::abs (values[i]));
    return most;
}
}   // namespace

TEST_CASE ("wavetable: it matches the golden column", "[nodes][vibration][golden]")
{
    const test::Golden golden ("modal");
    // The golden set gives modes as (a, b, omega): 1, -80, 2 pi 100 and 0.4, -30, 2 pi 230.
    const Records modes { { 100.0, 80.0, 1.0 }, { 1445.132620651305 / (2.0 * M_PI), 30.0, 0.4 } };
    const auto type = describe<Wavetable>();
    Rig rig { type, 1.0 / golden.dt_s() };
    rig.set ("table", Values { modes, golden.param ("table_rate"), golden.param ("table_length"), std::shared_ptr<const Signal> {}, 1.0 });
    rig.set ("voices", golden.param ("voices"));
    CHECK (rig.problem() == "");
    rig.prepare();
    CHECK (golden.worst ("y_wavetable", [&] (std::size_t i) {
        rig.input ("hit", golden (i, "hit_v"));
        rig.tick();
        return rig.out ("value");
    }) <= 1.0);
}

TEST_CASE ("wavetable: it is the ring of its modes, except for the linear interpolation between samples", "[nodes][vibration]")
{
    test::property ("the error is at most max |y''| / (8 rate^2), at any rate and pitch", [] {
        const double rate = *rc::gen::inRange (3000, 20'000), tick_rate = *rc::gen::inRange (900, 9000);
        const double pitch = 0.01 * *rc::gen::inRange (10, 100), v = 0.1 * *rc::gen::inRange (1, 50);
        std::vector<Mode> modes;
        double bound = 0.0;
        for (int i = *rc::gen::inRange (1, 5); i > 0; --i)
        {
            const Mode m { double (*rc::gen::inRange (20, 440)), double (*rc::gen::inRange (1, 300)), 0.1 * *rc::gen::inRange (-20, 20) };
            modes.push_back (m);
            bound += std::abs (m.amplitude) * (std::pow (2.0 * M_PI * m.frequency, 2) + m.decay * m.decay) / (8.0 * rate * rate);
        }
        auto node = playing (ofModes (modes, rate, 1000), tick_rate);
        node.params.pitch = pitch;
        const auto values = struck (node, 200, v);
        for (std::size_t k = 0; k < values.size(); ++k)
            if (const double t = pitch * static_cast<double> (k) / tick_rate; t < 998.0 / rate)
                RC_ASSERT (std::abs (values[k] - v * ring (modes, t)) <= v * bound + 1e-12);
    });
}

TEST_CASE ("wavetable: a hit begins and ends at 0, and hits add up", "[nodes][vibration]")
{
    const auto table = ofModes (wood, 8000.0, 1200);   // 0.15 s: 600 ticks
    const auto once = struck (playing (table), 1000);
    CHECK (once[0] == 0.0);
    CHECK (loudest (once, 1, 600) > 0.5);
    CHECK (loudest (once, 600) == 0.0);

    auto node = playing (table);
    const std::map<std::size_t, double> hits { { 0, 1.0 }, { 40, 0.5 }, { 41, 2.0 } };
    for (std::size_t k = 0; k < 900; ++k)
    {
        const double expected = once[k] + (k >= 40 ? 0.5 * once[k - 40] : 0.0) + (k >= 41 ? 2.0 * once[k - 41] : 0.0);
        const double hit = hits.contains (k) ? hits.at (k) : 0.0;
        REQUIRE (node.tick ({ .hit = hit }).value == Approx (expected).margin (1e-14));
    }
}

TEST_CASE ("wavetable: a table too short for its modes still ends at 0", "[nodes][vibration]")
{
    const Mode slow { 20.0, 1.0, 1.0 };
    const auto values = struck (playing (ofModes ({ slow }, 1000.0, 13), 8000.0), 200);   // ends after 12 ms, near a crest
    const double before = ring ({ slow }, 0.011);
    for (std::size_t k = 88; k <= 96; ++k)
        CHECK (values[k] == Approx (before * static_cast<double> (96 - k) / 8.0).margin (1e-12));
    CHECK (loudest (values, 96) == 0.0);
}

TEST_CASE ("wavetable: without a free voice a new hit is dropped, and sounding voices continue", "[nodes][vibration]")
{
    const auto table = ofModes (wood, 8000.0, 1200);
    auto two = playing (table, 4000.0, 2), eight = playing (table);
    for (int k = 0; k < 650; ++k)
    {
        const double wanted = k == 0 || k == 10 ? 1.0 : 0.0, too_many = k == 20 || k == 300 ? 1.0 : wanted;
        REQUIRE (two.tick ({ .hit = too_many }).value == eight.tick ({ .hit = wanted }).value);
    }
    two.tick ({ .hit = 1.0 });   // the voices have ended and are free
    CHECK (two.tick ({}).value != 0.0);
}

TEST_CASE ("wavetable: whatever the tick rate cannot carry is left out", "[nodes][vibration]")
{
    const Mode low { 100.0, 50.0, 1.0 }, high { 600.0, 50.0, 1.0 };
    CHECK (struck (playing (ofModes ({ low, high }, 8000.0, 2000), 1000.0), 200) == struck (playing (ofModes ({ low }, 8000.0, 2000), 1000.0), 200));
    CHECK (playing (ofModes ({ low, high }, 1000.0, 2000)).warning ({}).find ("600 Hz") != std::string::npos);
    CHECK (playing (ofModes ({ low, high }, 1300.0, 2000)).warning ({}).empty());

    auto raised = playing (ofModes ({ { 300.0, 50.0, 1.0 } }, 8000.0, 2000), 1000.0);
    CHECK (loudest (struck (raised, 100)) > 0.1);
    raised.params.pitch = 2.0;
    CHECK (loudest (struck (raised, 100)) == 0.0);

    for (const double frequency : { 501.0, 700.0, 900.0, 1400.0, 9000.0 })
        CHECK (loudest (struck (playing (recorded (44'100.0, { tone (frequency, 44'100.0, 22'050) }), 1000.0), 500), 20, 480) < 1e-3);
    auto transposed = playing (recorded (44'100.0, { tone (130.0, 44'100.0, 22'050) }), 1000.0);
    CHECK (loudest (struck (transposed, 500)) > 0.95);
    transposed.params.pitch = 4.0;
    CHECK (loudest (struck (transposed, 125), 20, 105) < 1e-3);
}

TEST_CASE ("wavetable: a recording plays its channel at its own rate, sample for sample", "[nodes][vibration]")
{
    const auto left = tone (60.0, 2000.0, 2001), right = tone (90.0, 2000.0, 2001);
    for (const int channel : { 1, 2 })
    {
        const auto& expected = channel == 1 ? left : right;
        const auto values = struck (playing (recorded (2000.0, { left, right }, channel), 4000.0), 4200, 3.0);
        for (std::size_t i = 0; i < 2001; ++i)
            REQUIRE (values[2 * i] == Approx (3.0 * expected[i]).margin (1e-12));
        CHECK (loudest (values, 4001) == 0.0);
    }

    // at a rate below the recording's, signals well within the band stay unchanged
    const auto values = struck (playing (recorded (48'000.0, { tone (60.0, 48'000.0, 48'001) }), 1000.0), 1000);
    for (std::size_t k = 20; k < 980; ++k)
        REQUIRE (values[k] == Approx (std::sin (2.0 * M_PI * 60.0 * static_cast<double> (k) / 1000.0)).margin (2e-3));
}

TEST_CASE ("wavetable: no recording clicks, wherever it begins and ends", "[nodes][vibration]")
{
    test::property ("from one tick to the next it moves no further than its own slope plus a bend of 2 ms", [] {
        const double wav_rate = *rc::gen::element (1000.0, 8000.0, 44'100.0), rate = *rc::gen::element (1000.0, 4000.0, 10'000.0);
        const double offset = 0.1 * *rc::gen::inRange (-20, 20);   // N s/m
        const double slope = 0.1 * *rc::gen::inRange (-20, 20);    // N s/m over the whole length
        const auto length = static_cast<std::size_t> (0.05 * wav_rate);
        std::vector<double> wav (length);
        for (std::size_t i = 0; i < length; ++i)
            wav[i] = offset + slope * static_cast<double> (i) / static_cast<double> (length);
        const auto values = struck (playing (recorded (wav_rate, { wav }), rate), static_cast<int> (0.08 * rate));
        const double steepest = std::abs (slope) / 0.05 + (std::abs (offset) + std::abs (slope)) * M_PI / 2.0 / 2e-3;   // per s
        for (std::size_t k = 1; k < values.size(); ++k)
            RC_ASSERT (std::abs (values[k] - values[k - 1]) <= 1.3 * steepest / rate + 1e-12);
        RC_ASSERT (values.front() == 0.0);
        RC_ASSERT (values.back() == 0.0);
        RC_ASSERT (std::abs (values[values.size() / 4]) > 0.9 * std::abs (offset + slope * 0.4) - 0.05);
    });
}

TEST_CASE ("wavetable: an input that is not a hit is ignored, and the ring continues", "[nodes][vibration]")
{
    auto node = playing (ofModes (wood, 8000.0, 1200)), undisturbed = node;
    node.tick ({ .hit = 1.0 });
    undisturbed.tick ({ .hit = 1.0 });
    for (const double v : { -1.0, 0.0, not_a_number, inf, -inf })
        CHECK (node.tick ({ .hit = v }).value == undisturbed.tick ({}).value);
}

TEST_CASE ("wavetable: a new table does not change sounding hits", "[nodes][vibration]")
{
    const auto table = ofModes (wood, 8000.0, 1200);
    const auto alone = struck (playing (table), 700);
    const auto other = recorded (2000.0, { tone (60.0, 2000.0, 2001) });
    const auto new_hit = struck (playing (other), 700);

    auto old = playing (table);
    old.tick ({ .hit = 1.0 });
    for (int k = 1; k < 30; ++k)
        old.tick ({});
    auto young = playing (other, 4000.0, 2);
    young.adopt (old);
    for (std::size_t k = 30; k < 700; ++k)
        REQUIRE (young.tick ({ .hit = k == 50 ? 1.0 : 0.0 }).value == Approx (alone[k] + (k >= 50 ? new_hit[k - 50] : 0.0)).margin (1e-14));
}

TEST_CASE ("wavetable: with fewer voices, sounding hits still find a place", "[nodes][vibration]")
{
    const auto table = ofModes (wood, 8000.0, 1200);
    auto old = playing (table, 4000.0, 3);
    for (int k = 0; k < 620; ++k)   // two voices have ended by then, the third has not
        old.tick ({ .hit = k < 2 || k == 400 ? 1.0 : 0.0 });
    auto young = playing (table, 4000.0, 2);
    young.adopt (old);
    for (int k = 0; k < 400; ++k)
        REQUIRE (young.tick ({}).value == old.tick ({}).value);
}

TEST_CASE ("wavetable: a table it cannot play is refused with a sentence", "[nodes][vibration]")
{
    const auto refused = [] (const Wavetable::Table& table) {
        Wavetable node;
        node.settings.table = table;
        return ! node.problem().empty();
    };
    CHECK_FALSE (refused ({}));
    CHECK_FALSE (refused (recorded (8000.0, { { 0.0, 1.0 } })));
    CHECK (refused (ofModes ({}, 8000.0, 100)));
    CHECK (refused (ofModes (wood, 0.0, 100)));
    CHECK (refused (ofModes (wood, not_a_number, 100)));
    CHECK (refused (ofModes (wood, 8000.0, 1)));
    CHECK (refused (ofModes (wood, 8000.0, 2'000'000'000)));
    CHECK (refused (ofModes ({ { inf, 1.0, 1.0 } }, 8000.0, 100)));

    const std::vector<double> samples { 0.0, 1.0, 0.0 };
    CHECK (refused (recorded (8000.0, {})));
    CHECK (refused (recorded (8000.0, { samples }, 2)));
    CHECK (refused (recorded (8000.0, { samples }, 0)));
    CHECK (refused (recorded (0.0, { samples })));
    CHECK (refused (recorded (8000.0, { { 1.0 } })));
    CHECK (refused (recorded (8000.0, { { 0.0, not_a_number, 0.0 } })));
    CHECK (refused (recorded (8000.0, { std::vector<double> (Wavetable::Table::longest + 1) })));
    auto both = recorded (8000.0, { samples });
    both.modes = wood;
    CHECK (refused (both));
}

TEST_CASE ("wavetable: no input breaks it, and a tick allocates nothing", "[nodes][vibration]")
{
    test::property ("the output is finite", [] {
        auto node = playing (ofModes (wood, 8000.0, 300), *rc::gen::element (10.0, 4000.0, 48'000.0), 3);
        node.params = { .gain = *rc::gen::element (0.0, 1.0, -1e300), .pitch = *rc::gen::element (0.01, 1.0, 8.0) };
        for (int k = 0; k < 60; ++k)
        {
            const double hit = *rc::gen::element (0.0, 1.0, -1.0, 1e300, 1.7e308, 1e-320, not_a_number, inf);
            const NoAllocation watch;
            const double value = node.tick ({ .hit = hit }).value;
            const bool allocated = watch.allocations() > 0;
            RC_ASSERT (isFinite (value) && ! allocated);
        }
    });
}
