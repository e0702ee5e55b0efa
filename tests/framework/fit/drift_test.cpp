// SPDX-License-Identifier: MIT
// Objects that change during the recording: a surface that wears off, a texture that becomes rougher.

#include "draws.hpp"

#include <support/rounds.hpp>
#include <tactus/fit/friction_fit.hpp>
#include <tactus/fit/grating_fit.hpp>
#include <tactus/fit/least_squares.hpp>
#include <tactus/fit/texture_fit.hpp>

#include <numbers>

using namespace tactus;
using test::addNoise;

namespace
{
const int draws = test::rounds (100);

bool contains (const FitValue& v, double truth) { return v.low <= truth && truth <= v.high; }

/// Eight strokes of 0.7 mm with this mu in each half of the recording.
RecordedDrag worn (Random& random, double first, double second)
{
    RecordedDrag drag;
    constexpr int rows = 800;
    for (int i = 0; i < rows; ++i)
    {
        const double phase = std::fmod (8.0 * i / rows, 1.0);
        drag.position.push_back (7e-4 * (1.0 - std::abs (2.0 * phase - 1.0)));
        drag.load.push_back (1.5);
    }
    const auto forceAt = [&] (double mu) {
        FrictionFit truth { .adhesion = BristleAdhesion::stick, .mu = mu, .d_max = 1e-4 };
        truth.reference_load = 1.5;
        return truth.forceAlong (drag);
    };
    drag.force = forceAt (first);
    const auto late = forceAt (second);
    std::copy (late.begin() + rows / 2, late.end(), drag.force.begin() + rows / 2);
    addNoise (drag.force, random);
    return drag;
}

/// Autoregressive noise at 2 kHz whose deviation changes in the middle.
RecordedTexture rougher (Random& random, double first, double second)
{
    RecordedTexture texture { .most_coefficients = 3 };
    constexpr int rows = 4000;
    double before = 0.0, earlier = 0.0;
    for (int i = 0; i < rows; ++i)
    {
        const double y = 1.2 * before - 0.7 * earlier + (i < rows / 2 ? first : second) * random.normal();
        earlier = before;
        before = y;
        texture.time.push_back (i / 2000.0);
        texture.acceleration.push_back (y);
    }
    addNoise (texture.acceleration, random);
    return texture;
}
}   // namespace

TEST_CASE ("fits: where the halves of a recording disagree, the interval contains what both say", "[fit]")
{
    int both = 0, rough = 0;
    double drifting = 0.0, steady = 0.0;
    for (int seed = 1; seed <= draws; ++seed)
    {
        Random random { static_cast<std::uint64_t> (seed) };
        const auto fit = fitFriction (worn (random, 0.47, 0.49)), same = fitFriction (worn (random, 0.48, 0.48));
        REQUIRE (fit);
        REQUIRE (same);
        const auto &mu = fit->report.at ("mu"), &other = same->report.at ("mu");
        if (contains (mu, 0.47) && contains (mu, 0.49)) ++both;
        drifting += mu.high - mu.low;
        steady += other.high - other.low;
        const auto texture = fitTexture (rougher (random, 0.8, 1.2));
        REQUIRE (texture);
        const auto& variance = texture->report.at ("model 1 variance");
        if (variance.high / variance.low > 1.44 / 0.64) ++rough;   // as far apart as the two variances
    }
    CHECK (both >= 0.9 * draws);
    CHECK (rough >= 0.9 * draws);
    CHECK (drifting > 1.7 * steady);
}

TEST_CASE ("fits: parts that agree leave an interval as it is, and a part that disagrees widens only what it disagrees about", "[fit]")
{
    Eigen::MatrixXd covariance (2, 2), of_quarters (2, 4);
    covariance << 1.0, 0.5, 0.5, 1.0;
    of_quarters << 0.1, -0.1, 0.1, -0.1, 2.0, 2.0, -2.0, -2.0;   // the second estimate of the halves differs by 16 deviations
    detail::widenByParts (covariance, of_quarters);
    CHECK (covariance (0, 0) == 1.0);
    CHECK (covariance (1, 1) == Approx (64.0));   // the variance of a mean of two: a quarter of the squared difference
    CHECK (covariance (0, 1) == Approx (4.0));    // as correlated as before

    covariance << std::numeric_limits<double>::infinity(), 0.0, 0.0, 0.0;   // what the recording does not determine
    detail::widenByParts (covariance, of_quarters);
    CHECK (std::isinf (covariance (0, 0)));
    CHECK (covariance (1, 1) == 0.0);
}
