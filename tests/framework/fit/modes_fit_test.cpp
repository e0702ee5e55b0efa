// SPDX-License-Identifier: MIT
// Which modes are found: all that stand out from the noise, and no others.

#include "draws.hpp"

#include <support/rounds.hpp>
#include <tactus/fit/modes_fit.hpp>

#include <numbers>
#include <optional>

using namespace tactus;
using test::between;

namespace
{
constexpr double full_circle = 2.0 * std::numbers::pi;

using Tone = ModesFit::Tone;

/// Rings without a blow: the tones begin with the first row.
RecordedRing ringOf (const std::vector<Tone>& tones, double rate, double duration, double noise, std::uint64_t seed = 5)
{
    Random random { seed };
    RecordedRing ring;
    for (int i = 0; i < static_cast<int> (duration * rate); ++i)
    {
        const double t = i / rate;
        double value = noise * random.normal();
        for (const auto& tone : tones)
            value += tone.amplitude * std::exp (-tone.decay * t) * std::sin (full_circle * tone.frequency * t + tone.phase);
        ring.time.push_back (t);
        ring.value.push_back (value);
    }
    return ring;
}

double halfBandwidth (const Tone& tone) { return tone.decay / full_circle; }

/// Found modes are within a quarter of the bandwidth of the true one, and within half of its decay.
bool agree (const Tone& found, const Tone& truth)
{
    return std::abs (found.frequency - truth.frequency) <= 0.5 * halfBandwidth (truth) && std::abs (found.decay - truth.decay) <= 0.5 * truth.decay;
}

/// Takes the nearest of the found modes whose band overlaps that of the true one.
std::optional<Tone> takeNearest (std::vector<Tone>& found, const Tone& truth)
{
    const auto distance = [&] (const Tone& tone) { return std::abs (tone.frequency - truth.frequency) / (halfBandwidth (tone) + halfBandwidth (truth)); };
    const auto nearest = std::ranges::min_element (found, {}, distance);
    if (nearest == found.end() || distance (*nearest) > 1.0) return {};
    const auto taken = *nearest;
    found.erase (nearest);
    return taken;
}

struct RandomSet
{
    std::vector<Tone> tones {};
    double noise = 0.0;
    RecordedRing ring {};

    bool isApart (const Tone& tone) const
    {
        return std::ranges::all_of (tones, [&] (const Tone& other) {
            return &other == &tone || std::abs (other.frequency - tone.frequency) >= (other.decay + tone.decay) / std::numbers::pi;
        });
    }

    /// 20 dB over the noise in its band: its energy is 100 times that of the noise in one independent sample. A tone of decay d has a band of d / 2 Hz
    /// for 1 / d s, which is one such sample.
    bool standsOut (const Tone& tone) const
    {
        double energy = 0.0;
        for (const double t : ring.time)
            energy += std::pow (tone.amplitude * std::exp (-tone.decay * t) * std::sin (full_circle * tone.frequency * t + tone.phase), 2);
        return energy >= 100.0 * noise * noise;
    }
};

/// 2 to 12 modes from 60 Hz to 0.45 of the rate. Amplitudes vary by 40 dB, decays by two decades (but no mode is overdamped), rates from 8 to 48 kHz.
RandomSet randomSet (std::uint64_t seed)
{
    Random random { seed };
    const auto across = [&] (double low, double high) { return low * std::pow (high / low, random.uniform()); };
    const double rate = std::round (across (8e3, 48e3));
    const int count = 2 + static_cast<int> (10.999 * random.uniform());
    const double slowest = across (1.0, 10.0);
    RandomSet set;
    for (int k = 0; k < count; ++k)
    {
        const double frequency = across (60.0, 0.45 * rate), decay = std::min (frequency, across (slowest, 100.0 * slowest)), amplitude = across (0.01, 1.0);
        set.tones.push_back ({ .frequency = frequency, .decay = decay, .amplitude = amplitude, .phase = between (random, 0.0, full_circle) });
    }
    set.noise = across (1e-4, 0.1);
    set.ring = ringOf (set.tones, rate, std::min (1.0, 3.0 / slowest), set.noise, random.bits());
    return set;
}

/// Whether all modes that must be found are found, and no others. Modes that stand out less, or are too close, may be found.
bool isRight (const RandomSet& set)
{
    const auto fit = fitModes (set.ring);
    if (! fit && fit.error().id != "fit/no_ring") return false;
    auto found = fit ? fit->tones : std::vector<Tone> {};
    bool right = true;
    for (const bool must : { true, false })
        for (const auto& truth : set.tones)
        {
            if ((set.isApart (truth) && set.standsOut (truth)) != must) continue;
            const auto nearest = takeNearest (found, truth);
            right = right && (! must || (nearest && agree (*nearest, truth)));
        }
    return right && found.empty();
}

bool lacks (const FitReport& report, const std::string& words)
{
    return std::ranges::any_of (report.lacking, [&] (const std::string& text) { return text.find (words) != std::string::npos; });
}
}   // namespace

TEST_CASE ("fit of modes: of random sets of 2 to 12 modes, all that stand out are found in 95 %, and none is invented", "[fit]")
{
    const int sets = test::rounds (200);
    int right = 0;
    for (int seed = 1; seed <= sets; ++seed)
        if (isRight (randomSet (static_cast<std::uint64_t> (seed)))) ++right;
    CAPTURE (right, sets);
    CHECK (right >= 0.95 * sets - (sets < 100 ? 1 : 0));
}

TEST_CASE ("fit of modes: clear tones are found, however much higher or weaker they are than the strongest", "[fit]")
{
    const std::vector<std::vector<Tone>> rings {
        { { .frequency = 220, .decay = 3, .amplitude = 1 }, { .frequency = 2800, .decay = 6, .amplitude = 0.3 } },
        { { .frequency = 440, .decay = 4, .amplitude = 1 },
          { .frequency = 880, .decay = 6, .amplitude = 0.7, .phase = 1 },
          { .frequency = 1320, .decay = 9, .amplitude = 0.5, .phase = 2 },
          { .frequency = 1980, .decay = 12, .amplitude = 0.4, .phase = 3 },
          { .frequency = 2800, .decay = 15, .amplitude = 0.3, .phase = 1 } },
        { { .frequency = 200, .decay = 5, .amplitude = 1 }, { .frequency = 798, .decay = 10, .amplitude = 0.5 }, { .frequency = 2130, .decay = 20, .amplitude = 0.3 } },
        { { .frequency = 2000, .decay = 20, .amplitude = 1 } },
    };
    for (const double noise : { 0.0, 0.02 })
        for (const double rate : { 8e3, 20e3, 48e3 })
            for (const auto& ring : rings)
            {
                const auto fit = fitModes (ringOf (ring, rate, 1.0, noise));
                REQUIRE (fit);
                CAPTURE (noise, rate, ring.front().frequency, fit->report.lacking);
                REQUIRE (fit->tones.size() == ring.size());
                for (std::size_t k = 0; k < ring.size(); ++k)
                {
                    CHECK (fit->tones[k].frequency == Approx (ring[k].frequency).epsilon (2e-4));
                    CHECK (fit->tones[k].decay == Approx (ring[k].decay).epsilon (0.05));
                }
                CHECK (fit->report.is_good);
                if (noise > 0.0) CHECK (fit->report.residual == Approx (noise).epsilon (0.03));
            }
}

TEST_CASE ("fit of modes: a fit is good if only noise is left, however loud the noise is", "[fit]")
{
    const std::vector<Tone> two { { .frequency = 220, .decay = 3, .amplitude = 1 }, { .frequency = 2800, .decay = 6, .amplitude = 0.3 } };
    const auto loud = fitModes (ringOf (two, 20e3, 1.0, 0.5));
    REQUIRE (loud);
    CHECK (loud->tones.size() == 2);
    CHECK (loud->report.residual > 0.8 * loud->report.size);
    CHECK (loud->report.is_good);
}

TEST_CASE ("fit of modes: a fit is poor if a tone is left, however small the residual is", "[fit]")
{
    auto ring = ringOf ({ { .frequency = 220, .decay = 3, .amplitude = 1 }, { .frequency = 2800, .decay = 6, .amplitude = 0.03 } }, 20e3, 1.0, 1e-3);
    ring.most_modes = 1;
    const auto fit = fitModes (ring);
    REQUIRE (fit);
    CHECK (fit->tones.size() == 1);
    CHECK (fit->report.residual < 0.05 * fit->report.size);
    CHECK (lacks (fit->report, "a tone at 2800 Hz"));
    CHECK_FALSE (fit->report.is_good);
}

TEST_CASE ("fit of modes: what is left of two close modes is told at their frequency, not at that of the lowest noise", "[fit]")
{
    for (const auto& [first, second] : { std::pair { 400.0, 412.0 }, { 600.0, 610.0 }, { 1200.0, 1215.0 } })
    {
        const auto fit = fitModes (ringOf (
            { { .frequency = first, .decay = 60, .amplitude = 1 }, { .frequency = second, .decay = 80, .amplitude = 0.8 } }, 10e3, 0.5, 1e-3));
        REQUIRE (fit);
        CAPTURE (first, fit->tones.size());
        for (const auto& lacking : fit->report.lacking)
            if (lacking.starts_with ("a tone at ")) CHECK (std::abs (std::strtod (lacking.c_str() + 10, nullptr) - second) < 0.1 * second);
        CHECK (lacks (fit->report, "a tone at "));
    }
}

TEST_CASE ("fit of modes: a ring whose pitch or decay changes is one mode, and a poor fit", "[fit]")
{
    const double rate = 20e3;
    RecordedRing glide, slower;
    Random random { 4 };
    for (int i = 0; i < 10000; ++i)
    {
        const double t = i / rate;
        for (auto* ring : { &glide, &slower })
            ring->time.push_back (t);
        glide.value.push_back (std::exp (-10.0 * t) * std::sin (full_circle * (300.0 * t - 0.5 * std::exp (-20.0 * t))) + 0.01 * random.normal());
        slower.value.push_back (std::sin (full_circle * 300.0 * t) / (1.0 + 20.0 * t) + 0.01 * random.normal());
    }
    for (const auto& ring : { glide, slower })
    {
        const auto fit = fitModes (ring);
        REQUIRE (fit);
        CHECK_FALSE (fit->report.is_good);
        const auto strongest = std::ranges::max_element (fit->tones, {}, &Tone::energy);
        CHECK (strongest->frequency == Approx (300.0).epsilon (0.03));
        CHECK (strongest->energy > 0.9);
    }
}

TEST_CASE ("fit of modes: noise rings in no mode", "[fit]")
{
    int invented = 0;
    const int draws = test::rounds (100);
    for (int seed = 1; seed <= draws; ++seed)
        if (fitModes (ringOf ({}, 20e3, 0.2, 1.0, static_cast<std::uint64_t> (seed)))) ++invented;
    CHECK (invented <= 1);
}
