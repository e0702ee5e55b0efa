// SPDX-License-Identifier: MIT
// Recordings are made from known parameters with noise 20 dB below the signal, 300 for each kind (fewer where they are long), with fixed seeds.

#include "draws.hpp"

#include <support/rounds.hpp>
#include <tactus/fit/blade_fit.hpp>
#include <tactus/fit/curve_fit.hpp>
#include <tactus/fit/friction_fit.hpp>
#include <tactus/fit/grating_fit.hpp>
#include <tactus/fit/modes_fit.hpp>
#include <tactus/fit/texture_fit.hpp>
#include <tactus/kit/cutting.hpp>
#include <tactus/kit/free_impact.hpp>

#include <numbers>

using namespace tactus;
using test::addNoise;
using test::between;
using test::Draws;

namespace
{
const int draws = test::rounds (300);   // fewer under sanitizers
constexpr double full_circle = 2.0 * std::numbers::pi;

struct Stroked
{
    FrictionFit truth;
    RecordedDrag recording;
};

/// Strokes of 0.7 mm under a load that changes.
Stroked stroked (Random& random, BristleAdhesion adhesion, int rows)
{
    Stroked s { .truth { .adhesion = adhesion, .mu = between (random, 0.2, 0.8) }, .recording {} };
    s.truth.d_max = between (random, 0.8e-4, 1.6e-4);
    s.truth.break_away = adhesion == BristleAdhesion::dupont ? between (random, 0.3, 0.7) : 1.0;
    s.truth.reference_load = 1.5;
    double load = 0.0;
    for (int i = 0; i < rows; ++i)
    {
        const double phase = std::fmod (3.0 * i / rows, 1.0);
        s.recording.position.push_back (7e-4 * (1.0 - std::abs (2.0 * phase - 1.0)));
        s.recording.load.push_back (1.5 + 0.3 * std::sin (0.05 * i));
        load += s.recording.load.back() / rows;
    }
    s.recording.force = s.truth.forceAlong (s.recording);
    addNoise (s.recording.force, random);
    s.truth.d_max *= load / s.truth.reference_load;   // the fit refers to the mean load
    s.truth.reference_load = load;
    return s;
}
}   // namespace

TEST_CASE ("fit of friction: intervals contain the truth, and mu, d_max and stiffness are within 2 %", "[fit]")
{
    Draws tally;
    int right = 0;
    for (int seed = 1; seed <= draws; ++seed)
    {
        Random random { static_cast<std::uint64_t> (seed) };
        const auto adhesion = static_cast<BristleAdhesion> (seed % 4);
        const auto s = stroked (random, adhesion, 500);
        const auto fit = fitFriction (s.recording);
        REQUIRE (fit);
        if (fit->adhesion == adhesion) ++right;
        tally.add ("mu", fit->report.at ("mu"), s.truth.mu);
        tally.add ("d_max", fit->report.at ("d_max"), s.truth.d_max);
        tally.add ("stiffness", fit->report.at ("stiffness"), s.truth.stiffness());
    }
    CHECK (right >= 0.96 * draws);   // 500 rows under noise do not always tell dupont from ramp
    tally.check ("mu", 0.02, draws);
    tally.check ("d_max", 0.02, draws);
    tally.check ("stiffness", 0.02, draws);
}

TEST_CASE ("fit of friction: break_away is within 2.5 % if the recording is long", "[fit]")
{
    Draws tally;
    const int longer = test::rounds (24);
    for (int seed = 1; seed <= longer; ++seed)
    {
        Random random { static_cast<std::uint64_t> (seed) };
        const auto s = stroked (random, BristleAdhesion::dupont, 4000);
        const auto fit = fitFriction (s.recording);
        REQUIRE (fit);
        if (fit->adhesion == BristleAdhesion::dupont) tally.add ("break_away", fit->report.at ("break_away"), s.truth.break_away);
    }
    tally.check ("break_away", 0.025, longer);
}

TEST_CASE ("fit of modes: intervals contain the truth, and the strongest mode is within 2 %", "[fit]")
{
    Draws tally;
    int right = 0;
    for (int seed = 1; seed <= draws; ++seed)
    {
        Random random { static_cast<std::uint64_t> (seed) };
        const double frequency[] { between (random, 200, 500), between (random, 700, 1200) };
        const double decay[] { between (random, 20, 50), between (random, 40, 80) }, amplitude[] { 1.0, between (random, 0.5, 0.9) };
        const double phase[] { between (random, 0, 6), between (random, 0, 6) };
        RecordedRing ring { .from = 0.0, .to = 1.0 };
        for (int i = 0; i < 320; ++i)
        {
            const double t = i / 3200.0;
            ring.time.push_back (t);
            ring.value.push_back (0.0);
            for (std::size_t k = 0; k < 2; ++k)
                ring.value.back() += amplitude[k] * std::exp (-decay[k] * t) * std::sin (full_circle * frequency[k] * t + phase[k]);
        }
        addNoise (ring.value, random);
        const auto fit = fitModes (ring);
        REQUIRE (fit);
        if (fit->tones.size() != 2) continue;
        ++right;
        for (std::size_t k = 0; k < 2; ++k)
        {
            const auto name = "mode " + std::to_string (k + 1);
            tally.add (name + " frequency", fit->report.at (name + " frequency"), frequency[k]);
            tally.add (name + " decay", fit->report.at (name + " decay"), decay[k]);
            tally.add (name + " amplitude", fit->report.at (name + " amplitude"), amplitude[k]);
        }
    }
    CHECK (right >= 0.98 * draws);
    for (const std::string name : { "mode 1", "mode 2" })
    {
        tally.check (name + " frequency", 0.001, draws);
        tally.check (name + " decay", 0.025, draws);
        tally.check (name + " amplitude", 0.02, draws);
    }
}

TEST_CASE ("fit of a grating: intervals contain the truth, and period and largest amplitude are within 1 %", "[fit]")
{
    Draws tally;
    for (int seed = 1; seed <= draws; ++seed)
    {
        Random random { static_cast<std::uint64_t> (seed) };
        const double period = between (random, 0.5e-3, 1.5e-3), second = between (random, 0.3e-5, 0.8e-5);
        const double phase[] { between (random, 0, 6), between (random, 0, 6) };
        RecordedProfile profile;
        for (int i = 0; i < 240; ++i)
        {
            const double x = 3e-3 + 2.5e-5 * i;
            profile.position.push_back (x);
            profile.height.push_back (1e-5 * std::sin (full_circle * x / period + phase[0]) + second * std::sin (2.0 * full_circle * x / period + phase[1]));
        }
        addNoise (profile.height, random);
        for (std::size_t i = 0; i < profile.height.size(); ++i)
            profile.height[i] += 0.003 * profile.position[i];   // tilt
        const auto fit = fitGrating (profile);
        REQUIRE (fit);
        if (fit->harmonics.size() < 2) continue;
        tally.add ("period", fit->report.at ("period"), period);
        tally.add ("amplitude 1", fit->report.at ("amplitude 1"), 1e-5);
        tally.add ("amplitude 2", fit->report.at ("amplitude 2"), second);
        if (fit->harmonics.size() == 2) CHECK (std::abs (std::remainder (fit->harmonics[0].phase - phase[0], full_circle)) < 0.2);
    }
    tally.check ("period", 0.001, draws);
    tally.check ("amplitude 1", 0.01, draws);
    tally.check ("amplitude 2", 0.03, draws);
}

TEST_CASE ("fit of a texture: intervals contain the truth in spite of sensor noise", "[fit]")
{
    Draws tally;
    for (int seed = 1; seed <= draws; ++seed)
    {
        Random random { static_cast<std::uint64_t> (seed) };
        const double radius = between (random, 0.7, 0.9), angle = between (random, 0.4, 1.2), a1 = 2.0 * radius * std::cos (angle), a2 = -radius * radius;
        RecordedTexture texture { .most_coefficients = 4 };
        double before = 0.0, earlier = 0.0;
        for (int i = -200; i < 1600; ++i)
        {
            const double y = a1 * before + a2 * earlier + 0.5 * random.normal();
            earlier = before;
            before = y;
            if (i < 0) continue;
            texture.time.push_back (i / 2000.0);
            texture.acceleration.push_back (y);
        }
        addNoise (texture.acceleration, random);
        const auto fit = fitTexture (texture);
        REQUIRE (fit);
        if (fit->models[0].coefficients.size() != 2) continue;
        tally.add ("a1", fit->report.at ("model 1 a1"), a1);
        tally.add ("a2", fit->report.at ("model 1 a2"), a2);
        tally.add ("variance", fit->report.at ("model 1 variance"), 0.25);
    }
    tally.check ("a1", 0.05, draws);
    tally.check ("a2", 0.05, draws);
    tally.check ("variance", 0.08, draws);
}

TEST_CASE ("fit of a texture: five seconds at each speed give the coefficients within 1 %, the variance within 3 %", "[fit]")
{
    Draws tally;
    const int longer = test::rounds (12);
    for (int seed = 1; seed <= longer; ++seed)
    {
        Random random { static_cast<std::uint64_t> (seed) };
        RecordedTexture texture { .most_coefficients = 6 };
        double before = 0.0, earlier = 0.0;
        for (int i = -200; i < 20000; ++i)
        {
            const double y = 1.5 * before - 0.8 * earlier + 0.5 * random.normal();
            earlier = before;
            before = y;
            if (i < 0) continue;
            texture.time.push_back (i / 2000.0);
            texture.acceleration.push_back (y);
            texture.speed.push_back (i < 10000 ? 0.1 : 0.3);
            texture.force.push_back (1.0);
        }
        addNoise (texture.acceleration, random);
        const auto fit = fitTexture (texture);
        REQUIRE (fit);
        REQUIRE (fit->models.size() == 2);   // one per speed
        CHECK (fit->rate == Approx (2000.0));
        CHECK (fit->models[0].speed == Approx (0.1));
        CHECK (fit->models[1].speed == Approx (0.3));
        CHECK (fit->report.is_good);
        for (const std::string name : { "model 1", "model 2" })
        {
            tally.add ("a1", fit->report.at (name + " a1"), 1.5);
            tally.add ("a2", fit->report.at (name + " a2"), -0.8);
            tally.add ("variance", fit->report.at (name + " variance"), 0.25);
        }
    }
    tally.check ("a1", 0.01, 2 * longer);
    tally.check ("a2", 0.01, 2 * longer);
    tally.check ("variance", 0.03, 2 * longer);
}

namespace
{
struct PressedBlade
{
    double stiffness, toughness, rupture;
    RecordedCut recording;
};

PressedBlade pressedBlade (Random& random, double deepest, int rows)
{
    PressedBlade b { .stiffness = between (random, 1500, 2500), .toughness = between (random, 150, 250), .rupture = 0.0, .recording {} };
    b.rupture = 0.02 * b.toughness * between (random, 1.3, 1.8);
    const Law law { .kind = Law::Kind::power, .a = b.stiffness, .b = 1.0 };
    const Cutting cutting { { .cost = 0.02 * b.toughness, .rupture_force = b.rupture }, law, law };
    Cutting::Crack crack;
    double lost = 0.0;
    for (int i = 1; i <= rows; ++i)
    {
        const double depth = deepest * i / rows;
        cutting.press (crack, depth, law, lost);
        b.recording.depth.push_back (depth);
        b.recording.force.push_back (Cutting::answer (crack, depth, law, law).force);
    }
    addNoise (b.recording.force, random);
    return b;
}
}   // namespace

TEST_CASE ("fit of a cut: intervals contain the truth, and stiffness, rupture and toughness are within 2 %", "[fit]")
{
    Draws tally;
    for (int seed = 1; seed <= draws; ++seed)
    {
        Random random { static_cast<std::uint64_t> (seed) };
        const auto b = pressedBlade (random, 0.012, 240);
        const auto fit = fitBlade (b.recording);
        REQUIRE (fit);
        if (! fit->bursts) continue;
        tally.add ("stiffness", fit->report.at ("stiffness"), b.stiffness);
        tally.add ("rupture_force", fit->report.at ("rupture_force"), b.rupture);
        tally.add ("toughness", fit->report.at ("toughness"), b.toughness);
    }
    for (const auto* name : { "stiffness", "rupture_force", "toughness" })
        tally.check (name, 0.02, draws);
}

TEST_CASE ("fit of a cut: a recording that ends early gives wide intervals that contain the truth, and the verdict is poor", "[fit]")
{
    int covered = 0;
    constexpr int cuts = 100;
    for (int seed = 1; seed <= cuts; ++seed)
    {
        Random random { static_cast<std::uint64_t> (seed) };
        const auto b = pressedBlade (random, 0.0014, 150);   // before the burst
        const auto fit = fitBlade (b.recording);
        REQUIRE (fit);
        CHECK_FALSE (fit->bursts);
        CHECK_FALSE (fit->report.is_good);
        const auto &toughness = fit->report.at ("toughness"), &rupture = fit->report.at ("rupture_force");
        CHECK (std::isinf (toughness.high));
        CHECK (std::isinf (rupture.high));
        if (toughness.low <= b.toughness && rupture.low <= 1.3 * b.rupture) ++covered;
    }
    CHECK (covered == cuts);
}

TEST_CASE ("fit of an impact: intervals contain the truth, and the stiffness is within 2 %", "[fit]")
{
    Draws tally;
    for (int seed = 1; seed <= draws; ++seed)
    {
        Random random { static_cast<std::uint64_t> (seed) };
        const double n = between (random, 1.2, 2.0), lambda = between (random, 0.2, 0.8), m = 0.03, v = 0.8, deepest = 1e-3;
        const double k = 0.5 * (n + 1.0) * m * v * v / std::pow (deepest, n + 1.0);
        const auto force = [&] (double d, double rate) noexcept { return d > 0.0 ? std::max (0.0, k * std::pow (d, n) * (1.0 + lambda * rate)) : 0.0; };
        const auto out = freeImpact (force, m, v, 1.0);
        REQUIRE (out.isKnown());
        RecordedLoop loop;
        const double step = out.duration / 160;
        loop.depth = { -v * step, 0.0 };
        loop.force = { 0.0, 0.0 };
        loop.time = { -step, 0.0 };
        double t = 0.0;
        freeImpact (force, m, v, 2.0 * out.duration, step, [&] (const MotionState& x) noexcept {
            loop.time.push_back (t += step);
            loop.depth.push_back (x.d);
            loop.force.push_back (force (x.d, x.v));
        });
        loop.time.push_back (out.duration + step);
        loop.depth.push_back (-out.speed * step);
        loop.force.push_back (0.0);
        const double reached = *std::ranges::max_element (loop.depth);
        addNoise (loop.force, random);
        const auto fit = fitShock (loop);
        REQUIRE (fit);
        tally.add ("stiffness", fit->report.at ("stiffness at the deepest point"), k * std::pow (reached, n - 1.0));
        tally.add ("power", fit->report.at ("power of the law"), n);
        tally.add ("dissipation", fit->report.at ("dissipation"), lambda);
        tally.add ("mass", fit->report.at ("mass"), m);
    }
    tally.check ("stiffness", 0.02, draws);
    tally.check ("power", 0.03, draws);
    tally.check ("dissipation", 0.15, draws);
    tally.check ("mass", 0.02, draws);
}

namespace
{
struct Pushed
{
    double stiffness, loss;
    RecordedLoop recording;
};

/// 4 mm in and out, with a force that is larger on the way in.
Pushed pushed (Random& random)
{
    Pushed p { .stiffness = between (random, 500, 1500), .loss = 0.0, .recording {} };
    p.loss = between (random, 0.1, 0.3);
    constexpr int rows = 400;
    for (int i = 0; i <= 2 * rows; ++i)
    {
        const double depth = 4e-3 * (i <= rows ? i : 2 * rows - i) / rows, way = i <= rows ? 1.0 : -1.0;
        p.recording.depth.push_back (depth);
        p.recording.force.push_back (p.stiffness * depth * (1.0 + 100.0 * depth) * (1.0 + way * p.loss));
    }
    return p;
}

void addPush (Draws& tally, const Pushed& p)
{
    const auto fit = fitCurve (p.recording, 8);
    REQUIRE (fit);
    tally.add ("work", fit->report.at ("work on the way in"), (1.0 + p.loss) * p.stiffness * (0.5 * 16e-6 + 100.0 * 64e-9 / 3.0));
    tally.add ("force", fit->report.at ("force at 2 mm"), p.stiffness * 2e-3 * 1.2);
}
}   // namespace

TEST_CASE ("fit of a curve: intervals contain the truth, and work and force are within 2 %", "[fit]")
{
    Draws tally;
    for (int seed = 1; seed <= draws; ++seed)
    {
        Random random { static_cast<std::uint64_t> (seed) };
        auto p = pushed (random);
        addNoise (p.recording.force, random);
        addPush (tally, p);
    }
    tally.check ("work", 0.02, draws);
    tally.check ("force", 0.03, draws);
}

TEST_CASE ("fits: correlated errors widen the intervals", "[fit]")
{
    Draws tally;
    for (int seed = 1; seed <= draws; ++seed)
    {
        Random random { static_cast<std::uint64_t> (seed) };
        auto p = pushed (random);
        double drift = 0.0;
        for (double& f : p.recording.force)
            f += drift = 0.6 * drift + 0.1 * random.normal();
        addPush (tally, p);
    }
    tally.check ("work", 0.03, draws);
    tally.check ("force", 0.05, draws);
}
