// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/fit/shock_fit.hpp>
#include <tactus/kit/free_impact.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

using tactus::fitShock;
using tactus::MotionState;
using tactus::RecordedLoop;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A law k d^n (1 + lambda d') or, if B0 is given, k d^n + B0 d d', and an impact on it.
struct Blow
{
    double k = 5e5, n = 1.5, lambda = 0.5, m = 0.03, v = 0.8, B0 = 0.0;

    double force (double d, double rate) const
    {
        if (! (d > 0.0)) return 0.0;
        const double spring = k * std::pow (d, n);
        return std::max (0.0, B0 > 0.0 ? spring + B0 * d * rate : spring * (1.0 + lambda * rate));
    }
};

Blow randomBlow (std::mt19937& random)
{
    const auto size = [&] (double from, double to) { return std::exp (std::uniform_real_distribution { std::log (from), std::log (to) }(random)); };
    Blow blow { .n = size (1.0, 2.5), .m = size (0.005, 0.5), .v = size (0.1, 2.0) };
    const double deepest = size (1e-4, 5e-3);
    blow.k = 0.5 * (blow.n + 1.0) * blow.m * blow.v * blow.v / std::pow (deepest, blow.n + 1.0);
    blow.lambda = size (0.02, 2.0) / blow.v;
    return blow;
}

/// A recording of a free impact, with rows before the touch and after it.
RecordedLoop record (const Blow& blow, int rows = 400)
{
    const auto force = [&] (double d, double v) noexcept { return blow.force (d, v); };
    const auto out = tactus::freeImpact (force, blow.m, blow.v, 1e3);
    REQUIRE (out.isKnown());
    const double step = out.duration / rows;
    RecordedLoop loop;
    const auto add = [&] (double t, double d, double v) {
        loop.time.push_back (t);
        loop.depth.push_back (d);
        loop.force.push_back (force (d, v));
    };
    for (int i = -3; i <= 0; ++i)
        add ((i - 0.5) * step, (i - 0.5) * step * blow.v, blow.v);
    int row = 0;
    tactus::freeImpact (force, blow.m, blow.v, 2.0 * out.duration, step, [&] (const MotionState& x) noexcept { add (++row * step, x.d, x.v); });
    for (int i = row + 1; i < row + 4; ++i)
        add (i * step, (out.duration - i * step) * out.speed, -out.speed);
    return loop;
}

double areaOf (const std::vector<double>& depth, const std::vector<double>& force)
{
    double sum = 0.0;
    for (std::size_t i = 1; i < depth.size(); ++i)
        sum += 0.5 * (force[i - 1] + force[i]) * (depth[i] - depth[i - 1]);
    return sum;
}

std::string problem (const RecordedLoop& loop, double mass = 0.05)
{
    const auto fit = fitShock (loop, mass);
    return fit ? "" : fit.error().id;
}
}   // namespace

TEST_CASE ("fit of a shock: it finds the law of an impact, its mass and its speed", "[kit][shock]")
{
    tactus::test::property ("any impact", [] (unsigned seed) {
        std::mt19937 random { seed };
        const auto blow = randomBlow (random);
        const auto fit = fitShock (record (blow));
        RC_ASSERT (fit.has_value());
        RC_ASSERT (std::abs (fit->stiffness.b - blow.n) <= 0.02);
        RC_ASSERT (std::abs (fit->damping.a / blow.lambda - 1.0) <= 0.02);
        RC_ASSERT (std::abs (fit->mass / blow.m - 1.0) <= 0.01);
        RC_ASSERT (std::abs (fit->speed / blow.v - 1.0) <= 0.01);
        RC_ASSERT (fit->residual <= 0.01 * fit->peak);
        RC_ASSERT (std::abs (fit->fitted_area / fit->recorded_area - 1.0) <= 1e-9);
        RC_ASSERT (std::abs (fit->played_area / fit->recorded_area - 1.0) <= 0.02);
    });
}

TEST_CASE ("fit of a shock: without times it needs only the mass", "[kit][shock]")
{
    tactus::test::property ("any impact", [] (unsigned seed) {
        std::mt19937 random { seed };
        const auto blow = randomBlow (random);
        auto loop = record (blow);
        loop.time.clear();
        const auto fit = fitShock (loop, blow.m);
        RC_ASSERT (fit.has_value());
        RC_ASSERT (std::abs (fit->stiffness.b - blow.n) <= 0.02);
        RC_ASSERT (std::abs (fit->damping.a / blow.lambda - 1.0) <= 0.03);
        RC_ASSERT (std::abs (fit->speed / blow.v - 1.0) <= 0.01);
        RC_ASSERT (std::abs (fit->fitted_area / fit->recorded_area - 1.0) <= 1e-9);
        RC_ASSERT (std::abs (fit->played_area / fit->recorded_area - 1.0) <= 0.02);
    });
}

TEST_CASE ("fit of a shock: a damping B0 d is found, with the power of the spring, under noise", "[kit][shock]")
{
    std::mt19937 random { 5 };
    for (int draw = 0; draw < 40; ++draw)
    {
        auto blow = randomBlow (random);
        blow.n = std::uniform_real_distribution { 1.5, 2.5 }(random);
        const double deepest = std::pow (0.5 * (blow.n + 1.0) * blow.m * blow.v * blow.v / blow.k, 1.0 / (blow.n + 1.0));
        blow.B0 = std::uniform_real_distribution { 0.3, 0.8 }(random)*blow.k * std::pow (deepest, blow.n - 1.0) / blow.v;
        auto loop = record (blow);
        const double peak = *std::ranges::max_element (loop.force);
        std::normal_distribution<double> noise { 0.0, 0.01 * peak };
        for (std::size_t i = 0; i < loop.force.size(); ++i)
            if (loop.force[i] > 0.0) loop.force[i] += noise (random);
        const auto fit = fitShock (loop);
        REQUIRE (fit);
        CAPTURE (draw, blow.n, fit->stiffness.b, fit->damping.a / blow.B0);
        REQUIRE (fit->damping.kind == tactus::Law::Kind::power);
        CHECK (fit->damping.b == 1.0);
        CHECK (fit->damping.a == Approx (blow.B0).epsilon (0.1));
        CHECK (fit->stiffness.b == Approx (blow.n).margin (0.1));
        CHECK (fit->report.at ("damping per depth").unit == "N*s/m2");
        CHECK (fit->played_area == Approx (fit->recorded_area).epsilon (0.05));
    }
}

TEST_CASE ("fit of a shock: a damping lambda K is never taken for B0 d, under noise", "[kit][shock]")
{
    std::mt19937 random { 6 };
    for (int draw = 0; draw < 60; ++draw)
    {
        const auto blow = randomBlow (random);
        auto loop = record (blow);
        std::normal_distribution<double> noise { 0.0, 0.02 * *std::ranges::max_element (loop.force) };
        for (double& f : loop.force)
            f += noise (random);
        const auto fit = fitShock (loop);
        if (! fit) continue;   // noise may be larger than a small loss
        CAPTURE (draw, blow.n, blow.lambda * blow.v);
        CHECK (fit->damping.kind == tactus::Law::Kind::dissipation);
    }
}

TEST_CASE ("fit of a shock: the interval of the mass contains it in spite of noise of the depth", "[kit][shock]")
{
    constexpr int draws = 60;
    for (const double noise : { 20e-9, 200e-9 })
    {
        int covered = 0;
        double width = 0.0;
        for (unsigned seed = 1; seed <= draws; ++seed)
        {
            std::mt19937 random { seed };
            std::normal_distribution<double> error;
            auto loop = record ({ .k = 2e6, .n = 1.5, .lambda = 0.35, .m = 0.15, .v = 0.35 });
            for (double& d : loop.depth)
                d += noise * error (random);
            for (double& f : loop.force)
                f += 0.005 * error (random);
            const auto fit = fitShock (loop);
            REQUIRE (fit);
            const auto& mass = fit->report.at ("mass");
            if (mass.low <= 0.15 && 0.15 <= mass.high) ++covered;
            width += (mass.high - mass.low) / draws;
        }
        CAPTURE (noise, covered, width);
        CHECK (covered >= 0.85 * draws);   // right intervals fail in one of 1000 such tests
        CHECK (width < 5e5 * noise);       // 0.01 kg for 20 nm
    }
}

TEST_CASE ("fit of a shock: the speed at the touch is known in spite of noise of the depth, and so is its error", "[kit][shock]")
{
    constexpr int draws = 20;
    const Blow blow { .k = 2e5, .n = 1.5, .lambda = 0.4, .m = 0.05, .v = 0.5 };
    int near = 0;
    for (unsigned seed = 1; seed <= draws; ++seed)
    {
        std::mt19937 random { seed };
        std::normal_distribution<double> error;
        auto loop = record (blow, 430);
        for (double& d : loop.depth)
            d += 5e-7 * error (random);
        for (double& f : loop.force)
            f += 0.15 * error (random);
        const auto fit = fitShock (loop);
        REQUIRE (fit);
        CAPTURE (seed, fit->speed, fit->speed_error, fit->mass);
        CHECK (fit->speed == Approx (blow.v).epsilon (0.06));
        CHECK (fit->played_area == Approx (fit->recorded_area).epsilon (0.2));
        if (std::abs (fit->speed - blow.v) < 2.0 * fit->speed_error) ++near;
    }
    CHECK (near >= 0.75 * draws);   // right errors fail in one of 1000 such tests
}

TEST_CASE ("fit of a shock: noise of the depth does not hide a part of the dissipation", "[kit][shock]")
{
    constexpr int draws = 40;
    const Blow blow { .k = 3e5, .n = 1.5, .lambda = 0.4, .m = 0.1, .v = 0.5 };
    for (const double noise : { 0.8e-6, 1.5e-6, 3e-6, 7e-6 })   // to half a percent of the depth
    {
        int covered = 0;
        double mean = 0.0;
        for (unsigned seed = 1; seed <= draws; ++seed)
        {
            std::mt19937 random { seed };
            std::normal_distribution<double> error;
            auto loop = record (blow, 480);
            const double peak = *std::ranges::max_element (loop.force);
            for (double& d : loop.depth)
                d += noise * error (random);
            for (double& f : loop.force)
                f += 0.01 * peak * error (random);
            const auto fit = fitShock (loop);
            REQUIRE (fit);
            const auto& lambda = fit->report.at ("dissipation");
            mean += lambda.value / draws;
            if (lambda.low <= blow.lambda && blow.lambda <= lambda.high) ++covered;
        }
        CAPTURE (noise, covered, mean);
        if (noise < 5e-6) CHECK (mean == Approx (blow.lambda).epsilon (0.02));
        CHECK (covered >= 0.8 * draws);
    }
}

TEST_CASE ("fit of a shock: the areas match, whatever law, noise and path the recording has", "[kit][shock][energy]")
{
    tactus::test::property ("an indentation driven by the hand, with a loop that no k d^n fits", [] (unsigned seed) {
        std::mt19937 random { seed };
        std::normal_distribution<double> noise;
        const double deepest = std::uniform_real_distribution { 1e-4, 5e-3 }(random), loss = std::uniform_real_distribution { 0.05, 0.8 }(random);
        RecordedLoop loop;
        for (int i = 0; i <= 200; ++i)
        {
            const double x = i / 200.0, way = std::sin (M_PI * x), d = deepest * way * (x > 0.5 ? 1.0 : way);
            loop.time.push_back (0.3 * x);
            loop.depth.push_back (d);
            loop.force.push_back (std::tanh (2.0 * d / deepest) * (x > 0.5 ? 1.0 - loss : 1.0) + 0.01 * noise (random));
        }
        const auto fit = fitShock (loop, 0.05);
        RC_ASSERT (fit.has_value());
        RC_ASSERT (fit->fitted_area > 0.0);
        RC_ASSERT (std::abs (areaOf (fit->depth, fit->fitted) / areaOf (fit->depth, fit->recorded) - 1.0) <= 1e-9);
        RC_ASSERT (fit->residual <= 0.5 * fit->peak);
    });
}

TEST_CASE ("fit of a shock: a loop without area has no damping", "[kit][shock]")
{
    const auto fit = fitShock (record ({ .lambda = 0.0 }));
    REQUIRE (fit);
    CHECK (fit->damping.a == Approx (0.0).margin (1e-3));
    CHECK (fit->stiffness.a == Approx (5e5).epsilon (0.02));
}

TEST_CASE ("fit of a shock: a recording that contains no impact is refused, with the reason", "[kit][shock]")
{
    const auto good = record ({});
    CHECK (problem (good) == "");

    CHECK (problem ({}) == "fit/too_short");
    CHECK (problem ({ .depth = good.depth, .force = { 1.0 } }) == "fit/too_short");

    auto bad = good;
    bad.force[50] = not_a_number;
    CHECK (problem (bad) == "fit/not_finite");

    bad = good;
    std::swap (bad.time[10], bad.time[11]);
    CHECK (problem (bad) == "fit/time");

    bad = good;
    for (double& d : bad.depth)
        d = -std::abs (d);
    CHECK (problem (bad) == "fit/no_contact");

    bad = good;   // without the way out
    const auto deepest = std::ranges::max_element (bad.depth) - bad.depth.begin();
    for (auto* column : { &bad.depth, &bad.force, &bad.time })
        column->resize (std::size_t (deepest) + 1);
    CHECK (problem (bad) == "fit/no_loop");

    bad = good;
    std::ranges::reverse (bad.force);   // the object pushes harder on the way out
    CHECK (problem (bad) == "fit/gains_energy");

    bad = good;
    bad.time.clear();
    CHECK (problem (bad, 0.0) == "fit/mass");

    bad = good;
    for (std::size_t i = 0; i < bad.depth.size(); ++i)
        bad.force[i] = bad.depth[i] > 0.0 && int (i) < deepest ? -1.0 : -2.0;
    CHECK (problem (bad) == "fit/no_spring");
}
