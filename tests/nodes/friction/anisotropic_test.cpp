// SPDX-License-Identifier: MIT
// Friction on a grain: drag by direction, equality with friction.elasto_plastic, energy, claims.
#include "work_bench.hpp"

#include <tactus/nodes/friction/anisotropic.hpp>
#include <tactus/nodes/friction/elasto_plastic.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <initializer_list>
#include <random>

using tactus::Vec3;
using tactus::nodes::Anisotropic;
using tactus::nodes::ElastoPlastic;

namespace
{
using Adhesion = Anisotropic::Adhesion;
using Params = Anisotropic::Params;
using Inputs = Anisotropic::Inputs;
using Outputs = Anisotropic::Outputs;

constexpr auto all_adhesions = { Adhesion::stick, Adhesion::dupont, Adhesion::ramp, Adhesion::dahl };

struct Dice
{
    explicit Dice (unsigned seed) : random (seed) {}

    double uniform() { return std::uniform_real_distribution<double> {}(random); }
    Vec3 vector() { return { gauss (random), gauss (random), gauss (random) }; }

    std::mt19937 random;
    std::normal_distribution<double> gauss;
};

/// The coefficient in a direction, by the equation in the header.
double coefficient (const Params& params, double angle)
{
    const double x = std::cos (angle), y = std::sin (angle), line = x < 0.0 ? params.mu_against : params.mu_along;
    return 1.0 / std::hypot (x / line, y / params.mu_across);
}

using Bench = tactus::test::WorkBench<Anisotropic>;

/// A loop over a turning surface with a turning grain, under a changing load.
struct Handling
{
    Params params;
    Vec3 size, turns;
    double tilt = 0.0, press = 0.0, spin = 0.0;

    explicit Handling (unsigned seed)
    {
        Dice dice (seed);
        params = { .mu_along = 0.1 + dice.uniform(),
                   .mu_against = 0.1 + dice.uniform(),
                   .mu_across = 0.1 + dice.uniform(),
                   .d_max = 1e-5 * std::pow (10.0, 2.0 * dice.uniform()),
                   .break_away = dice.uniform(),
                   .adhesion = all_adhesions.begin()[static_cast<int> (4.0 * dice.uniform())] };
        const double reach = params.d_max * std::pow (10.0, 1.2 * dice.uniform() - 0.5);
        for (int i = 0; i < 3; ++i)
        {
            size[i] = reach * (0.2 + dice.uniform());
            turns[i] = std::floor (1.0 + 3.0 * dice.uniform());
        }
        tilt = 0.3 * dice.uniform();
        press = 1.5 * dice.uniform();
        spin = std::floor (3.0 * dice.uniform());
    }

    Inputs at (double s) const
    {
        return { .position = { size.x() * std::sin (turns.x() * s), size.y() * std::cos (turns.y() * s), size.z() * std::sin (turns.z() * s) },
                 .normal = { tilt * std::sin (s), tilt * std::cos (2.0 * s), 1.0 },
                 .grain = { std::cos (spin * s), std::sin (spin * s), 0.2 },
                 .normal_force = 1.0 + press * std::sin (3.0 * s) };
    }

    /// How much the stored and lost energy differs from the work of the hand in two loops of n steps, divided by all work that it gives and
    /// takes; infinite if the hand gets more than it gave.
    double error (int n) const
    {
        Bench bench;
        bench.node.params = params;
        double handled = 0.0;
        for (int k = 0; k <= 2 * n; ++k)
        {
            const double before = bench.trapezoid;
            const auto in = at (2.0 * M_PI * k / n);
            if (k == 0) bench.p = in.position;
            bench.tick (in);
            handled += std::abs (bench.trapezoid - before);
            if (bench.trapezoid < -1e-3 * handled) return tactus::inf;
        }
        return handled > 0.0 ? std::abs (bench.model() - bench.trapezoid) / handled : tactus::inf;
    }
};
}   // namespace

TEST_CASE ("anisotropic: with three equal coefficients it is friction.elasto_plastic, bit for bit", "[nodes][friction][anisotropic]")
{
    tactus::test::property ("any path, load, normal, grain and changes of the params", [] (unsigned seed) {
        Dice dice (seed);
        Anisotropic grained;
        ElastoPlastic plain;
        const auto adhesion = static_cast<int> (4.0 * dice.uniform());
        const double stiffness = dice.uniform() < 0.3 ? 5e3 : 0.0;
        Vec3 p = Vec3::Zero();
        for (int k = 0; k < 500; ++k)
        {
            if (k % 50 == 0)
            {
                const double mu = dice.uniform(), d_max = 1e-5 * std::exp (dice.gauss (dice.random)), ratio = dice.uniform() < 0.5 ? 1.0 : 1.0 + dice.uniform();
                grained.params = { mu, mu, mu, d_max, ratio, 0.6, stiffness, static_cast<Adhesion> (adhesion), 0.8 };
                plain.params = { .mu = mu,
                                 .d_max = d_max,
                                 .static_ratio = ratio,
                                 .break_away = 0.6,
                                 .stiffness = stiffness,
                                 .adhesion = static_cast<ElastoPlastic::Adhesion> (adhesion),
                                 .reference_load = 0.8 };
            }
            p += dice.vector() * 1e-5 * std::pow (10.0, 4.0 * dice.uniform() - 3.0);
            const Vec3 n = Vec3 { 0, 0, 2 } + (dice.uniform() < 0.1 ? 3.0 : 0.2) * dice.vector();
            const double load = dice.uniform() < 0.02 ? -1.0 : 3.0 * dice.uniform();
            const auto a = grained.tick ({ .position = p, .normal = n, .grain = dice.vector(), .normal_force = load });
            const auto b = plain.tick ({ .position = p, .normal = n, .normal_force = load });
            RC_ASSERT (a.force == b.force);
            RC_ASSERT (a.deflection == b.deflection);
            RC_ASSERT (a.stored_energy == b.stored_energy);
            RC_ASSERT (a.dissipated_energy == b.dissipated_energy);
            RC_ASSERT (a.state == b.state);
        }
    });
}

TEST_CASE ("anisotropic: a slide at any angle is held back against its motion, by the ellipse", "[nodes][friction][anisotropic]")
{
    tactus::test::property ("any coefficients, angle, load, step and plane", [] (unsigned seed) {
        Dice dice (seed);
        Anisotropic node;
        node.params.mu_along = 0.05 + dice.uniform();
        node.params.mu_against = 0.05 + dice.uniform();
        node.params.mu_across = 0.05 + dice.uniform();
        node.params.adhesion = dice.uniform() < 0.5 ? Adhesion::stick : Adhesion::dahl;
        const double angle = 2.0 * M_PI * dice.uniform(), load = 0.1 + 2.0 * dice.uniform(), step = 1e-5 * std::pow (10.0, 2.0 * dice.uniform());
        const Vec3 n = dice.vector().normalized(), grain = n.cross (dice.vector()).normalized(),
                   way = std::cos (angle) * grain + std::sin (angle) * n.cross (grain);
        Outputs out;
        for (double s = 0.0; s < 4e-2; s += step)
            out = node.tick ({ .position = s * way, .normal = n, .grain = 3.0 * grain + dice.vector().dot (n) * n, .normal_force = load });
        const double drag = load * coefficient (node.params, angle);
        RC_ASSERT (out.state == 2.0);
        RC_ASSERT ((out.force + drag * way).norm() < 1e-9 * drag);
    });

    // The three coefficients themselves, on the flat surface and with the grain along x.
    const auto drag = [] (const Vec3& way) {
        Anisotropic node;
        Outputs out;
        for (int k = 0; k < 100; ++k)
            out = node.tick ({ .position = 1e-5 * k * way });
        return out.force.norm();
    };
    CHECK (drag ({ 1, 0, 0 }) == Approx (0.3));
    CHECK (drag ({ -1, 0, 0 }) == Approx (0.6));
    CHECK (drag ({ 0, 1, 0 }) == Approx (0.4));
    CHECK (drag ({ 0, -1, 0 }) == Approx (0.4));
}

TEST_CASE ("anisotropic: over many random ticks it never generates energy, and its heat never falls", "[nodes][friction][anisotropic][energy]")
{
    tactus::test::property ("load, coefficients, d_max, normal and grain jump at each tick", [] (unsigned seed) {
        Dice dice (seed);
        Bench bench;
        auto& params = bench.node.params;
        params.adhesion = all_adhesions.begin()[seed % 4];
        params.stiffness = seed % 3 == 0 ? 2e4 : 0.0;
        const bool turns = dice.uniform() < 0.5;   // a turn takes the held force to another plane, so its work is then not compared
        const Vec3 n = dice.vector();
        double sigma = 0.0, leak = 0.0, heat = 0.0, worst_reached = 0.0, worst_held = 0.0;
        for (int k = 0; k < 3000; ++k)
        {
            params.mu_along = dice.uniform() < 0.05 ? 0.0 : dice.uniform();
            params.mu_against = dice.uniform();
            params.mu_across = dice.uniform() < 0.05 ? 0.0 : dice.uniform();
            params.d_max = 1e-5 * std::exp (dice.gauss (dice.random));
            params.static_ratio = dice.uniform() < 0.5 ? 1.0 : 1.0 + dice.uniform();
            const Vec3 dp = dice.vector() * 1e-5 * std::pow (10.0, 4.0 * dice.uniform() - 3.0);
            const double load = dice.uniform() < 0.01 ? -1.0 : 3.0 * dice.uniform(), before = sigma;
            if (load <= 0.0)
                sigma = 0.0;
            else if (sigma == 0.0)
                sigma = params.stiffness > 0.0 ? params.stiffness : std::max ({ params.mu_along, params.mu_against, params.mu_across }) / params.d_max;
            const auto& out = bench.tick ({ .position = bench.p + dp, .normal = turns ? dice.vector() : n, .grain = dice.vector(), .normal_force = load });
            leak += 0.5 * (params.adhesion == Adhesion::stick ? 1.0 : 2.0) * std::max (sigma, before) * dp.squaredNorm();
            worst_reached = std::min (worst_reached, bench.reached - out.stored_energy);
            worst_held = std::min (worst_held, bench.held + leak - out.stored_energy);
            RC_ASSERT (out.dissipated_energy >= heat * (1.0 - 1e-15));
            heat = out.dissipated_energy;
        }
        RC_ASSERT (worst_reached >= -1e-12 * heat);
        RC_ASSERT (turns || worst_held >= -1e-12 * heat);
        RC_ASSERT (heat > 0.0);
    });
}

TEST_CASE ("anisotropic: on any closed path the work of the hand is the stored plus the lost energy", "[nodes][friction][anisotropic][energy]")
{
    tactus::test::property ("loops of a turning grain, pressed and eased, over a turning surface", [] (unsigned seed) {
        // The error is of first order in the step over the stretch at which the contact slides. If it is above 1 %, the steps are too long.
        const Handling handling { seed };
        const double error = handling.error (8000);
        RC_ASSERT (error < 1.0);
        RC_ASSERT (error <= 1e-2 || handling.error (80'000) <= 1e-2);
    });
}

TEST_CASE ("anisotropic: a stroke to and fro costs what both directions cost", "[nodes][friction][anisotropic][energy]")
{
    // With the grain, the contact slides after 2 * 0.5e-4 m of stretch is turned round, against it after 1e-4 m.
    for (const int n : { 7, 100, 10'000 })
    {
        Bench bench;
        bench.node.params = { .mu_along = 0.3, .mu_against = 0.6, .mu_across = 0.4, .d_max = 1e-4, .reference_load = 1.0 };
        const double reach = 1e-3, turn = 1.5e-4;   // m; the contact gives by 0.5e-4 + 1e-4 before it slides back
        double before = 0.0;
        for (int stroke = 0; stroke < 4; ++stroke)
        {
            const double from = stroke % 2 == 0 ? 0.0 : reach, to = reach - from;
            if (stroke == 2) before = bench.model();
            for (int k = 1; k <= n; ++k)
                bench.tick ({ .position = { from + (to - from) * k / n, 0, 0 } });
        }
        INFO (n);
        CHECK (bench.model() - before == Approx ((0.3 + 0.6) * (reach - turn)).epsilon (1e-9));
    }
}

TEST_CASE ("anisotropic: a tool that leans on it in any direction does not walk, however the load trembles", "[nodes][friction][anisotropic]")
{
    tactus::test::property ("a stretch below the bound stays", [] (unsigned seed) {
        Dice dice (seed);
        Anisotropic node;
        const double angle = 2.0 * M_PI * dice.uniform();
        node.tick ({});
        const double stretch = 0.6 * coefficient (node.params, angle) / 0.6 * node.params.d_max;
        const Vec3 p = stretch * Vec3 { std::cos (angle), std::sin (angle), 0.0 };
        const auto held = node.tick ({ .position = p });
        for (int k = 0; k < 1000; ++k)
        {
            const auto out = node.tick ({ .position = p, .normal_force = 0.7 + dice.uniform() });
            RC_ASSERT (out.force == held.force);
            RC_ASSERT (out.dissipated_energy == 0.0);
            RC_ASSERT (out.state == 1.0);
        }
    });
}

TEST_CASE ("anisotropic: a stretch that the grain no longer holds slips at once, even at rest", "[nodes][friction][anisotropic]")
{
    for (const auto adhesion : { Adhesion::stick, Adhesion::dahl })
    {
        Anisotropic node;
        node.params.adhesion = adhesion;
        Outputs out;
        for (int k = 0; k <= 500; ++k)
            out = node.tick ({ .position = { -1e-5 * k, 0, 0 } });
        CHECK (out.force.x() == Approx (0.6));   // against the grain
        const auto turned = node.tick ({ .position = { -5e-3, 0, 0 }, .grain = { -2, 0, 0 } });
        CHECK (turned.force.x() == Approx (0.3));
        CHECK (turned.state == 2.0);
        const double sigma = 0.6 / node.params.d_max;
        CHECK (turned.dissipated_energy - out.dissipated_energy == Approx (0.5 / sigma * (0.6 * 0.6 - 0.3 * 0.3)));
    }
}

TEST_CASE ("anisotropic: a grain along the normal, or of length 0, drags as across in every direction", "[nodes][friction][anisotropic]")
{
    for (const Vec3& grain : { Vec3 { 0, 0, 5 }, Vec3 { 0, 0, 0 } })
        for (int i = 0; i < 12; ++i)
        {
            const double angle = M_PI / 6.0 * i;
            Anisotropic node;
            Outputs out;
            for (int k = 0; k < 100; ++k)
                out = node.tick ({ .position = 1e-5 * k * Vec3 { std::cos (angle), std::sin (angle), 0.0 }, .grain = grain });
            CHECK (out.force.norm() == Approx (0.4));
        }
}

TEST_CASE ("anisotropic: no step changes the force by more than the claimed stiffness allows", "[nodes][friction][anisotropic]")
{
    tactus::test::property ("any coefficients and path", [] (unsigned seed) {
        Dice dice (seed);
        Anisotropic node;
        node.params = { .mu_along = 0.1 + dice.uniform(), .mu_against = 0.1 + dice.uniform(), .mu_across = 0.1 + dice.uniform() };
        node.params.adhesion = all_adhesions.begin()[seed % 4];
        const double claimed = node.claims().stiffness;
        Vec3 p = Vec3::Zero(), force = node.tick ({}).force;
        for (int k = 0; k < 2000; ++k)
        {
            Vec3 dp = dice.vector() * 1e-4 * std::pow (10.0, 3.0 * dice.uniform() - 3.0);
            dp.z() = 0.0;
            p += dp;
            const Vec3 now = node.tick ({ .position = p }).force;
            RC_ASSERT ((now - force).norm() <= claimed * dp.norm() * (1.0 + 1e-9) + 1e-15);
            force = now;
        }
    });

    // The bound is reached: sideways on a slide, where the ellipse turns most.
    Anisotropic node;
    node.params = { .mu_along = 0.1, .mu_against = 0.1, .mu_across = 0.4 };
    CHECK (node.claims().passive);
    CHECK (node.claims().stiffness == Approx (0.5 * (4.0 + 0.25) * 0.4 / 1e-4));
    double steepest = 0.0;
    for (int i = 0; i < 900; ++i)
    {
        const double angle = M_PI / 1800.0 * i;
        const Vec3 way { std::cos (angle), std::sin (angle), 0.0 }, side { way.y(), -way.x(), 0.0 };   // towards the short axis, so that it slips
        Anisotropic one;
        one.params = node.params;
        one.tick ({});
        const Vec3 before = one.tick ({ .position = 1e-2 * way }).force;
        const Vec3 after = one.tick ({ .position = 1e-2 * way + 1e-9 * side }).force;
        steepest = std::max (steepest, (after - before).norm() / 1e-9);
    }
    CHECK (steepest == Approx (node.claims().stiffness).epsilon (1e-3));

    node.params.adhesion = Adhesion::dahl;
    CHECK (node.claims().stiffness == Approx (5.0 * 0.4 / 1e-4));
    node.params = { .mu_along = 0.2, .mu_against = 0.2, .mu_across = 0.2, .stiffness = 300.0 };
    CHECK (node.claims().stiffness == 300.0);
}
