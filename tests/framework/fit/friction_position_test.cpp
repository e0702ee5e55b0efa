// SPDX-License-Identifier: MIT
// Friction whose position was recorded by a sensor that has noise of its own.

#include "draws.hpp"

#include <support/rounds.hpp>
#include <tactus/fit/friction_fit.hpp>

#include <numbers>

using namespace tactus;

namespace
{
const int draws = test::rounds (8);

/// Three strokes of 3 mm back and forth at 0.5 Hz, recorded at 1 kHz, with 20 mN of noise of the force.
struct StrokedAt
{
    FrictionFit truth { .mu = 0.35, .d_max = 80e-6, .reference_load = 2.0 };
    RecordedDrag recording { .assumed_load = 2.0 };

    StrokedAt (Random& random, BristleAdhesion adhesion, double noise)
    {
        truth.adhesion = adhesion;
        constexpr int rows = 6000;
        for (int i = 0; i < rows; ++i)
            recording.position.push_back (1.5e-3 * std::sin (std::numbers::pi * i / 1000.0));
        recording.force = truth.forceAlong (recording);
        for (int i = 0; i < rows; ++i)
        {
            recording.position[static_cast<std::size_t> (i)] += noise * random.normal();
            recording.force[static_cast<std::size_t> (i)] += 0.02 * random.normal();
        }
    }
};

bool hasWords (const std::vector<std::string>& texts, const std::string& words)
{
    return std::ranges::any_of (texts, [&] (const std::string& text) { return text.find (words) != std::string::npos; });
}
}   // namespace

TEST_CASE ("fit of friction: noise of the position does not bias d_max or the law", "[fit]")
{
    for (const auto adhesion : { BristleAdhesion::stick, BristleAdhesion::dahl })
        for (const double noise : { 0.5e-6, 1e-6 })
        {
            int d_max = 0, law = 0;
            for (int seed = 1; seed <= draws; ++seed)
            {
                Random random { static_cast<std::uint64_t> (seed) };
                const auto s = StrokedAt (random, adhesion, noise);
                const auto fit = fitFriction (s.recording);
                REQUIRE (fit);
                CHECK (hasWords (fit->report.notes, "the position has noise"));
                const auto& found = fit->report.at ("d_max");
                d_max += found.low <= s.truth.d_max && s.truth.d_max <= found.high ? 1 : 0;
                law += fit->adhesion == adhesion ? 1 : 0;
            }
            CAPTURE (noise);
            const double most = 0.6 * draws;   // right intervals fail in one of 1000 such tests
            CHECK (d_max >= most);
            CHECK (law >= most);
        }
}

TEST_CASE ("fit of friction: the verdict is poor if a noisy position has corners that smoothing would cut", "[fit]")
{
    for (const double noise : { 0.0, 2e-6 })
    {
        Random random { 4 };
        FrictionFit truth { .adhesion = BristleAdhesion::stick, .mu = 0.35, .d_max = 80e-6, .reference_load = 2.0 };
        RecordedDrag drag { .assumed_load = 2.0 };
        for (int i = 0; i < 600; ++i)
            drag.position.push_back (3e-5 * std::abs (i % 200 - 100));
        drag.force = truth.forceAlong (drag);
        for (double& f : drag.force)
            f += 0.02 * random.normal();
        for (double& at : drag.position)
            at += noise * random.normal();
        const auto fit = fitFriction (drag);
        REQUIRE (fit);
        CAPTURE (noise);
        CHECK (fit->report.is_good == (noise == 0.0));
        CHECK (hasWords (fit->report.lacking, "smooth the position") == (noise > 0.0));
        CHECK (hasWords (fit->report.notes, "the position has noise") == (noise > 0.0));
    }
}
