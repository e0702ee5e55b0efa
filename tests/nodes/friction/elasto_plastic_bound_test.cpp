// SPDX-License-Identifier: MIT
// Load `bound`: the stiffness is constant while the tool touches, and load, mu and d_max only change the stretch at which the contact
// slides. Also tested: what position noise does to the adhesion functions.
#include <tactus/nodes/friction/elasto_plastic.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using tactus::Vec3;
using tactus::nodes::ElastoPlastic;

namespace
{
using Adhesion = ElastoPlastic::Adhesion;
using Load = ElastoPlastic::Load;
using Params = ElastoPlastic::Params;

constexpr auto all_adhesions = { Adhesion::stick, Adhesion::dupont, Adhesion::ramp, Adhesion::dahl, Adhesion::curve };

/// A hand that leans sideways on a tool of 50 g with 0.2 N, while the contact can hold 0.5 N and its load trembles.
struct Lean
{
    double rate = 4000.0, depth = 0.1, frequency = 10.0;   // Hz; depth and frequency of the trembling: fraction of the load, Hz
    double quantum = 0.0;                                  // of the measured position, in m
    Load load = Load::bound;
    double seconds = 60.0;

    /// How far the contact point walks after the first ten cycles, in m.
    double walk() const
    {
        const double dt = 1.0 / rate, mass = 0.05, damping = 12.0, decay = std::exp (-damping * dt / mass);
        const int settled = static_cast<int> (10.0 / frequency * rate), ticks = static_cast<int> (seconds * rate);
        ElastoPlastic node;
        node.params = { .mu = 0.5, .d_max = 1e-4, .load = load };
        double x = 0.0, v = 0.0, from = 0.0, farthest = 0.0;
        for (int k = 0; k < ticks; ++k)
        {
            const double p = quantum > 0.0 ? quantum * std::floor (x / quantum + 0.5) : x;
            const auto out = node.tick ({ .position = { p, 0, 0 }, .normal_force = 1.0 + depth * std::sin (2.0 * M_PI * frequency * k * dt) });
            const double c = p - out.deflection.x(), f = 0.2 + out.force.x();
            if (k <= settled) from = c;
            farthest = std::max (farthest, std::abs (c - from));
            x += v * mass / damping * (1.0 - decay) + f / damping * (dt - mass / damping * (1.0 - decay));
            v = v * decay + f / damping * (1.0 - decay);
        }
        return farthest;
    }
};

/// Mean drag of a contact of 0.5 N with a d_max of 50 um, at 10 kHz and 2 mm/s. `noise`: rms of the position noise, in m.
double meanDrag (Adhesion adhesion, double noise)
{
    std::mt19937 random (1);
    std::normal_distribution<double> error (0.0, 1.0);
    ElastoPlastic node;
    node.params = { .mu = 0.5, .d_max = 50e-6, .adhesion = adhesion };
    double sum = 0.0;
    const int n = 100'000, first = 10'000;
    for (int k = 0; k < n; ++k)
    {
        const auto out = node.tick ({ .position = { 2e-3 * k / 1e4 + noise * error (random), 0, 0 } });
        if (k >= first) sum -= out.force.x();
    }
    return sum / (n - first);
}
}   // namespace

TEST_CASE ("friction: with load bound, load, mu and d_max move where the contact slides, but never the force of a stretch that it holds", "[nodes][friction]")
{
    for (const auto adhesion : all_adhesions)
    {
        const Params stored { .mu = 0.5, .d_max = 1e-4, .adhesion = adhesion, .reference_load = 2.0 };
        ElastoPlastic node;
        node.params = stored;
        const double sigma = 0.5 * 2.0 / 1e-4;
        double x = 0.0, load = 1.0;
        const auto to = [&] (double next) { return node.tick ({ .position = { x = next, 0, 0 }, .normal_force = load }, stored); };
        const auto slide = [&] {
            ElastoPlastic::Outputs out;
            for (int k = 0; k < 5000; ++k)
                out = to (x + 1e-6);
            return -out.force.x();
        };

        to (0.0);
        CHECK (slide() == Approx (0.5 * 1.0));
        load = 3.0;
        CHECK (to (x).force.x() == Approx (-0.5));
        CHECK (slide() == Approx (0.5 * 3.0));
        node.params.mu = 0.7;
        CHECK (to (x).force.x() == Approx (-1.5));
        CHECK (slide() == Approx (0.7 * 3.0));
        node.params.d_max = 0.5e-4;
        const auto let_go = to (x);
        CHECK (let_go.force.x() == Approx (-0.5 * 0.7 * 3.0));
        CHECK (let_go.state == 2.0);
        CHECK (to (x).state == 1.0);
        CHECK (slide() == Approx (0.5 * 0.7 * 3.0));

        const auto back = to (x - 1e-9);
        CHECK (back.stored_energy == Approx (0.5 * sigma * back.deflection.squaredNorm()));
    }
}

TEST_CASE ("friction: with load bound, stiffness is the stiffness and mu normal_force the bound", "[nodes][friction]")
{
    ElastoPlastic node;
    node.params = { .mu = 0.5, .d_max = 1e-3, .stiffness = 2000.0, .reference_load = 7.0 };
    node.tick ({});
    CHECK (node.tick ({ .position = { 1e-4, 0, 0 } }).force.x() == Approx (-0.2));
    CHECK (node.tick ({ .position = { 1e-2, 0, 0 } }).force.x() == Approx (-0.5));
    CHECK (node.tick ({ .position = { 2e-2, 0, 0 }, .normal_force = 3.0 }).force.x() == Approx (-1.5));

    node.params.stiffness = 9000.0;   // takes effect at the next touch
    CHECK (node.tick ({ .position = { 2e-2, 0, 0 }, .normal_force = 3.0 }).deflection.x() == Approx (1.5 / 2000.0));
    node.tick ({ .normal_force = 0.0 });
    node.tick ({});
    CHECK (node.tick ({ .position = { 2e-5, 0, 0 } }).force.x() == Approx (-9000.0 * 2e-5));
}

TEST_CASE ("friction: with load bound and a mu of 0 nothing drags", "[nodes][friction]")
{
    for (const auto adhesion : all_adhesions)
        for (const double mu : { 0.0, 0.5 })   // mu is 0 from the touch on, or a wire sets it to 0 later
        {
            ElastoPlastic node;
            node.params = { .mu = mu, .adhesion = adhesion };
            const Params stored = node.params;
            node.tick ({}, stored);
            node.tick ({ .position = { 1e-3, 0, 0 } }, stored);
            node.params.mu = 0.0;
            for (const double x : { 1e-3, 2e-3, 2e-3, -1e-3 })
                CHECK (node.tick ({ .position = { x, 0, 0 } }, stored).force.norm() < 1e-20);
        }
}

TEST_CASE ("friction: with load bound, a hand that leans on a trembling load for a minute does not move", "[nodes][friction]")
{
    for (const double depth : { 0.1, 0.3 })
        for (const double frequency : { 1.0, 30.0 })
            CHECK (Lean { .depth = depth, .frequency = frequency, .quantum = 1e-5 }.walk() < 1e-12);
    for (const double rate : { 1000.0, 20'000.0 })
        CHECK (Lean { .rate = rate, .depth = 0.3, .frequency = 10.0, .quantum = 1e-5 }.walk() < 1e-12);

    tactus::test::property ("at any rate, frequency and quantum", [] (unsigned seed) {
        std::mt19937 random (seed);
        std::uniform_real_distribution<double> uniform;
        Lean lean { .seconds = 15.0 };
        lean.rate = 1000.0 * std::pow (20.0, uniform (random));
        lean.depth = uniform (random) < 0.5 ? 0.1 : 0.3;
        lean.frequency = std::pow (30.0, uniform (random));
        lean.quantum = 1e-5 * uniform (random);
        INFO (lean.rate << " Hz, load +-" << lean.depth << " at " << lean.frequency << " Hz, quantum " << lean.quantum);
        RC_ASSERT (lean.walk() < 1e-12);
    });
}

TEST_CASE ("friction: with load passive, the same hand moves, as the header says", "[nodes][friction]")
{
    const double walked = Lean { .load = Load::passive, .seconds = 11.0 }.walk();   // 10 s after the first ten cycles
    CHECK (walked / 10.0 == Approx (81e-6).epsilon (0.05));
}

TEST_CASE ("friction: position noise lowers the drag of functions 2 to 4, as the header says", "[nodes][friction]")
{
    for (const auto adhesion : all_adhesions)
        CHECK (meanDrag (adhesion, 0.0) == Approx (0.5).epsilon (1e-3));
    CHECK (meanDrag (Adhesion::stick, 1e-6) == Approx (0.49).margin (0.005));
    CHECK (meanDrag (Adhesion::dupont, 1e-6) == Approx (0.39).margin (0.005));
    CHECK (meanDrag (Adhesion::ramp, 1e-6) == Approx (0.21).margin (0.005));
    CHECK (meanDrag (Adhesion::dahl, 1e-6) == Approx (0.09).margin (0.005));
}
