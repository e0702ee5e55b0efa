// SPDX-License-Identifier: MIT
// Friction whose load was recorded by a sensor that has noise of its own.

#include "draws.hpp"

#include <support/rounds.hpp>
#include <tactus/fit/friction_fit.hpp>
#include <tactus/fit/smooth_column.hpp>

#include <numbers>

using namespace tactus;

namespace
{
const int draws = test::rounds (16);

bool contains (const FitValue& v, double truth) { return v.low <= truth && truth <= v.high; }

/// Five strokes of 2 mm back and forth, at a load that changes by this much, with 20 mN of noise of the force.
struct Stroked
{
    FrictionFit truth { .adhesion = BristleAdhesion::stick, .mu = 0.55, .d_max = 150e-6, .reference_load = 1.2 };
    RecordedDrag recording {};

    Stroked (Random& random, double change)
    {
        constexpr int rows = 3000;
        for (int i = 0; i < rows; ++i)
        {
            recording.position.push_back (1e-3 * std::sin (2.0 * std::numbers::pi * 5.0 * i / rows));
            recording.load.push_back (1.2 + change * std::sin (0.01 * i));
        }
        recording.force = truth.forceAlong (recording);
        for (double& f : recording.force)
            f += 0.02 * random.normal();
    }
};

bool notes (const FitReport& report, const std::string& words)
{
    return std::ranges::any_of (report.notes, [&] (const std::string& text) { return text.find (words) != std::string::npos; });
}
}   // namespace

TEST_CASE ("fit of friction: noise of the load does not bias mu, d_max or the law", "[fit]")
{
    for (const double change : { 0.0, 0.2 })
        for (const double noise : { 0.01, 0.03 })
        {
            int mu = 0, d_max = 0, stiffness = 0, law = 0;
            for (int seed = 1; seed <= draws; ++seed)
            {
                Random random { static_cast<std::uint64_t> (seed) };
                auto s = Stroked (random, change);
                for (double& load : s.recording.load)
                    load += noise * random.normal();
                const auto fit = fitFriction (s.recording);
                REQUIRE (fit);
                CHECK (notes (fit->report, "smoothed"));
                const double reference = fit->reference_load / s.truth.reference_load;
                mu += contains (fit->report.at ("mu"), s.truth.mu) ? 1 : 0;
                d_max += contains (fit->report.at ("d_max"), s.truth.d_max * reference) ? 1 : 0;
                stiffness += contains (fit->report.at ("stiffness"), s.truth.stiffness()) ? 1 : 0;
                law += fit->adhesion == s.truth.adhesion ? 1 : 0;
            }
            CAPTURE (change, noise);
            const double most = 0.75 * draws;   // right intervals fail in one of 1000 such tests
            CHECK (mu >= most);
            CHECK (d_max >= most);
            CHECK (stiffness >= most);
            CHECK (law >= most);
        }
}

TEST_CASE ("fit of friction: a load that really changes from row to row is not smoothed", "[fit]")
{
    Random random { 3 };
    auto s = Stroked (random, 0.0);
    for (double& load : s.recording.load)
        load += 0.1 * random.normal();
    s.recording.force = s.truth.forceAlong (s.recording);
    for (double& f : s.recording.force)
        f += 0.02 * random.normal();
    const auto fit = fitFriction (s.recording);
    REQUIRE (fit);
    CHECK (notes (fit->report, "the force follows it"));
    CHECK (contains (fit->report.at ("mu"), s.truth.mu));
}

TEST_CASE ("fit of friction: a force that grows with the speed does not make it follow the noise of the load", "[fit]")
{
    constexpr int rows = 8000;
    constexpr double turn = 2.0 * std::numbers::pi * 4.0 / rows;   // four strokes
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
    {
        Random random { seed };
        const FrictionFit truth { .adhesion = BristleAdhesion::stick, .mu = 0.5, .d_max = 200e-6, .reference_load = 1.0 };
        RecordedDrag recording {};
        for (int i = 0; i < rows; ++i)
            recording.position.push_back (3e-3 * std::sin (turn * i));
        recording.load.assign (rows, 1.0);
        recording.force = truth.forceAlong (recording);
        for (int i = 0; i < rows; ++i)
        {
            const auto k = static_cast<std::size_t> (i);
            recording.force[k] -= 0.1 * std::cos (turn * i) + 0.02 * random.normal();
            recording.load[k] += 0.01 * random.normal();
        }
        const auto fit = fitFriction (recording);
        REQUIRE (fit);
        CAPTURE (seed);
        CHECK (notes (fit->report, "smoothed"));
        CHECK_FALSE (notes (fit->report, "the force follows it"));
    }
}

TEST_CASE ("a smooth column: a straight line stays, noise goes, and its size is known", "[fit]")
{
    Random random { 2 };
    constexpr Eigen::Index rows = 1000;
    Eigen::VectorXd line = Eigen::VectorXd::LinSpaced (rows, 1.0, 2.0), noisy = line;
    CHECK ((detail::smoothed (line, 1e4) - line).norm() < 1e-6);
    for (double& v : noisy)
        v += 0.1 * random.normal();
    const auto curve = detail::smoothed (noisy);
    CHECK (curve.noise == Approx (0.1).epsilon (0.1));
    CHECK ((curve.values - line).norm() < 0.3 * (noisy - line).norm());
    CHECK (curve.rows > 10.0);
}
