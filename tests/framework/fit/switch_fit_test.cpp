// SPDX-License-Identifier: MIT
// Recordings of a key that clicks, made from known curves.

#include "draws.hpp"

#include <support/rounds.hpp>
#include <tactus/fit/switch_fit.hpp>

using namespace tactus;
using test::between;
using test::Draws;

namespace
{
/// A stroke of 4 mm down and up, which returns with a part of the force.
RecordedLoop stroke (Random& random)
{
    constexpr int rows = 800;   // of each way
    const double click = between (random, 0.1, 0.3), part = between (random, 0.75, 0.95);
    RecordedLoop key;
    for (int i = 0; i <= 2 * rows; ++i)
    {
        const double x = 4.0 * std::min (i, 2 * rows - i) / rows;   // mm
        const double force = 0.6 * std::min (1.0, 2.0 * x) - click * std::clamp ((x - 1.5) / 0.4, 0.0, 1.0) + 0.6 * std::max (0.0, x - 3.0);
        key.depth.push_back (1e-3 * x);
        key.force.push_back (force * (i <= rows ? 1.0 : part));
    }
    return key;
}
}   // namespace

TEST_CASE ("fit of a key: intervals contain the lost energy, which is within 1 %, and the loop follows the recording", "[fit]")
{
    const int draws = test::rounds (300);
    Draws tally;
    for (int seed = 1; seed <= draws; ++seed)
    {
        Random random { static_cast<std::uint64_t> (seed) };
        auto key = stroke (random);
        double lost = 0.0;
        for (std::size_t i = 1; i < key.depth.size(); ++i)
            lost += 0.5 * (key.force[i] + key.force[i - 1]) * (key.depth[i] - key.depth[i - 1]);
        constexpr double noise = 0.01, tolerance = 0.02;   // N
        for (double& f : key.force)
            f += noise * random.normal();
        const auto fit = fitSwitch (key, tolerance);
        REQUIRE (fit);
        CHECK (fit->report.residual < tolerance);
        tally.add ("lost energy", fit->report.at ("lost energy"), lost);
    }
    tally.check ("lost energy", 0.01, draws);
}

TEST_CASE ("fit of a key: numbers near the largest are refused, and a tiny recording has a report", "[fit]")
{
    const auto huge = fitSwitch ({ { 0.0, 1e300, 2e300, 1e300, 0.0 }, { 0.0, 1e300, 2e300, 5e299, 0.0 } }, 0.01);
    REQUIRE_FALSE (huge);
    CHECK (huge.error().id == "fit/not_finite");
    const auto tiny = fitSwitch ({ { 0.0, 1e-3, 0.0 }, { 0.0, 1.0, 0.0 } }, 0.01);
    REQUIRE (tiny);
    CHECK (tiny->report.rows == 3);
    CHECK (tiny->report.at ("lost energy").low <= tiny->report.at ("lost energy").value);
}
