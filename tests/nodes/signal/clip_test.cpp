// SPDX-License-Identifier: MIT
#include <tactus/nodes/signal/clip.hpp>

#include <support/no_allocation.hpp>
#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace tactus;
using nodes::SignalClip;

namespace
{
constexpr double pi = 3.14159265358979323846;

Sheet sheetOf (const Clip& clip) { return { std::make_shared<const Grid> (gridOf (clip)) }; }

SignalClip playing (const Clip& clip, const SignalClip::Params& params = {}, double rate_hz = 8000.0)
{
    SignalClip node;
    node.params = params;
    node.settings.clip = sheetOf (clip);
    REQUIRE (node.problem() == "");
    node.prepare ({ .rate_hz = rate_hz });
    node.update();
    return node;
}

Clip ofTrack (ClipTrack track)
{
    Clip clip;
    clip.tracks.push_back (std::move (track));
    return clip;
}

/// A tone of constant amplitude and sharpness.
Clip tone (double seconds, double amplitude = 1.0, double sharpness = 0.5)
{
    return ofTrack ({ .amplitude = { { 0.0, amplitude }, { seconds, amplitude } }, .sharpness = { { 0.0, sharpness } } });
}

/// An envelope, read at times that never decrease: it walks from point to point.
struct Walk
{
    const std::vector<ClipPoint>& points;
    std::size_t next = 0;   // the first point after the time

    void to (double t)
    {
        while (next < points.size() && points[next].time <= t)
            ++next;
    }

    double between (double t) const
    {
        const auto &a = points[next - 1], &b = points[next];
        return a.value + (b.value - a.value) * (t - a.time) / (b.time - a.time);
    }

    double amplitude (double t)
    {
        to (t);
        return next == 0 || next == points.size() ? 0.0 : between (t);
    }

    double sharpness (double t)
    {
        if (points.empty()) return 0.5;
        to (t);
        if (next == 0) return points.front().value;
        return next == points.size() ? points.back().value : between (t);
    }
};

/// The signal of a clip, from its envelopes sampled one by one; the phase is added up in 32 steps per sample.
std::vector<double> naiveSignal (const Clip& clip, double rate_hz, std::size_t samples)
{
    constexpr int steps = 32;
    std::vector<double> out (samples);
    for (const auto& track : clip.tracks)
    {
        double cycles = 0.0;
        Walk amplitude { track.amplitude }, sharpness { track.sharpness };
        std::size_t first = 0;
        for (std::size_t k = 0; k < samples; ++k)
        {
            const double t = static_cast<double> (k) / rate_hz;
            out[k] += amplitude.amplitude (t) * std::sin (2.0 * pi * cycles);
            for (int i = 0; i < steps; ++i)
                cycles += std::lerp (clip.voice.lowest, clip.voice.highest, sharpness.sharpness (t + (i + 0.5) / (steps * rate_hz))) / (steps * rate_hz);
            while (first < track.taps.size() && track.taps[first].time + 0.1 < t)
                ++first;
            for (std::size_t i = first; i < track.taps.size() && track.taps[i].time <= t; ++i)
            {
                const auto& tap = track.taps[i];
                const double hertz = std::lerp (clip.voice.tap_lowest, clip.voice.tap_highest, tap.sharpness);
                if ((t - tap.time) * hertz < 2.0) out[k] += tap.amplitude * std::sin (2.0 * pi * hertz * (t - tap.time));
            }
        }
    }
    return out;
}

std::vector<ClipPoint> randomEnvelope (int points, double seconds)
{
    std::vector<ClipPoint> all;
    for (int i = 0; i < points; ++i)
        all.push_back ({ seconds * i / std::max (1, points - 1), 0.001 * *rc::gen::inRange (0, 1001) });
    return all;
}

std::vector<double> heard (SignalClip& node, std::size_t ticks, const SignalClip::Inputs& first)
{
    std::vector<double> out { node.tick (first).value };
    while (out.size() < ticks)
        out.push_back (node.tick ({}).value);
    return out;
}

double largestStep (const std::vector<double>& v)
{
    double most = 0.0;
    for (std::size_t i = 1; i < v.size(); ++i)
        most = std::max (most, std::abs (v[i] - v[i - 1]));
    return most;
}
}   // namespace

TEST_CASE ("clip: its signal is that of its envelopes, sampled naively", "[nodes][signal][clip]")
{
    test::property ("any tracks", [] {
        Clip clip;
        for (int n = *rc::gen::inRange (1, 4); n > 0; --n)
        {
            ClipTrack track { .amplitude = randomEnvelope (*rc::gen::inRange (2, 9), 0.3), .sharpness = randomEnvelope (*rc::gen::inRange (0, 6), 0.2) };
            for (int i = *rc::gen::inRange (0, 3); i > 0; --i)
                track.taps.push_back (
                    { 0.1 - 0.04 * i + 0.0001 * *rc::gen::inRange (0, 300), 0.01 * *rc::gen::inRange (0, 101), 0.01 * *rc::gen::inRange (0, 101) });
            clip.tracks.push_back (track);
        }
        auto node = playing (clip);
        const auto expected = naiveSignal (clip, 8000.0, 2390);
        const auto given = heard (node, 2390, { .hit = 1.0 });
        for (std::size_t k = 0; k < given.size(); ++k)
            RC_ASSERT (std::abs (given[k] - expected[k]) < 2e-4);
    });
}

TEST_CASE ("clip: three minutes and 10 000 events play as their envelopes, to the end", "[nodes][signal][clip]")
{
    ClipTrack track;
    for (int i = 0; i < 4000; ++i)
    {
        track.amplitude.push_back ({ 0.045 * i, 0.5 + 0.5 * std::sin (0.7 * i) });
        track.sharpness.push_back ({ 0.045 * i, 0.5 + 0.5 * std::sin (1.3 * i) });
        if (i % 2 == 0) track.taps.push_back ({ 0.045 * i, 0.5, 0.25 });
    }
    const auto clip = ofTrack (track);
    CHECK (clip.events() == 10'000);
    auto node = playing (clip, { .drive = SignalClip::Drive::run }, 1000.0);
    const auto expected = naiveSignal (clip, 1000.0, 179'900);
    double worst = 0.0;
    for (const double e : expected)
        worst = std::max (worst, std::abs (node.tick ({}).value - e));
    CHECK (worst < 2e-3);   // the rounding of 6 million steps of the naive phase, and its straight pieces

    SignalClip twice;
    twice.settings.clip = sheetOf (clip);
    const double once = twice.cost().work;
    auto doubled = clip;
    doubled.tracks.push_back (track);
    twice.settings.clip = sheetOf (doubled);
    CHECK (twice.cost().work < 2.0 * once);
}

TEST_CASE ("clip: a hit plays it once from its beginning, and at rest it is silent", "[nodes][signal][clip]")
{
    auto node = playing (tone (0.1));
    CHECK (node.tick ({}).value == 0.0);
    auto out = heard (node, 1600, { .hit = 0.2 });
    CHECK (out[0] == 0.0);
    CHECK (*std::max_element (out.begin(), out.begin() + 800) > 0.99);
    CHECK (std::all_of (out.begin() + 817, out.end(), [] (double v) { return v == 0.0; }));   // 0.1 s and 2 ms

    node.params.full_speed = 0.4;
    out = heard (node, 800, { .hit = 0.2 });
    CHECK (*std::max_element (out.begin(), out.end()) == Approx (0.5).epsilon (0.01));
}

TEST_CASE ("clip: a gate plays it while it is open, and loops it if asked", "[nodes][signal][clip]")
{
    auto node = playing (tone (0.1, 1.0, 0.0), { .repeat = SignalClip::Repeat::loop });
    double late = 0.0;
    for (int k = 0; k < 4000; ++k)
        if (const auto out = node.tick ({ .gate = 1.0 }); k > 3000) late = std::max (late, out.value);
    CHECK (late > 0.99);
    for (int k = 0; k < 17; ++k)
        node.tick ({ .gate = 0.0 });
    CHECK (node.tick ({}).value == 0.0);
    CHECK (node.tick ({}).amplitude == 0.0);
}

TEST_CASE ("clip: a loop whose end fits its beginning leaves no trace", "[nodes][signal][clip]")
{
    auto node = playing (tone (0.1, 1.0, 45.0 / 145.0), { .drive = SignalClip::Drive::run, .repeat = SignalClip::Repeat::loop }, 48000.0);   // 100 Hz
    for (int k = 0; k < 48000; ++k)
        REQUIRE (node.tick ({}).value == Approx (std::sin (2.0 * pi * 100.0 * k / 48000.0)).margin (2e-4));
}

/// Two tones, of 200 Hz and 84 Hz.
Clip twoTones()
{
    Clip clip = tone (0.2, 0.8, 1.0);
    clip.tracks.push_back (tone (0.2, 0.7, 0.2).tracks[0]);
    return clip;
}

constexpr double two_tones_step = 2.0 * (2.0 * pi * 200.0 / 48000.0 + 1e-3);   // the largest step of two tones that just play, at 48 kHz

TEST_CASE ("clip: no start, stop or leap clicks", "[nodes][signal][clip]")
{
    // A distance that is no leap is up to 0.02 cycles longer than the one before. A leap repeats the last step, and then fades what is
    // missing, which is up to twice the peak and this step, along a curve whose slope is at most 1.5 per 2 ms.
    const double rate = 48000.0, peak = 0.8 + 0.7, slope = 1.5 / (2e-3 * rate), least_leap = 2.0 * pi * 0.02 * peak;
    const double largest = (two_tones_step + least_leap + slope * 2.0 * peak) / (1.0 - slope);
    test::property ("random hits, gates, times and drives", [&] {
        const Clip clip = twoTones();
        const auto drive = static_cast<SignalClip::Drive> (*rc::gen::inRange (0, 3));
        const auto repeat = static_cast<SignalClip::Repeat> (*rc::gen::inRange (0, 2));
        auto node = playing (clip, { .drive = drive, .repeat = repeat }, rate);
        SignalClip::Inputs in;
        std::vector<double> out;
        for (int leap = 0; leap < 12; ++leap)
        {
            in = { .hit = *rc::gen::inRange (0, 2) * 0.5, .gate = *rc::gen::inRange (0, 2) * 1.0, .time = 0.001 * *rc::gen::inRange (-50, 300) };
            for (int k = *rc::gen::inRange (1, 3000); k > 0; --k)
            {
                out.push_back (node.tick (in).value);
                in.hit = 0.0;
                in.time += 1.0 / rate;
            }
        }
        RC_ASSERT (largestStep (out) < largest);
    });
}

TEST_CASE ("clip: a leap shortly after others does not click", "[nodes][signal][clip]")
{
    struct Leap
    {
        double time;
        int ticks;
    };
    const std::vector<Leap> two_in_a_row { { -0.05, 1 }, { 0.041, 1 }, { -0.05, 1 }, { 0.015, 1 }, { -0.005, 1120 }, { 0.226, 1734 }, { 0.025, 1 }, { -0.05, 5 } };
    const std::vector<Leap> a_short_one { { 0.046, 1077 }, { 0.069, 720 }, { 0.199, 1 }, { -0.02, 2189 }, { 0.059, 925 }, { 0.077, 1730 } };
    for (const auto& leaps : { two_in_a_row, a_short_one })
    {
        auto node = playing (twoTones(), { .drive = SignalClip::Drive::time, .repeat = SignalClip::Repeat::loop }, 48000.0);
        std::vector<double> out;
        for (const auto& leap : leaps)
            for (int k = 0; k < leap.ticks; ++k)
                out.push_back (node.tick ({ .time = leap.time + k / 48000.0 }).value);
        CHECK (largestStep (out) < two_tones_step);
    }
}

TEST_CASE ("clip: a hit on each tick is no ramp", "[nodes][signal][clip]")
{
    auto node = playing (tone (0.2), {}, 48000.0);
    double before = heard (node, 20, { .hit = 1.0 }).back();
    before = node.tick ({ .hit = 1.0 }).value;
    for (int k = 0; k < 1000; ++k)
        REQUIRE (node.tick ({ .hit = 1.0 }).value == before);
}

TEST_CASE ("clip: along a path it is a texture, the same on the way back", "[nodes][signal][clip]")
{
    auto node = playing (tone (0.5), { .length = 0.1, .drive = SignalClip::Drive::position });
    std::vector<double> there, back;
    for (int k = 1; k < 1000; ++k)
        there.push_back (node.tick ({ .position = 1e-4 * k }).value);
    for (int k = 999; k > 0; --k)
        back.push_back (node.tick ({ .position = 1e-4 * k }).value);
    std::ranges::reverse (back);
    double worst = 0.0;
    for (std::size_t i = 30; i + 30 < there.size(); ++i)
        worst = std::max (worst, std::abs (there[i] - back[i]));
    CHECK (worst < 1e-9);
    CHECK (*std::ranges::max_element (there) > 0.99);
    for (int k = 0; k < 30; ++k)
        node.tick ({ .position = 0.05 });
    const double rest = node.tick ({ .position = 0.05 }).value;
    CHECK (node.tick ({ .position = 0.05 }).value == Approx (rest).margin (1e-12));
    for (int k = 0; k < 200; ++k)
        node.tick ({ .position = 0.2 });
    CHECK (node.tick ({ .position = 0.2 }).value == 0.0);
}

TEST_CASE ("clip: a hand too fast for its tones feels nothing instead of aliases", "[nodes][signal][clip]")
{
    auto node = playing (tone (1.0, 1.0, 1.0), { .length = 0.01, .drive = SignalClip::Drive::position, .repeat = SignalClip::Repeat::loop }, 1000.0);
    for (int k = 0; k < 1000; ++k)
        if (const double v = node.tick ({ .position = 3e-5 * k }).value; k > 5) REQUIRE (v == Approx (0.0).margin (1e-12));   // 0.6 cycles per tick
}

TEST_CASE ("clip: what is too high for the rate is silent, and speed bends the tones", "[nodes][signal][clip]")
{
    auto slow = playing (tone (1.0, 1.0, 1.0), { .drive = SignalClip::Drive::run }, 400.0);
    for (int k = 0; k < 300; ++k)
        CHECK (slow.tick ({}).value == 0.0);

    auto twice = playing (tone (1.0, 1.0, 0.0), { .speed = 2.0, .drive = SignalClip::Drive::run });
    for (int k = 0; k < 3999; ++k)
        REQUIRE (twice.tick ({}).value == Approx (std::sin (2.0 * pi * 110.0 * k / 8000.0)).margin (1e-9));
}

TEST_CASE ("clip: channels, tracks and frequencies of the device are chosen by settings", "[nodes][signal][clip]")
{
    Clip clip = tone (0.2, 0.25, 0.0);
    clip.tracks.push_back (tone (0.2, 0.5, 0.0).tracks[0]);
    clip.tracks[1].channel = 2;
    const auto loudest = [&] (int channel, int track) {
        SignalClip node;
        node.settings = { .clip = sheetOf (clip), .channel = channel, .track = track, .lowest = 80.0 };
        REQUIRE (node.problem() == "");
        node.prepare ({ .rate_hz = 8000.0 });
        const auto out = node.tick ({ .hit = 1.0 });
        CHECK (out.frequency == 80.0);
        return out.amplitude;
    };
    CHECK (loudest (0, 0) == Approx (0.75));
    CHECK (loudest (1, 0) == Approx (0.25));
    CHECK (loudest (2, 0) == Approx (0.5));
    CHECK (loudest (0, 2) == Approx (0.5));

    SignalClip node;
    node.settings = { .clip = sheetOf (clip), .channel = 3 };
    CHECK (node.problem() == "the clip has no track on channel 3");
    node.settings = { .clip = sheetOf (clip), .track = 3 };
    CHECK (node.problem() == "the clip has no track 3; its tracks are 1 to 2");
}

TEST_CASE ("clip: a transient begins and ends at 0, also where the next ones cut it", "[nodes][signal][clip]")
{
    ClipTrack track;
    for (int i = 0; i < 40; ++i)
        track.taps.push_back ({ 0.004 * i, 1.0, 0.1 * (i % 10) });
    auto node = playing (ofTrack (track), {}, 48000.0);
    const auto out = heard (node, 12000, { .hit = 1.0 });
    CHECK (out[0] == 0.0);
    CHECK (out.back() == 0.0);
    CHECK (largestStep (out) < 4.0 * 2.0 * pi * 165.0 / 48000.0);
}

TEST_CASE ("clip: the envelope ducks under a transient", "[nodes][signal][clip]")
{
    auto clip = tone (0.2, 0.5, 0.0);
    clip.tracks[0].taps = { { 0.1, 0.0, 0.0 } };
    clip.voice.ducking = 0.5;
    auto node = playing (clip, { .drive = SignalClip::Drive::run });
    std::vector<double> amplitudes;
    for (int k = 0; k < 1600; ++k)
        amplitudes.push_back (node.tick ({}).amplitude);
    CHECK (amplitudes[790] == Approx (0.5));
    CHECK (amplitudes[800 + 145] == Approx (0.25));   // halfway through the transient of 36.4 ms
    CHECK (amplitudes[1100] == Approx (0.5));
}

TEST_CASE ("clip: it never exceeds the amplitude that it claims, and allocates nothing", "[nodes][signal][clip]")
{
    test::property ("random starts", [] {
        Clip clip = tone (0.05, 0.9, 0.7);
        clip.tracks[0].taps = { { 0.01, 1.0, 0.2 }, { 0.012, 0.7, 0.9 } };
        auto node = playing (clip, { .gain = 0.5 }, 2000.0);
        const double most = node.claims().amplitude;
        const int start = *rc::gen::inRange (0, 37);
        double largest = 0.0;
        const NoAllocation watch;
        for (int k = 0; k < 300; ++k)
        {
            const auto out = node.tick ({ .hit = k % 37 == start ? 1.0 : 0.0 });
            largest = std::max ({ largest, std::abs (out.value), out.amplitude });
        }
        const bool allocated = watch.allocations() > 0;
        RC_ASSERT (! allocated);
        RC_ASSERT (largest > 0.0);
        RC_ASSERT (largest <= most);
    });
}

TEST_CASE ("clip: a fault silences it, and the next hit plays again", "[nodes][signal][clip]")
{
    auto node = playing (tone (0.5));
    heard (node, 100, { .hit = 1.0 });
    CHECK (node.tick ({ .time = std::numeric_limits<double>::quiet_NaN() }).value == 0.0);
    CHECK (node.tick ({}).amplitude == 0.0);
    CHECK (heard (node, 100, { .hit = 1.0 })[50] != 0.0);
}

TEST_CASE ("clip: a new file takes over at the same time, without a step", "[nodes][signal][clip]")
{
    auto old = playing (tone (0.5, 1.0, 0.0), { .drive = SignalClip::Drive::run }, 48000.0);
    std::vector<double> out;
    for (int k = 0; k < 1003; ++k)
        out.push_back (old.tick ({}).value);
    auto next = playing (tone (0.5, 0.2, 1.0), { .drive = SignalClip::Drive::run }, 48000.0);
    next.adopt (old);
    for (int k = 0; k < 1003; ++k)
        out.push_back (next.tick ({}).value);
    CHECK (largestStep (out) < 0.06);
    CHECK (out.back() == Approx (0.2 * std::sin (2.0 * pi * 200.0 * 2005.0 / 48000.0)).margin (1e-6));
}

TEST_CASE ("clip: a table of rows holds all of a clip, and other tables are refused", "[nodes][signal][clip]")
{
    Clip clip = tone (1.0, 0.5, 0.25);
    clip.voice = { 10.0, 20.0, 30.0, 40.0, 0.5 };
    clip.tracks[0].taps = { { 0.5, 0.25, 0.75 } };
    clip.tracks.push_back ({ .channel = 3, .is_wave = true, .amplitude = { { 0.0, -1.0 }, { 1.0, 1.0 } } });
    const auto read = clipOf (gridOf (clip));
    CHECK (read.problem == "");
    CHECK (read.clip == clip);

    const auto problem = [] (std::vector<double> values, int columns) {
        return clipOf ({ .rows = static_cast<int> (values.size()) / columns, .columns = columns, .values = std::move (values) }).problem;
    };
    CHECK (problem ({ 1, 2, 3, 4 }, 2) == "the table is not a clip: a clip has 5 columns");
    CHECK (problem ({ 3, 1, 0, 0, 0 }, 5) == "the table is not a clip: row 1: a row does not follow the row of its track");
    CHECK (problem ({ 2, 1, 1, 0, 0, 3, 1, 2, 0, 0, 3, 1, 1, 0, 0 }, 5) == "track 1: the times of its amplitude go back");
    CHECK (problem ({ 2, 1, 1, 0, 0, 3, 1, 2, 1.5, 0 }, 5) == "track 1: its amplitude has a value outside its range");
    CHECK (problem ({ 9, 1, 1, 0, 0 }, 5) == "the table is not a clip: row 1: a row does not follow the row of its track");
}
