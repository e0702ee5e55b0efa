// SPDX-License-Identifier: GPL-3.0-or-later
// `tactus render --listen`: a sound for loudspeakers.
#include "program.hpp"

#include <host/base/files/wav.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace tactus;
using namespace tactus::test;

namespace
{
/// The amplitude of a tone in the second half of a sound.
double toneAt (const std::vector<double>& sound, double hz)
{
    double re = 0.0, im = 0.0;
    const auto first = sound.size() / 2, count = sound.size() - first;
    for (std::size_t k = first; k < sound.size(); ++k)
    {
        const double angle = 2.0 * std::numbers::pi * hz * static_cast<double> (k) / 48e3;
        re += sound[k] * std::cos (angle);
        im += sound[k] * std::sin (angle);
    }
    return 2.0 * std::hypot (re, im) / static_cast<double> (count);
}

/// A graph in which a fed signal drives the force along x, and its opposite the force along y.
const char* const both_ways = R"({ "format": "tactus-graph", "version": 2, "rate_hz": 4000,
      "nodes": { "tone": { "type": "signal.gain" }, "minus": { "type": "signal.gain", "params": { "gain": -1 } },
                 "motor": { "type": "device.force", "role": "tip" } },
      "wires": [ "tone.out -> minus.in", "tone.out -> motor.force.x", "minus.out -> motor.force.y" ] })";

/// A second and a half of a signal at 4 kHz, as a feed.
template <typename Signal>
std::string feedOf (Signal&& at)
{
    std::string csv = "t,tone.in\n";
    for (int k = 0; k < 6000; ++k)
        csv += std::to_string (k / 4000.0) + "," + std::to_string (at (k / 4000.0)) + "\n";
    return csv;
}

double tone (double hz, double t) { return std::sin (2.0 * std::numbers::pi * hz * t); }
}   // namespace

TEST_CASE ("a recording becomes a mono sound at 48 kHz, at -3 dBFS, without its constant part", "[cli]")
{
    const Scratch scratch;
    const auto graph = scratch.write ("g.json", both_ways), feed = scratch.write ("f.csv", feedOf ([] (double t) { return 5.0 + 0.25 * tone (200.0, t); }));
    const auto file = scratch.path ("l.wav");
    const auto ran = runTactus ({ "render", graph, "--feed", feed, "--record", "motor.force", "--listen", file });
    INFO (ran.err);
    REQUIRE (ran.status == 0);
    CHECK (ran.out.empty());
    const auto sound = host::readWav (file);
    REQUIRE (sound);
    CHECK (sound->rate_hz == 48e3);
    REQUIRE (sound->channels.size() == 1);
    const auto& samples = sound->channels[0];
    CHECK (samples.size() == Approx (72'000).margin (2));
    double peak = 0.0, mean = 0.0;
    for (const double s : samples)
    {
        peak = std::max (peak, std::abs (s));
        mean += s / static_cast<double> (samples.size());
    }
    CHECK (peak == Approx (std::pow (10.0, -3.0 / 20.0)).epsilon (1e-3));
    CHECK (std::abs (mean) < 0.01);
    CHECK (toneAt (samples, 200.0) > 0.6);   // x and y are opposite; a plain sum would be silent
}

TEST_CASE ("a sound is high-passed at 20 Hz", "[cli]")
{
    const Scratch scratch;
    const auto loudnessOf = [&] (double hz) {
        const auto graph = scratch.write ("g.json", both_ways);
        const auto feed = scratch.write ("f.csv", feedOf ([hz] (double t) { return tone (300.0, t) + tone (hz, t); }));
        const auto file = scratch.path ("l.wav");
        REQUIRE (runTactus ({ "render", graph, "--feed", feed, "--record", "tone.out", "--listen", file }).status == 0);
        const auto sound = host::readWav (file);
        REQUIRE (sound);
        return toneAt (sound->channels[0], hz) / toneAt (sound->channels[0], 300.0);
    };
    CHECK (loudnessOf (20.0) == Approx (std::numbers::sqrt2 / 2.0).epsilon (0.02));
    CHECK (loudnessOf (5.0) == Approx (1.0 / 16.0).epsilon (0.1));   // 12 dB per octave
    CHECK (loudnessOf (100.0) == Approx (1.0).epsilon (0.01));
}

TEST_CASE ("a recording that is too slow to hear becomes silence, with a warning", "[cli]")
{
    const Scratch scratch;
    const auto graph = scratch.write ("g.json", both_ways), feed = scratch.write ("f.csv", feedOf ([] (double) { return 5.0; }));
    const auto ran = runTactus ({ "render", graph, "--feed", feed, "--listen", scratch.path ("l.wav") });
    CHECK (ran.status == 0);
    CHECK (ran.err.find ("listen/silent") != std::string::npos);
    CHECK (runTactus ({ "render", graph, "--feed", feed, "--listen", scratch.path ("l.mp3") }).err.find ("output/kind") != std::string::npos);
}
