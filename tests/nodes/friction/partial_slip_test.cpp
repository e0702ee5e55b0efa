// SPDX-License-Identifier: MIT
// Friction of a soft tip: Mindlin's force, reversals, changing loads, energy.
#include "work_bench.hpp"

#include <tactus/nodes/friction/elasto_plastic.hpp>
#include <tactus/nodes/friction/partial_slip.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <random>

using tactus::Vec3;
using tactus::nodes::ElastoPlastic;
using tactus::nodes::PartialSlip;

namespace
{
using Bench = tactus::test::WorkBench<PartialSlip>;

constexpr double s_max = 1e-3, most_error = 0.0025217;

/// The force of Cattaneo and Mindlin over mu f_n, for a pull from rest over s_max.
double mindlin (double x) { return x >= 1.0 ? 1.0 : 1.0 - std::pow (1.0 - x, 1.5); }

double sum (double power)
{
    double all = 0.0;
    for (const auto& [bound, weight] : PartialSlip::stack)
        all += weight * std::pow (bound, power);
    return all;
}

struct Dice
{
    explicit Dice (unsigned seed) : random (seed) {}
    double uniform() { return std::uniform_real_distribution<double> {}(random); }
    Vec3 vector() { return { gauss (random), gauss (random), gauss (random) }; }
    std::mt19937 random;
    std::normal_distribution<double> gauss;
};
}   // namespace

TEST_CASE ("partial slip: a pull from rest and each reversal have the force of Mindlin, within 1 %", "[nodes][friction][partial_slip]")
{
    CHECK (sum (1.0) == Approx (1.0).epsilon (1e-15));
    for (const double load : { 0.2, 1.0, 3.0 })
        for (const double turn : { 0.1, 0.5, 0.9, 1.0 })
        {
            PartialSlip node;   // s_max and mu f_n are both in proportion to the load
            const double reach = s_max * load, full = node.params.mu * load;
            const auto pulled = [&] (double x) { return -node.tick ({ .position = { reach * x, 0, 0 }, .normal_force = load }).force.x() / full; };
            double worst = 0.0, worst_back = 0.0, worst_again = 0.0;
            for (int k = 0; k <= 1000; ++k)
                worst = std::max (worst, std::abs (pulled (turn * k / 1000.0) - mindlin (turn * k / 1000.0)));
            const double top = mindlin (turn);
            for (int k = 0; k <= 2000; ++k)   // Masing: twice as large, from the point of reversal
            {
                const double x = turn * (1.0 - k / 1000.0);
                worst_back = std::max (worst_back, std::abs (pulled (x) - (top - 2.0 * mindlin (0.5 * (turn - x)))));
            }
            for (int k = 0; k <= 2000; ++k)
            {
                const double x = turn * (k / 1000.0 - 1.0);
                worst_again = std::max (worst_again, std::abs (pulled (x) - (-top + 2.0 * mindlin (0.5 * (turn + x)))));
            }
            INFO (load << " " << turn);
            CHECK (worst < most_error);
            CHECK (worst > 0.5 * most_error);   // the polygon is felt, so the bound above is not idle
            CHECK (worst_back < 3.0 * most_error);
            CHECK (worst_again < 3.0 * most_error);
            CHECK (pulled (turn) == Approx (top).margin (most_error));   // the loop closes
        }
}

TEST_CASE ("partial slip: small loops close within large ones, and are forgotten with them", "[nodes][friction][partial_slip]")
{
    PartialSlip node, straight;
    const auto at = [] (PartialSlip& n, double x) { return n.tick ({ .position = { s_max * x, 0, 0 } }).force.x(); };
    for (const double x : { 0.0, 0.6, 0.1, 0.4, 0.2, 0.35, 0.25, 0.6, 0.8 })
        at (node, x);
    for (const double x : { 0.0, 0.8 })
        at (straight, x);
    CHECK (at (node, 0.8) == Approx (at (straight, 0.8)).epsilon (1e-12));
}

TEST_CASE ("partial slip: it is six bristles of friction.elasto_plastic in parallel", "[nodes][friction][partial_slip]")
{
    tactus::test::property ("any path, load, normal and mu", [] (unsigned seed) {
        Dice dice (seed);
        PartialSlip node;
        node.params.stiffness = 500.0;
        std::array<ElastoPlastic, 6> bristles;
        for (std::size_t i = 0; i < bristles.size(); ++i)
            bristles[i].params.stiffness = 500.0 * PartialSlip::stack[i].weight;
        Vec3 p = Vec3::Zero();
        for (int k = 0; k < 500; ++k)
        {
            const double mu = dice.uniform(), load = dice.uniform() < 0.02 ? -1.0 : 3.0 * dice.uniform();
            p += dice.vector() * 1e-3 * std::pow (10.0, 4.0 * dice.uniform() - 3.0);
            const Vec3 n = Vec3 { 0, 0, 2 } + (dice.uniform() < 0.1 ? 3.0 : 0.2) * dice.vector();
            node.params.mu = mu;
            const auto out = node.tick ({ .position = p, .normal = n, .normal_force = load });
            Vec3 force = Vec3::Zero();
            double stored = 0.0, lost = 0.0;
            for (std::size_t i = 0; i < bristles.size(); ++i)
            {
                bristles[i].params.mu = mu * PartialSlip::stack[i].weight * PartialSlip::stack[i].bound;
                const auto one = bristles[i].tick ({ .position = p, .normal = n, .normal_force = load });
                force += one.force;
                stored += one.stored_energy;
                lost += one.dissipated_energy;
            }
            RC_ASSERT ((out.force - force).norm() < 1e-11);
            RC_ASSERT (std::abs (out.stored_energy - stored) < 1e-11);
            RC_ASSERT (std::abs (out.dissipated_energy - lost) < 1e-11 * (1.0 + lost));
        }
    });
}

TEST_CASE ("partial slip: under a load that changes, a bristle keeps its stretch up to its bound", "[nodes][friction][partial_slip]")
{
    // Pulled by 0.5 s_max at 1 N, pressed to 2 N, pulled by 0.5 s_max more, and eased to 0.25 N.
    PartialSlip node;
    const auto at = [&] (double x, double load) { return -node.tick ({ .position = { s_max * x, 0, 0 }, .normal_force = load }).force.x() / 0.5; };
    const auto closed = [] (auto stretch) {
        double all = 0.0;
        for (const auto& [bound, weight] : PartialSlip::stack)
            all += weight * stretch (bound);
        return all;
    };
    at (0.0, 1.0);
    const double pulled = at (0.5, 1.0);
    CHECK (pulled == Approx (closed ([] (double b) { return std::min (0.5, b); })).epsilon (1e-12));
    CHECK (at (0.5, 2.0) == pulled);
    CHECK (at (1.0, 2.0) == Approx (closed ([] (double b) { return std::min (std::min (0.5, b) + 0.5, 2.0 * b); })).epsilon (1e-12));
    CHECK (at (1.0, 0.25) == Approx (0.25).epsilon (1e-12));
}

TEST_CASE ("partial slip: a loop loses what the stack has closed for it, near to that of Mindlin", "[nodes][friction][partial_slip][energy]")
{
    // Per cycle of amplitude A: 4 sigma sum w b (A - b) over the bristles that slip; Mindlin's by Masing's rule, 8 (area below f - f A / 2).
    for (const double amplitude : { 0.3, 0.7, 1.0, 2.0 })
        for (const int n : { 40, 4000 })
        {
            Bench bench;
            const auto stroke = [&] (double from, double to) {
                for (int k = 1; k <= n; ++k)
                    bench.tick ({ .position = { s_max * (from + (to - from) * k / n), 0, 0 } });
            };
            bench.tick ({});
            stroke (0.0, amplitude);
            const double before = bench.model(), unit = 0.5 * s_max;   // mu f_n s_max, J
            stroke (amplitude, -amplitude);
            stroke (-amplitude, amplitude);
            double closed = 0.0;
            for (const auto& [bound, weight] : PartialSlip::stack)
                closed += 4.0 * weight * bound * std::max (0.0, amplitude - bound);
            const double x = std::min (amplitude, 1.0), below = x - 0.4 * (1.0 - std::pow (1.0 - x, 2.5)) + (amplitude - x);
            INFO (amplitude << " " << n);
            CHECK (bench.model() - before == Approx (closed * unit).epsilon (1e-9));
            CHECK (closed == Approx (8.0 * (below - 0.5 * mindlin (x) * amplitude)).margin (8.0 * 1.5 * most_error * amplitude));
        }
}

TEST_CASE ("partial slip: over many random ticks it never generates energy, and its heat never falls", "[nodes][friction][partial_slip][energy]")
{
    tactus::test::property ("load, mu, s_max and normal jump at each tick", [] (unsigned seed) {
        Dice dice (seed);
        Bench bench;
        double heat = 0.0, worst = 0.0;
        for (int k = 0; k < 3000; ++k)
        {
            bench.node.params.mu = dice.uniform() < 0.05 ? 0.0 : dice.uniform();
            bench.node.params.s_max = 1e-4 * std::exp (dice.gauss (dice.random));
            const Vec3 dp = dice.vector() * 1e-4 * std::pow (10.0, 4.0 * dice.uniform() - 3.0);
            const double load = dice.uniform() < 0.01 ? -1.0 : 3.0 * dice.uniform();
            const auto& out = bench.tick ({ .position = bench.p + dp, .normal = dice.vector(), .normal_force = load });
            worst = std::min (worst, bench.reached - out.stored_energy);
            RC_ASSERT (out.dissipated_energy >= heat);
            heat = out.dissipated_energy;
        }
        RC_ASSERT (worst >= -1e-12 * heat);
        RC_ASSERT (heat > 0.0);
    });
}

TEST_CASE ("partial slip: no step changes the force by more than the claimed stiffness allows", "[nodes][friction][partial_slip]")
{
    tactus::test::property ("any path", [] (unsigned seed) {
        Dice dice (seed);
        PartialSlip node;
        Vec3 p = Vec3::Zero(), force = node.tick ({}).force;
        for (int k = 0; k < 2000; ++k)
        {
            Vec3 dp = dice.vector() * 1e-4 * std::pow (10.0, 3.0 * dice.uniform() - 2.0);
            dp.z() = 0.0;
            p += dp;
            const Vec3 now = node.tick ({ .position = p }).force;
            RC_ASSERT ((now - force).norm() <= node.claims().stiffness * dp.norm() * (1.0 + 1e-9) + 1e-15);
            force = now;
        }
    });
    PartialSlip node;
    CHECK (node.claims().passive);
    CHECK (PartialSlip::stiffest == Approx (1.438).margin (1e-3));
    CHECK (node.claims().stiffness == Approx (PartialSlip::stiffest * 0.5 / s_max));
    node.tick ({});
    CHECK (node.tick ({ .position = { 1e-9, 0, 0 } }).force.x() == Approx (-1e-9 * node.claims().stiffness));
}

TEST_CASE ("partial slip: it holds still, opens and reports faults as the other friction nodes do", "[nodes][friction][partial_slip]")
{
    PartialSlip node;
    node.tick ({});
    const auto slides = node.tick ({ .position = { 5e-3, 0, 0 } });
    CHECK (slides.state == 2.0);
    CHECK (slides.force.x() == Approx (-0.5));
    CHECK (slides.deflection.x() == Approx (s_max));
    const auto rests = node.tick ({ .position = { 5e-3, 0, 0 } });
    CHECK (rests.state == 1.0);
    CHECK (rests.force == slides.force);
    CHECK (rests.dissipated_energy == slides.dissipated_energy);
    for (int k = 0; k < 1000; ++k)   // a tremor of the load above 1 N
    {
        const auto held = node.tick ({ .position = { 5e-3, 0, 0 }, .normal_force = 1.0 + 0.5 * (k % 7) });
        CHECK (held.force == slides.force);
    }
    const auto open = node.tick ({ .position = { 5e-3, 0, 0 }, .normal_force = 0.0 });
    CHECK (open.state == 0.0);
    CHECK (open.force == Vec3::Zero());
    CHECK (open.dissipated_energy == Approx (slides.dissipated_energy + slides.stored_energy));
    const auto fault = node.tick ({ .position = { NAN, 0, 0 } });
    CHECK (fault.state == -1.0);
    CHECK (fault.force == Vec3::Zero());
    CHECK (fault.dissipated_energy == open.dissipated_energy);
    CHECK (node.tick ({ .position = { 1e-3, 0, 0 } }).force == Vec3::Zero());
}
