// SPDX-License-Identifier: MIT
// Recordings that do not contain everything, contain no noise, or are of something else.

#include "draws.hpp"

#include <tactus/fit/blade_fit.hpp>
#include <tactus/fit/curve_fit.hpp>
#include <tactus/fit/friction_fit.hpp>
#include <tactus/fit/grating_fit.hpp>
#include <tactus/fit/least_squares.hpp>
#include <tactus/fit/modes_fit.hpp>
#include <tactus/fit/texture_fit.hpp>

#include <numbers>

using namespace tactus;

namespace
{
constexpr double full_circle = 2.0 * std::numbers::pi;

bool lacks (const FitReport& report, const std::string& words)
{
    return std::ranges::any_of (report.lacking, [&] (const std::string& text) { return text.find (words) != std::string::npos; });
}

struct Stretch
{
    double a1, a2, deviation, speed, force;
    int rows = 1500;
};

/// Autoregressive noise at 2 kHz; speed and force fluctuate by 1 %.
RecordedTexture textureOf (const std::vector<Stretch>& stretches, double offset = 0.0)
{
    Random random { 11 };
    RecordedTexture texture { .most_coefficients = 4 };
    for (const auto& s : stretches)
    {
        double before = 0.0, earlier = 0.0;
        for (int i = 0; i < s.rows; ++i)
        {
            const double y = s.a1 * before + s.a2 * earlier + s.deviation * random.normal();
            earlier = before;
            before = y;
            texture.time.push_back (static_cast<double> (texture.time.size()) / 2000.0);
            texture.acceleration.push_back (offset + y);
            texture.speed.push_back (s.speed * (1.0 + 0.01 * random.normal()));
            texture.force.push_back (s.force * (1.0 + 0.01 * random.normal()));
        }
    }
    return texture;
}

/// A linear sample of 800 N/m that bursts at 6 N and has a toughness of 150 J/m2: the crack then reaches the blade, and grows again at 11.25 mm.
RecordedCut cutUntil (double deepest, std::uint64_t seed)
{
    Random random { seed };
    RecordedCut cut;
    constexpr double stiffness = 800.0, burst = 7.5e-3, cost = 3.0;
    for (int i = 0; i < 400; ++i)
    {
        const double depth = deepest * i / 399.0, crack = depth > burst ? std::max (burst, depth - cost / stiffness) : 0.0;
        cut.depth.push_back (depth);
        cut.force.push_back (stiffness * (depth - crack) + 0.02 * random.normal());
    }
    return cut;
}

RecordedDrag dragged (double constant, bool back_and_forth)
{
    RecordedDrag drag;
    for (int i = 0; i < 600; ++i)
    {
        drag.position.push_back (back_and_forth ? 0.01 * std::sin (0.0314 * i) : 1e-4 * i);
        drag.force.push_back (constant);
    }
    return drag;
}

/// A ring of 100 at 300 Hz that decays with 200 1/s, struck 10 ms after the start.
RecordedRing struckRing()
{
    Random random { 3 };
    RecordedRing ring;
    for (int i = 0; i < 2000; ++i)
    {
        const double t = i * 1e-4, since = t - 0.01;
        ring.time.push_back (t);
        ring.value.push_back ((since < 0.0 ? 0.0 : 100.0 * std::exp (-200.0 * since) * std::sin (full_circle * 300.0 * since)) + 0.02 * random.normal());
    }
    return ring;
}

/// A press without noise that stiffens, with no rows between 2 and 3.2 mm.
RecordedLoop pressWithGap()
{
    Random random { 8 };
    RecordedLoop loop;
    for (int i = 0; i < 400; ++i)
    {
        const double depth = i < 200 ? 1e-5 * (i + 1) : 3.2e-3 + 9e-6 * (i - 199);
        loop.depth.push_back (depth);
        loop.force.push_back (3000.0 * depth * (1.0 + 300.0 * depth) + 0.02 * random.normal());
    }
    return loop;
}
}   // namespace

TEST_CASE ("fit of a texture: models at about the same speed or force lie on a grid", "[fit]")
{
    const auto fit = fitTexture (textureOf ({ { 1.2, -0.8, 0.3, 0.05, 1.0 }, { 0.3, -0.6, 3.0, 0.2, 1.01 }, { 1.0, -0.5, 1.0, 0.051, 2.0 } }));
    REQUIRE (fit);
    REQUIRE (fit->models.size() == 3);
    CHECK (fit->models[0].speed == fit->models[1].speed);
    CHECK (fit->models[0].force == fit->models[2].force);
    CHECK (fit->models[0].force == Approx (1.005).epsilon (0.002));
    CHECK (fit->models[1].force == Approx (2.0).epsilon (0.002));
}

TEST_CASE ("fit of a texture: gravity in the acceleration changes nothing", "[fit]")
{
    const Stretch weak { 1.2, -0.8, 0.02, 0.1, 1.0 };
    const auto plain = fitTexture (textureOf ({ weak })), on_earth = fitTexture (textureOf ({ weak }, 9.81));
    REQUIRE (plain);
    REQUIRE (on_earth);
    REQUIRE (plain->models[0].coefficients.size() == on_earth->models[0].coefficients.size());
    CHECK (on_earth->models[0].variance == Approx (plain->models[0].variance).epsilon (1e-3));
}

TEST_CASE ("fit of a texture: a tone is not a texture", "[fit]")
{
    RecordedTexture tone { .most_coefficients = 8 };
    for (int i = 0; i < 3000; ++i)
    {
        tone.time.push_back (i * 1e-3);
        tone.acceleration.push_back (std::sin (full_circle * 0.1 * i));
    }
    const auto fit = fitTexture (tone);
    REQUIRE (fit);
    CHECK_FALSE (fit->report.is_good);
    CHECK (lacks (fit->report, "spectrum"));
}

TEST_CASE ("fit of a texture: a tone in noise is not a texture, at any frequency, and noise with a sharp resonance is one", "[fit]")
{
    for (const double hertz : { 50.0, 200.0, 333.0, 1201.3, 2400.0 })
        for (const double noise : { 0.001, 0.05, 0.2, 0.5 })
        {
            CAPTURE (hertz, noise);
            Random random { 4 };
            RecordedTexture tone;
            for (int i = 0; i < 6000; ++i)
            {
                tone.time.push_back (i / 5000.0);
                tone.acceleration.push_back (std::sin (full_circle * hertz * i / 5000.0) + noise * random.normal());
            }
            const auto fit = fitTexture (tone);
            if (! fit)   // too sharp for any model
            {
                CHECK (fit.error().id == "fit/silent");
                continue;
            }
            CHECK_FALSE (fit->report.is_good);
            CHECK (lacks (fit->report, "tone"));
        }
    const auto resonant = fitTexture (textureOf ({ { 1.6, -0.98, 1.0, 0.1, 1.0, 6000 } }));
    REQUIRE (resonant);
    CHECK_FALSE (lacks (resonant->report, "tone"));
    CHECK (resonant->report.is_good);
}

TEST_CASE ("fit of a cut: without the part where the crack grows again, the toughness is unknown", "[fit]")
{
    for (const std::uint64_t seed : { 1u, 2u, 3u, 4u, 6u, 10u })
    {
        CAPTURE (seed);
        const auto early = fitBlade (cutUntil (0.0095, seed)), whole = fitBlade (cutUntil (0.02, seed));
        REQUIRE (early);
        REQUIRE (whole);
        const auto& toughness = early->report.at ("toughness");
        CHECK (toughness.low <= 150.0);
        CHECK (toughness.high >= 150.0);
        CHECK_FALSE (early->report.is_good);
        CHECK (lacks (early->report, "before the blade cuts on"));
        CHECK (whole->report.is_good);
        CHECK (whole->toughness == Approx (150.0).epsilon (0.01));
    }
}

TEST_CASE ("fit of a cut: a law that bends has true intervals, too", "[fit]")
{
    test::Draws tally;
    constexpr int cuts = 60;
    for (std::uint64_t seed = 1; seed <= cuts; ++seed)
    {
        Random random { seed };
        RecordedCut cut;
        const double power = 1.5, burst = 5.003e-3, whole = 6.0, left = 0.3;   // m, N, share of the force that is left right after the burst
        double crack = 0.0;
        for (int i = 0; i < 160; ++i)
        {
            const double depth = 8e-5 * i;
            const auto energy = [&] (double d) { return d > 0.0 ? whole * burst / (power + 1.0) * std::pow (d / burst, power + 1.0) : 0.0; };
            const double at_burst = burst * std::pow (left, 1.0 / power), cost = (energy (burst) - energy (at_burst)) / (burst - at_burst);
            const double stretch = burst * std::pow (cost / whole, 1.0 / power);
            if (depth > burst) crack = std::max ({ crack, burst - at_burst, depth - stretch });
            cut.depth.push_back (depth);
            cut.force.push_back (whole * std::pow (std::max (0.0, depth - crack) / burst, power) + 0.1 * random.normal());
        }
        const auto fit = fitBlade (cut);
        REQUIRE (fit);
        for (const auto& v : fit->report.values)
            CHECK_FALSE ((std::isnan (v.low) || std::isnan (v.high)));
        tally.add ("rupture_force", fit->report.at ("rupture_force"), whole);
    }
    tally.check ("rupture_force", 0.03, cuts);
}

TEST_CASE ("fit of a cut: noise whose rows depend on one another seldom bends the law", "[fit]")
{
    int bent = 0;
    constexpr int cuts = 40;
    for (std::uint64_t seed = 1; seed <= cuts; ++seed)
    {
        Random random { seed };
        auto cut = cutUntil (0.02, seed);
        double drift = 0.0;
        for (double& f : cut.force)
            f += drift = 0.95 * drift + 0.03 * random.normal();
        const auto fit = fitBlade (cut);
        REQUIRE (fit);
        if (std::ranges::count (fit->report.values, "power of the law", &FitValue::name) > 0) ++bent;
    }
    CHECK (bent <= cuts / 5);
}

TEST_CASE ("fit of a cut: a constant force gives a law that the node can play, or an error", "[fit]")
{
    RecordedCut cut;
    for (int i = 0; i < 200; ++i)
    {
        cut.depth.push_back (1e-4 * i);
        cut.force.push_back (1.0);
    }
    const auto fit = fitBlade (cut);
    if (! fit) return;
    CHECK (fit->law.b >= 0.3);
    CHECK (fit->law.b <= 6.1);
    CHECK_FALSE (fit->report.is_good);
}

TEST_CASE ("fit of modes: amplitudes are those at the blow, wherever the fitted part begins", "[fit]")
{
    auto ring = struckRing();
    ring.to = 0.06;
    for (const double from : { 0.0, 0.015, 0.03 })
    {
        CAPTURE (from);
        if (from > 0.0) ring.from = from;
        const auto fit = fitModes (ring);
        REQUIRE (fit);
        CHECK (fit->blow == Approx (0.01).margin (1.1e-4));
        REQUIRE (fit->tones.size() == 1);
        CHECK (fit->tones[0].amplitude == Approx (100.0).epsilon (0.03));
    }
    ring.blow = 0.005;
    const auto earlier = fitModes (ring);
    REQUIRE (earlier);
    CHECK (earlier->tones[0].amplitude == Approx (100.0 * std::exp (1.0)).epsilon (0.02));
    for (const double wrong : { 0.04, 100.0, -100.0, std::nan ("") })
    {
        CAPTURE (wrong);
        ring.blow = wrong;
        const auto refused = fitModes (ring);
        REQUIRE_FALSE (refused);
        CHECK (refused.error().id == "fit/blow");
    }
}

TEST_CASE ("fit of modes: an earlier and stronger blow does not count", "[fit]")
{
    auto two = struckRing();
    const auto once = two.value;
    for (std::size_t i = 0; i < once.size(); ++i)
    {
        two.value.push_back (0.5 * once[i]);
        two.time.push_back (0.2 + two.time[i]);
    }
    two.from = 0.215;
    two.to = 0.25;
    const auto fit = fitModes (two);
    REQUIRE (fit);
    CHECK (fit->blow == Approx (0.21).margin (1.1e-4));
    CHECK (fit->tones[0].amplitude == Approx (50.0).epsilon (0.03));
}

TEST_CASE ("fit of modes: a ring without noise gives one mode", "[fit]")
{
    RecordedRing ring { .from = 0.0 };
    for (int i = 0; i < 1000; ++i)
    {
        ring.time.push_back (i * 2e-4);
        ring.value.push_back (std::exp (-20.0 * i * 2e-4) * std::sin (full_circle * 440.0 * i * 2e-4 + 1.0));
    }
    const auto fit = fitModes (ring);
    REQUIRE (fit);
    REQUIRE (fit->tones.size() == 1);
    CHECK (fit->tones[0].frequency == Approx (440.0).epsilon (1e-5));
}

TEST_CASE ("fit of friction: a force that does not depend on the movement is refused", "[fit]")
{
    for (const double constant : { 0.0, 0.5, -2.0 })
    {
        const auto fit = fitFriction (dragged (constant, true));
        REQUIRE_FALSE (fit);
        CHECK (fit.error().id == "fit/no_friction");
    }
}

TEST_CASE ("fit of friction: sliding alone does not say how the contact stretches, even without noise", "[fit]")
{
    const auto fit = fitFriction (dragged (-0.4, false));
    REQUIRE (fit);
    CHECK (fit->mu == Approx (0.4).epsilon (0.01));
    CHECK_FALSE (fit->report.is_good);
}

TEST_CASE ("fit of friction: a force that depends on the speed is told, and one that does not is not", "[fit]")
{
    for (const double viscous : { -0.1, 0.0, 0.1 })   // N at the fastest; the dry friction is 0.5 N
    {
        constexpr int rows = 4000;
        Random random { 7 };
        FrictionFit truth { .adhesion = BristleAdhesion::stick, .mu = 0.5, .d_max = 1e-4 };
        RecordedDrag drag;
        for (int i = 0; i < rows; ++i)
            drag.position.push_back (2e-3 * std::sin (full_circle * 3.0 * i / rows));
        drag.force = truth.forceAlong (drag);
        for (int i = 0; i < rows; ++i)
            drag.force[static_cast<std::size_t> (i)] += 0.005 * random.normal() - viscous * std::cos (full_circle * 3.0 * i / rows);
        const auto fit = fitFriction (drag);
        REQUIRE (fit);
        const auto& report = fit->report;
        INFO (viscous << ": " << report.residual << " of " << report.size);
        CHECK (report.is_good == (viscous == 0.0));
        CHECK (lacks (report, "a force that grows with the speed") == (viscous > 0.0));
        CHECK (lacks (report, "a force that falls with the speed") == (viscous < 0.0));
    }
}

TEST_CASE ("fit of a grating: ridges without noise have the period of the ridges", "[fit]")
{
    RecordedProfile profile;
    for (int i = 0; i < 1000; ++i)
    {
        profile.position.push_back (5e-5 * i);
        profile.height.push_back (1e-5 * std::sin (full_circle * profile.position.back() / 0.002));
    }
    const auto fit = fitGrating (profile);
    REQUIRE (fit);
    CHECK (fit->period == Approx (0.002).epsilon (1e-6));
    CHECK (fit->harmonics.size() == 1);
}

TEST_CASE ("fit of a curve: depths without rows have no bounds", "[fit]")
{
    const auto fit = fitCurve (pressWithGap());
    REQUIRE (fit);
    const auto& inside = fit->report.at ("force at 2.5 mm");
    CHECK (std::isinf (inside.low));
    CHECK (std::isinf (inside.high));
    const auto& above = fit->report.at ("force at 5 mm");
    CHECK (above.low <= 37.5);
    CHECK (above.high >= 37.5);
    CHECK (above.high - above.low < 0.2);
    CHECK_FALSE (fit->report.is_good);
}

TEST_CASE ("fits need evenly spaced rows: a lost row is found, rounded times are accepted", "[fit]")
{
    const auto stepOf = [] (double rate, double digit, int lost) {
        std::vector<double> time;
        for (int i = 0; i < 2000; ++i)
            if (i != lost) time.push_back (digit > 0.0 ? digit * std::round (i / rate / digit) : i / rate);
        return detail::evenStep (time);
    };
    for (const double rate : { 800.0, 1000.0, 3000.0, 10000.0 })
        for (const double digit : { 0.0, 1e-6, 1e-5 })
        {
            CAPTURE (rate, digit);
            REQUIRE (stepOf (rate, digit, -1));
            CHECK (*stepOf (rate, digit, -1) == Approx (1.0 / rate).epsilon (1e-4));
            for (const int lost : { 1, 1000, 1998 })
            {
                const auto found = stepOf (rate, digit, lost);
                REQUIRE_FALSE (found);
                CHECK (found.error().id == "fit/uneven");
                CHECK (found.error().text.find ("row " + std::to_string (lost + 1) + " ") != std::string::npos);
            }
        }
    CHECK (stepOf (3000.0, 1e-4, -1));   // steps of 3 and 4 units
    CHECK (stepOf (700.0, 1e-3, -1));    // of 1 and 2 units
    CHECK_FALSE (stepOf (1000.0, 1e-3, 1000));
}

TEST_CASE ("fits: 95 % intervals are those of Student's t", "[fit]")
{
    const std::pair<double, double> known[] {
        { 1, 12.706 },
        { 2, 4.3027 },
        { 3, 3.1824 },
        { 4, 2.7764 },
        { 5, 2.5706 },
        { 7, 2.3646 },
        { 10, 2.2281 },
        { 30, 2.0423 },
        { 1e6, 1.9600 },
    };
    for (const auto& [freedom, half] : known)
        CHECK (detail::halfWidth95 (freedom) == Approx (half).epsilon (0.005));
}

TEST_CASE ("a share is written in percent, without an exponent", "[fit]")
{
    using Case = std::pair<double, const char*>;
    for (const auto& [share, text] : { Case { 1.0, "100 %" }, Case { 0.027, "2.7 %" }, Case { 0.0996, "10 %" }, Case { 3.456, "346 %" } })
        CHECK (percentText (share) == text);
}
