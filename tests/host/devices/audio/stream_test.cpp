// SPDX-License-Identifier: MIT
// Streams from ticks to a sound card and back stay in sync although the clocks differ, and play without clicks.

#include "two_clocks.hpp"

#include "support/no_allocation.hpp"

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <complex>
#include <numbers>

using namespace tactus::host::audio;
using std::numbers::pi;
using tactus::test::TwoClocks;

namespace
{
/// A sine made by the ticks, as played by the card.
struct Played
{
    explicit Played (const TwoClocks& c, double frequency, double reserve_s = 0.01)
        : clocks (c), hz (frequency), stream ({ .lanes = 1, .tick_side_hz = c.tick_hz, .reserve_s = reserve_s })
    {
        stream.prepare ({ c.card_hz, c.block });
        block.resize (static_cast<std::size_t> (c.block));
    }

    void run (double seconds)
    {
        clocks.run (
            seconds, [&] { if (ticks) tick(); ++time; },
            [&] { if (plays) play(); });
    }

    void tick()
    {
        const float sample = static_cast<float> (std::sin (2.0 * pi * hz * static_cast<double> (time) / clocks.tick_hz));
        stream.push ({ &sample, 1 });
    }

    void play()
    {
        stream.render (block);
        heard.insert (heard.end(), block.begin(), block.end());
    }

    TwoClocks clocks;
    double hz;
    OutStream stream;
    std::vector<float> block, heard;
    bool ticks = true, plays = true;
    std::int64_t time = 0;
};

/// The deviation of a sound from a sine whose amplitude and phase change slowly: the largest residual of the best-fitting
/// sine in each stretch of `period` samples. A click is as large as its step.
double largestResidual (std::span<const float> sound, double cycles_per_sample, std::size_t period)
{
    double largest = 0.0;
    for (std::size_t from = 0; from + period <= sound.size(); from += period)
    {
        std::complex<double> sum = 0.0;
        for (std::size_t i = 0; i < period; ++i)
        {
            const double angle = 2.0 * pi * cycles_per_sample * static_cast<double> (i);
            sum += static_cast<double> (sound[from + i]) * std::complex (std::cos (angle), -std::sin (angle));
        }
        const auto fit = sum * (2.0 / static_cast<double> (period));
        for (std::size_t i = 0; i < period; ++i)
        {
            const double angle = 2.0 * pi * cycles_per_sample * static_cast<double> (i);
            largest = std::max (largest, std::abs (sound[from + i] - fit.real() * std::cos (angle) + fit.imag() * std::sin (angle)));
        }
    }
    return largest;
}

double largestStep (std::span<const float> sound)
{
    double largest = 0.0;
    for (std::size_t i = 1; i < sound.size(); ++i)
        largest = std::max (largest, std::abs (static_cast<double> (sound[i]) - static_cast<double> (sound[i - 1])));
    return largest;
}

double loudest (std::span<const float> sound)
{
    double most = 0.0;
    for (const float v : sound)
        most = std::max (most, std::abs (static_cast<double> (v)));
    return most;
}
}   // namespace

TEST_CASE ("clocks 200 ppm apart play a sine for ten minutes without a click, and the difference is learned", "[audio]")
{
    const double faster = GENERATE (200e-6, -200e-6);
    Played played { { .tick_hz = 1000.0, .card_hz = 8000.0, .block = 64, .card_is_faster = faster, .jitter_s = 0.0005 }, 100.0 };
    played.run (600.0);
    const auto report = played.stream.report();
    CHECK (report.underruns == 0);
    CHECK (report.overruns == 0);
    CHECK (std::abs (report.difference - faster) < 20e-6);
    CHECK (std::abs (report.error_s) < 1e-3);

    const auto sound = std::span (played.heard).subspan (8000);
    CHECK (sound.size() > 590u * 8000u);
    CHECK (largestResidual (sound, 100.0 / 8000.0, 80) < 2e-3);   // -54 dB
    CHECK (loudest (sound) == Approx (1.0).margin (1e-3));
}

TEST_CASE ("at any rates, block sizes and clocks, nothing runs dry and a sine keeps its amplitude", "[audio]")
{
    tactus::test::property ("sines below 0.3 of the tick rate", [] {
        const double tick_hz = *rc::gen::element (500.0, 1000.0, 4000.0, 10'000.0, 48'000.0);
        const double card_hz = *rc::gen::element (22'050.0, 44'100.0, 48'000.0);
        const int block = *rc::gen::element (16, 64, 100, 441, 1024);
        const double faster = *rc::gen::inRange (-1000, 1001) * 1e-6;
        const double frequency = *rc::gen::inRange (10, 300) * 1e-3 * std::min (tick_hz, card_hz);
        Played played { { .tick_hz = tick_hz, .card_hz = card_hz, .block = block, .card_is_faster = faster, .jitter_s = 0.002 }, frequency };
        played.run (0.8);
        const auto report = played.stream.report();
        RC_ASSERT (report.underruns == 0u);
        RC_ASSERT (report.overruns == 0u);
        RC_ASSERT (report.flows == 1u);
        const double cycle = card_hz / frequency, whole = std::floor (0.4 * card_hz / cycle) * cycle;
        const auto sound = std::span (played.heard).last (static_cast<std::size_t> (std::round (whole)));
        double power = 0.0;
        for (const float v : sound)
            power += static_cast<double> (v) * static_cast<double> (v);
        RC_ASSERT (std::abs (10.0 * std::log10 (2.0 * power / static_cast<double> (sound.size()))) < 0.1);
        RC_ASSERT (report.latency_s < 0.013 + (block + 1.0) / card_hz + 25.0 / std::min (tick_hz, card_hz));
    });
}

TEST_CASE ("if ticks stop, the sound fades out within milliseconds, and when they resume it fades in, without a click", "[audio]")
{
    Played played { { .tick_hz = 4000.0, .card_hz = 48000.0, .block = 64 }, 50.0 };
    played.run (1.0);
    const auto before = played.heard.size();
    played.ticks = false;
    played.run (0.5);
    const auto report = played.stream.report();
    CHECK (report.underruns == 0);   // not counted yet: this may be the end of the run
    CHECK (report.flows == 0);
    const auto silent = std::span (played.heard).subspan (before + 48u * 25u);   // after the samples that were still waiting, and 3 ms
    CHECK (loudest (silent) == 0.0);
    played.ticks = true;
    played.run (1.0);
    CHECK (played.stream.report().flows == 1);
    CHECK (played.stream.report().underruns == 1);
    CHECK (loudest (std::span (played.heard).last (4800)) > 0.99);
    CHECK (largestStep (played.heard) < 0.04);   // the fade takes 144 samples, at most 1.6/144 per sample, and the sine changes by 2 pi 50/48000
}

TEST_CASE ("a card that paused does not play late, and does not click", "[audio]")
{
    Played played { { .tick_hz = 1000.0, .card_hz = 48000.0, .block = 256 }, 50.0 };
    played.run (1.0);
    const double latency = played.stream.report().latency_s;
    played.plays = false;
    played.run (0.3);
    played.plays = true;
    played.run (1.0);
    const auto report = played.stream.report();
    CHECK (report.overruns == 1);
    CHECK (report.flows == 1);
    CHECK (report.latency_s < latency + 2e-3);
    std::vector<float> after (played.heard.end() - 48000, played.heard.end());
    CHECK (loudest (std::span (after).last (4800)) > 0.99);
    CHECK (largestStep (after) < 0.04);
}

TEST_CASE ("if blocks tick the run, every tick's sample is played unchanged", "[audio]")
{
    tactus::test::property ("bit for bit at the card's rate, a block late", [] {
        const int block = *rc::gen::inRange (1, 300);
        OutStream stream { { .lanes = 2, .tick_side_hz = 48'000.0 } };
        stream.prepare ({ 48'000.0, block, Clocks::one });
        InStream back { { .lanes = 2, .tick_side_hz = 48'000.0 } };
        back.prepare ({ 48'000.0, block, Clocks::one });
        std::vector<float> sent, heard, returned, frames (2 * static_cast<std::size_t> (block));
        for (int k = 0; k < 8; ++k)
        {
            back.take (frames);
            for (int i = 0; i < block; ++i)
            {
                const float v = static_cast<float> (sent.size()) + 1.0f;
                sent.push_back (v);
                const std::array pair { v, -v };
                stream.push (pair);
                returned.push_back (back.pop()[1]);
            }
            stream.render (frames);
            for (int i = 0; i < block; ++i)
                heard.push_back (frames[2 * static_cast<std::size_t> (i)]);
        }
        const auto first = std::ranges::find_if (heard, [] (float v) { return v >= 1.0f; });
        RC_ASSERT (stream.report().underruns == 0u);
        RC_ASSERT (back.report().underruns == 0u);
        for (auto at = first + 240; at < heard.end(); ++at)   // after the fade-in
            RC_ASSERT (*at == *(at - 1) + 1.0f);
    });
}

TEST_CASE ("an input keeps its pitch and amplitude, and fades out if it stops", "[audio]")
{
    for (const double faster : { 300e-6, -300e-6 })
    {
        TwoClocks clocks { .tick_hz = 2000.0, .card_hz = 48'000.0, .block = 128, .card_is_faster = faster };
        InStream stream { { .lanes = 1, .tick_side_hz = clocks.tick_hz } };
        stream.prepare ({ clocks.card_hz, clocks.block });
        std::vector<float> block (128), read;
        std::int64_t sample = 0;
        const auto run = [&] (double seconds, bool there) {
            clocks.run (
                seconds, [&] { read.push_back (stream.pop()[0]); },
                [&] {
                    if (! there) return;
                    for (auto& v : block)
                        v = static_cast<float> (std::sin (2.0 * pi * 100.0 * static_cast<double> (sample++) / clocks.card_hz));
                    stream.take (block);
                });
        };
        run (60.0, true);
        const auto report = stream.report();
        CHECK (report.underruns == 0);
        CHECK (report.overruns == 0);
        CHECK (std::abs (report.difference - faster) < 30e-6);
        const auto tail = std::span (read).last (20'000);
        CHECK (largestResidual (tail, 100.0 / 2000.0, 20) < 5e-3);
        CHECK (loudest (tail) == Approx (1.0).margin (5e-3));

        run (0.2, false);
        CHECK (stream.report().underruns == 0);   // not counted yet
        CHECK (loudest (std::span (read).last (200)) == 0.0);
        CHECK (largestStep (read) < 0.4);
        run (1.0, true);
        CHECK (stream.report().underruns == 1);
        CHECK (loudest (std::span (read).last (200)) > 0.98);
    }
}

TEST_CASE ("running streams neither allocate nor lock", "[audio]")
{
    if (! NoAllocation::watches) return;
    TwoClocks clocks { .tick_hz = 1000.0, .card_hz = 44'100.0, .block = 64, .card_is_faster = 100e-6, .jitter_s = 0.001 };
    OutStream out { { .lanes = 3, .tick_side_hz = 1000.0 } };
    InStream in { { .lanes = 2, .tick_side_hz = 1000.0 } };
    out.prepare ({ clocks.card_hz, clocks.block });
    in.prepare ({ clocks.card_hz, clocks.block });
    std::vector<float> three (3, 0.1f), out_block (3 * 64), in_block (2 * 64);
    bool there = true;
    const std::function<void()> tick = [&] {
        if (there) out.push (three);
        in.pop();
    };
    const std::function<void()> play = [&] {
        in.take (in_block);
        out.render (out_block);
    };
    const NoAllocation watch;
    clocks.run (1.0, tick, play);
    there = false;
    clocks.run (0.3, tick, play);
    there = true;
    clocks.run (0.3, tick, play);
    CHECK (watch.allocations() == 0);
    CHECK (watch.locks() == 0);
}
