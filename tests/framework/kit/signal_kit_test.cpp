// SPDX-License-Identifier: MIT
// The parts shared by nodes that play recordings and noise: lattice, stream resampler, recording, windowed sinc.

#include <support/property.hpp>
#include <tactus/kit/geometry/lattice.hpp>
#include <tactus/kit/random.hpp>
#include <tactus/kit/signal/recording.hpp>
#include <tactus/kit/signal/stream_resampler.hpp>

#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

using namespace tactus;

TEST_CASE ("lattice: the same filter as the recursion it was derived from", "[framework][signal]")
{
    const std::vector<double> a { 1.2, -0.6, 0.1 };
    const auto reflections = reflectionsOf (a);
    REQUIRE (reflections.size() == 3);

    Lattice lattice;
    lattice.start (3, [] { return 0.0; });
    // The y of the lattice is sqrt (prod (1 - k^2)) times the y of the recursion.
    const double gain = std::sqrt (lattice.set ([&reflections] (std::size_t i) { return reflections[i]; }));

    double y[3] {};
    Random random { 1 };
    for (int n = 0; n < 100; ++n)
    {
        const double e = random.normal();
        const double next = a[0] * y[0] + a[1] * y[1] + a[2] * y[2] + e;
        y[2] = y[1];
        y[1] = y[0];
        y[0] = next;
        CHECK (lattice (e) / gain == Approx (next).margin (1e-12));
    }
}

TEST_CASE ("lattice: an unstable recursion has no reflection coefficients", "[framework][signal]")
{
    CHECK (reflectionsOf ({ 2.1 }).empty());
    CHECK (reflectionsOf ({ 1.6, -1.0 }).empty());
    CHECK (reflectionsOf ({ 1.6, -0.8 }).size() == 2);
    CHECK (reflectionsOf ({}).empty());
}

TEST_CASE ("stream resampler: with equal rates, samples pass through bit for bit", "[framework][signal]")
{
    StreamResampler resampler;
    resampler.prepare (1.0);
    for (int i = 0; i < 10; ++i)
        CHECK (resampler ([i] { return 0.1 * i; })
               == 0.1 * i);
}

TEST_CASE ("stream resampler: a sine in the pass band passes, but one above half the lower rate does not", "[framework][signal]")
{
    for (const double ratio : { 0.25, 0.7, 3.0 })
    {
        INFO (ratio);
        const auto amplitude = [ratio] (double frequency)   // in cycles per sample of the lower rate
        {
            const double turn = 2.0 * std::numbers::pi * frequency * std::min (1.0, 1.0 / ratio);
            int n = 0;
            const auto next = [&] { return std::sin (turn * n++); };
            StreamResampler resampler;
            resampler.prepare (ratio);
            resampler.fill (next);
            double square = 0.0;
            for (int i = 0; i < 5000; ++i)
                square += std::pow (resampler (next), 2) / 5000;
            return std::sqrt (2.0 * square);
        };
        CHECK (amplitude (0.35) == Approx (1.0).epsilon (0.01));
        if (ratio > 1.0) CHECK (amplitude (0.51) < 2e-3);
    }
}

TEST_CASE ("recording: bent ends are 0, and the middle is unchanged", "[framework][signal]")
{
    std::vector<double> samples (1000, 1.0);
    bendEndsToZero (samples, 8000.0);
    CHECK (samples.front() == Approx (0.0).margin (1e-15));
    CHECK (samples.back() == Approx (0.0).margin (1e-15));
    for (std::size_t i = 16; i < 984; ++i)
        REQUIRE (samples[i] == 1.0);
}

TEST_CASE ("recording: the forward-backward low-pass is 6 dB down at its cutoff and adds no delay", "[framework][signal]")
{
    const auto filtered = [] (double frequency_hz) {
        std::vector<double> samples;
        for (int i = -4000; i <= 4000; ++i)
            samples.push_back (std::cos (2.0 * std::numbers::pi * frequency_hz * i / 8000.0));
        lowPassBothWays (samples, 1000.0, 8000.0);
        return samples[4000];   // the cosine is 1 here
    };
    CHECK (filtered (200.0) == Approx (1.0).epsilon (1e-3));
    CHECK (filtered (1000.0) == Approx (0.5).epsilon (1e-3));
    CHECK (std::abs (filtered (1700.0)) < 1e-3);
}

TEST_CASE ("the value between two entries of a table has the bits of std::lerp", "[framework][signal]")
{
    test::property ("any entries and place", [] {
        const auto entry = rc::gen::oneOf (rc::gen::element (0.0, -0.0, 1.0, -1.0, 1e-200, -1e-200, 5e-324), rc::gen::arbitrary<double>(),
                                           rc::gen::map (rc::gen::inRange (-5, 6), [] (int n) { return 1.0 + 0x1p-52 * n; }));
        const double table[] { 7.0, *entry, *entry };
        const auto fine = rc::gen::map (rc::gen::inRange (0, 1 << 20), [] (int n) { return n * 0x1p-20; });
        const double part = *rc::gen::oneOf (rc::gen::element (0.0, 0.5, 1.0 - 0x1p-50), fine);
        const double expected = std::lerp (table[1], table[2], (1.0 + part) - 1.0);
        RC_PRE (std::isfinite (expected));
        RC_ASSERT (std::bit_cast<std::uint64_t> (betweenEntries (table, 1.0 + part)) == std::bit_cast<std::uint64_t> (expected));
    });
}

TEST_CASE ("windowed sinc: I_0 has its tabulated values", "[framework][signal]")
{
    CHECK (besselI0 (0.0) == 1.0);
    CHECK (besselI0 (1.0) == Approx (1.2660658777520082).epsilon (1e-15));
    CHECK (besselI0 (5.65) == Approx (std::cyl_bessel_i (0.0, 5.65)).epsilon (1e-13));
    CHECK (sinc (0.0) == 1.0);
    CHECK (sinc (std::numbers::pi) == Approx (0.0).margin (1e-15));
    CHECK (kaiser60 (1.0) == 1.0);
}
