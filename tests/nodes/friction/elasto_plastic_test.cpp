// SPDX-License-Identifier: MIT
#include <tactus/nodes/friction/elasto_plastic.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <cstring>
#include <initializer_list>
#include <random>
#include <vector>

using tactus::Vec3;
using tactus::nodes::ElastoPlastic;

namespace
{
using Adhesion = ElastoPlastic::Adhesion;
using Integrator = ElastoPlastic::Integrator;
using Load = ElastoPlastic::Load;
using Params = ElastoPlastic::Params;
using Outputs = ElastoPlastic::Outputs;

constexpr auto all_adhesions = { Adhesion::stick, Adhesion::dupont, Adhesion::ramp, Adhesion::dahl, Adhesion::curve };
constexpr auto both_integrators = { Integrator::exponential, Integrator::euler };
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A node dragged along x.
struct Drag
{
    explicit Drag (const Params& params, double at = 0.0) : p (at)
    {
        node.params = params;
        out = node.tick ({ .position = { p, 0, 0 } });
    }

    const Outputs& by (double dp, double normal_force = 1.0) { return to (p + dp, normal_force); }

    const Outputs& to (double x, double normal_force = 1.0)
    {
        const Outputs before = out;
        out = node.tick ({ .position = { x, 0, 0 }, .normal_force = normal_force });
        work -= 0.5 * (before.force.x() + out.force.x()) * (x - p);
        p = x;
        return out;
    }

    /// A straight stroke in n equal steps.
    const Outputs& stroke (double to_x, int n, double normal_force = 1.0)
    {
        const double from = p;
        for (int k = 1; k <= n; ++k)
            to (k == n ? to_x : from + (to_x - from) * k / n, normal_force);
        return out;
    }

    double d() const { return out.deflection.x(); }

    ElastoPlastic node;
    Outputs out;
    double p, work = 0.0;   // p in m; work of the hand in J, by the trapezoid rule
};

bool sameBits (const Outputs& a, const Outputs& b)
{
    const auto same = [] (const auto& u, const auto& v) { return std::memcmp (&u, &v, sizeof u) == 0; };
    return same (a.force, b.force) && same (a.deflection, b.deflection) && same (a.stored_energy, b.stored_energy)
           && same (a.dissipated_energy, b.dissipated_energy);
}
}   // namespace

TEST_CASE ("friction: a small pull is a spring of stiffness mu f_n / d_max, or mu reference_load / d_max with load bound", "[nodes][friction]")
{
    for (const auto load : { Load::bound, Load::scale, Load::passive })
    {
        Drag drag ({ .mu = 0.5, .d_max = 1e-3, .load = load, .reference_load = 3.0 });
        drag.to (0.0, 2.0);
        const auto out = drag.by (0.4e-3, 2.0);

        const double sigma = 500.0 * (load == Load::bound ? 3.0 : 2.0);
        CHECK (out.force.x() == Approx (-sigma * 0.4e-3));
        CHECK (out.deflection.x() == Approx (0.4e-3));
        CHECK (out.stored_energy == Approx (0.5 * sigma * 0.4e-3 * 0.4e-3));
        CHECK (out.dissipated_energy == 0.0);
        CHECK (out.state == 1.0);
    }
}

TEST_CASE ("friction: sliding is mu f_n against the motion, in any direction, with every adhesion", "[nodes][friction]")
{
    for (const auto adhesion : all_adhesions)
        for (const auto integrator : both_integrators)
        {
            ElastoPlastic node;
            node.params = { .mu = 0.3, .d_max = 1e-5, .adhesion = adhesion, .integrator = integrator };
            node.tick ({});
            Outputs out;
            for (int k = 1; k <= 20'000; ++k)
                out = node.tick ({ .position = Vec3 { 3, 4, 0 } * 1e-8 * k, .normal_force = 5.0 });

            INFO (int (adhesion) << " " << int (integrator));
            CHECK ((out.force - Vec3 { -0.9, -1.2, 0 }).norm() < (integrator == Integrator::euler && adhesion != Adhesion::stick ? 1.5 * 0.006 : 1e-5));
            CHECK (out.state == 2.0);
        }
}

TEST_CASE ("friction: every touch starts without a force, wherever it is", "[nodes][friction]")
{
    for (const auto adhesion : all_adhesions)
    {
        Drag drag ({ .adhesion = adhesion }, 0.08);
        CHECK (drag.out.force.isZero (0.0));
        drag.by (5e-5);
        CHECK (drag.out.force.x() < 0.0);

        CHECK (drag.by (1e-3, 0.0).state == 0.0);
        CHECK (drag.out.force.isZero (0.0));
        CHECK (drag.by (1e-3, -1.0).state == 0.0);
        CHECK (drag.by (1e-3, 1.0).state == 1.0);
        CHECK (drag.out.force.isZero (0.0));
    }
}

TEST_CASE ("friction: stiffness keeps the spring whatever the load, bounded by d_max alone", "[nodes][friction]")
{
    for (const auto adhesion : { Adhesion::stick, Adhesion::dahl, Adhesion::dupont, Adhesion::ramp })
    {
        Drag drag ({ .mu = 7.0, .d_max = 1e-4, .stiffness = 2000.0, .adhesion = adhesion, .load = Load::scale });
        drag.stroke (1e-2, 1000, 0.01);
        CHECK (drag.out.force.x() == Approx (-0.2).epsilon (1e-6));
        CHECK (drag.to (drag.p, 1000.0).force.x() == Approx (-0.2).epsilon (1e-6));

        drag.node.params.d_max = 0.5e-4;
        CHECK (drag.by (0.0).force.x() == Approx (-0.1).epsilon (1e-6));
        CHECK (drag.out.state == 2.0);
        CHECK (drag.by (0.0).state == 1.0);
        CHECK (drag.out.force.x() == Approx (-0.1).epsilon (1e-6));
    }
}

TEST_CASE ("friction: dahl creeps by the formula under a load far below break-away, and function 1 does not creep", "[nodes][friction]")
{
    const double d_max = 1e-4, lo = 0.1 * d_max, hi = 0.5 * d_max;
    const auto creepPerCycle = [&] (Adhesion adhesion) {
        Drag drag ({ .d_max = d_max, .adhesion = adhesion });
        const double step = 1e-4 * d_max;
        double first = 0.0, last = 0.0;
        for (int cycle = 0; cycle < 20; ++cycle)
        {
            while (drag.d() < hi)
                drag.by (step);
            while (drag.d() > lo)
                drag.by (-step);
            (cycle == 0 ? first : last) = drag.p - (drag.d() - lo);
        }
        return (last - first) / 19;
    };

    const double formula = d_max * std::log ((1.0 - 0.01) / (1.0 - 0.25));
    CHECK (formula == Approx (0.2776 * d_max).epsilon (1e-3));
    CHECK (creepPerCycle (Adhesion::dahl) == Approx (formula).epsilon (2e-3));
    CHECK (creepPerCycle (Adhesion::ramp) > 0.02 * d_max);
    CHECK (creepPerCycle (Adhesion::stick) == Approx (0.0).margin (1e-12 * d_max));
    CHECK (creepPerCycle (Adhesion::dupont) == Approx (0.0).margin (1e-12 * d_max));
}

TEST_CASE ("friction: tremor of the hand wears down dahl's force, but not the force of function 1", "[nodes][friction]")
{
    const double d_max = 1e-5;
    std::mt19937 random (1);
    std::uniform_real_distribution<double> tremor (-0.15 * d_max, 0.15 * d_max);
    for (const auto adhesion : { Adhesion::stick, Adhesion::dahl })
    {
        Drag drag ({ .d_max = d_max, .adhesion = adhesion });
        if (adhesion == Adhesion::stick)
            drag.stroke (0.8 * d_max, 10);
        else
            drag.stroke (-std::log (1.0 - 0.8) * d_max, 10);
        CHECK (drag.d() == Approx (0.8 * d_max));

        const double rest = drag.p;
        double sum = 0.0;
        for (int k = 0; k < 20'000; ++k)
            drag.to (rest + tremor (random));
        for (int k = 0; k < 20'000; ++k)
            sum += drag.to (rest + tremor (random)).deflection.x();

        const double mean = sum / 20'000 / d_max;
        if (adhesion == Adhesion::stick)
            CHECK (mean == Approx (0.8).margin (2e-3));
        else
            CHECK (std::abs (mean) < 2e-2);
    }
}

TEST_CASE ("friction: a tool that leans and trembles for a minute stays where it is with function 1, not with dahl", "[nodes][friction]")
{
    // A tool of 50 g. The hand pushes it sideways with half of the break-away force, and a tremor of a tenth of that force at 8 Hz.
    const auto drift = [] (Adhesion adhesion) {
        const double dt = 1.0 / 4000.0, mass = 0.05, damping = 2.0, push = 0.2;
        ElastoPlastic node;
        node.params = { .mu = 0.4, .d_max = 1e-4, .adhesion = adhesion };
        double x = 0.0, v = 0.0, early = 0.0;
        for (int k = 0; k <= 61 * 4000; ++k)
        {
            const double f = node.tick ({ .position = { x, 0, 0 } }).force.x() + push + 0.04 * std::sin (2.0 * M_PI * 8.0 * k * dt);
            v += dt * (f - damping * v) / mass;
            x += dt * v;
            if (k == 4000) early = x;
        }
        return x - early;
    };

    CHECK (drift (Adhesion::stick) == Approx (0.0).margin (1e-8));
    CHECK (drift (Adhesion::dupont) == Approx (0.0).margin (1e-8));
    CHECK (drift (Adhesion::dahl) > 1e-3);
}

TEST_CASE ("friction: the exponential form is dahl's curve whatever the sampling", "[nodes][friction]")
{
    const double d_max = 1e-5;
    for (const int n : { 1, 2, 7, 100, 10'000 })
    {
        Drag drag ({ .d_max = d_max, .adhesion = Adhesion::dahl });
        const double up = 3.0, down = 1.7;
        const double top = 1.0 - std::exp (-up), bottom = -1.0 + (top + 1.0) * std::exp (-down);
        INFO (n);
        CHECK (drag.stroke (up * d_max, n).deflection.x() / d_max == Approx (top).margin (1e-12));
        CHECK (drag.stroke ((up - down) * d_max, n).deflection.x() / d_max == Approx (bottom).margin (1e-12));
        CHECK (drag.out.stored_energy + drag.out.dissipated_energy
               == Approx (0.4 * d_max * (up - top + (bottom - top) + down)).epsilon (1e-11));
    }
}

TEST_CASE ("friction: the force depends on the path, not on the sampling rate", "[nodes][friction]")
{
    const double d_max = 1e-4;
    for (const double ratio : { 1.0, 1.3 })
    {
        Drag slow ({ .d_max = d_max }), fast ({ .d_max = d_max });
        for (const double corner : { 0.6, 2.4, 2.1, -3.0, 4.0, 3.9 })
        {
            slow.stroke (corner * d_max * ratio, 5);
            fast.stroke (corner * d_max * ratio, 500);
            CHECK (slow.d() / d_max == Approx (fast.d() / d_max).margin (1e-10));
            CHECK (slow.out.dissipated_energy == Approx (fast.out.dissipated_energy).margin (1e-14));
        }
    }
}

TEST_CASE ("friction: a reversal in one sample does not flip the force", "[nodes][friction]")
{
    // From -0.95 d_max by 1.9 d_max: eq. (4) without its clamp gives -0.855 d_max, the exact solution 0.708 d_max.
    const double d_max = 1e-5;
    for (const auto integrator : both_integrators)
    {
        Drag drag ({ .d_max = d_max, .adhesion = Adhesion::dahl, .integrator = integrator });
        drag.stroke (std::log (1.0 - 0.95) * d_max, 100'000);
        REQUIRE (drag.d() / d_max == Approx (-0.95).epsilon (1e-4));

        drag.by (1.9 * d_max);
        CHECK (drag.d() >= 0.0);
        if (integrator == Integrator::exponential) CHECK (drag.d() / d_max == Approx (0.708).margin (1e-3));
    }
}

TEST_CASE ("friction: steady sliding is steady in force and state", "[nodes][friction]")
{
    for (const auto adhesion : all_adhesions)
        for (const auto integrator : both_integrators)
            for (const double step : { 0.0731, 0.5, 1.0, 3.7 })
            {
                const double d_max = 1e-5;
                Drag drag ({ .d_max = d_max, .adhesion = adhesion, .integrator = integrator }, 0.05);
                for (int k = 0; k < 2000; ++k)
                    drag.by (step * d_max);

                const double force = drag.out.force.x();
                for (int k = 0; k < 2000; ++k)
                {
                    drag.by (step * d_max);
                    if (drag.out.state == 2.0 && std::abs (drag.out.force.x() - force) <= 1e-10) continue;
                    FAIL_CHECK ("adhesion " << int (adhesion) << " integrator " << int (integrator) << " step " << step
                                            << ": state " << drag.out.state << ", force " << force << " to " << drag.out.force.x());
                }
            }
}

TEST_CASE ("friction: a repeated sample changes no bit and counts as rest", "[nodes][friction]")
{
    std::mt19937 random (2);
    std::normal_distribution<double> normal;
    for (const auto adhesion : all_adhesions)
        for (const auto integrator : both_integrators)
            for (const auto load : { Load::bound, Load::scale, Load::passive })
            {
                ElastoPlastic node;
                node.params = { .d_max = 1e-5, .static_ratio = 1.2, .adhesion = adhesion, .integrator = integrator, .load = load };
                Vec3 p { 0.03, -0.07, 0.01 };
                int moving = 0;
                for (int k = 0; k < 2000; ++k)
                {
                    p += 1e-5 * Vec3 { normal (random), normal (random), normal (random) };
                    const Vec3 tilted { 0.2 * normal (random), 0.2 * normal (random), 1.0 };
                    const ElastoPlastic::Inputs in { .position = p, .normal = tilted, .normal_force = 1.0 + 0.5 * std::sin (0.1 * k) };
                    const auto first = node.tick (in);
                    if (first.state == 2.0) ++moving;
                    for (int repeat = 0; repeat < 3; ++repeat)
                    {
                        const auto again = node.tick (in);
                        REQUIRE (sameBits (first, again));
                        REQUIRE (again.state == 1.0);
                    }
                }
                CHECK (moving > 200);
            }
}

TEST_CASE ("friction: a fault opens the contact and keeps only the dissipated energy", "[nodes][friction]")
{
    const std::vector<ElastoPlastic::Inputs> faults {
        { .position = { not_a_number, 0, 0 } },
        { .position = { 0, 0, tactus::inf } },
        { .normal = { 0, not_a_number, 1 } },
        { .normal = { 0, 0, 0 } },
        { .normal_force = not_a_number },
        { .normal_force = tactus::inf },
        { .position = { 1e300, 0, 0 } },
        { .position = { -1e300, 1e300, 1e300 } },
        { .normal_force = 1.7e308 },
    };
    for (const auto adhesion : all_adhesions)
        for (const auto& fault : faults)
        {
            Drag drag ({ .mu = 2.0, .adhesion = adhesion });
            drag.stroke (1e-3, 100);
            const double heat = drag.out.dissipated_energy;
            REQUIRE (heat > 0.0);

            const auto out = drag.node.tick (fault);
            CHECK (out.state == -1.0);
            CHECK (out.force.isZero (0.0));
            CHECK (out.deflection.isZero (0.0));
            CHECK (out.stored_energy == 0.0);
            CHECK (out.dissipated_energy == heat);

            CHECK (drag.by (1e-3).force.isZero (0.0));
            CHECK (drag.out.state == 1.0);
            CHECK (drag.out.dissipated_energy == heat);
            CHECK (drag.by (2e-5).force.x() < 0.0);
        }
}

TEST_CASE ("friction: the normal need not be of length 1, and the force lies in the surface", "[nodes][friction]")
{
    for (const double length : { 1e-200, 0.01, 1.0, 17.0, 1e200, 1e308 })
    {
        ElastoPlastic unit, scaled;
        const Vec3 n = Vec3 { 1, 2, 2 } / 3.0;
        for (int k = 0; k < 50; ++k)
        {
            const Vec3 p { 1e-5 * k, -2e-5 * k, 3e-5 * std::sin (k) };
            const auto a = unit.tick ({ .position = p, .normal = n });
            const auto b = scaled.tick ({ .position = p, .normal = n * length });
            CHECK ((a.force - b.force).norm() < 1e-12);
            CHECK (std::abs (a.force.dot (n)) < 1e-12);
        }
    }
}

TEST_CASE ("friction: motion along the normal moves nothing, and a turning normal takes the contact along", "[nodes][friction]")
{
    ElastoPlastic node;
    node.tick ({});
    const auto pulled = node.tick ({ .position = { 4e-5, 0, 0 } });
    CHECK (node.tick ({ .position = { 4e-5, 0, 5.0 } }).force == pulled.force);

    const auto turned = node.tick ({ .position = { 4e-5, 0, 5.0 }, .normal = { 1, 0, 1 } });
    CHECK ((turned.deflection - 4e-5 * Vec3 { std::sqrt (0.5), 0, -std::sqrt (0.5) }).norm() < 1e-18);
    CHECK (turned.dissipated_energy == 0.0);
    CHECK (turned.stored_energy == pulled.stored_energy);
}

TEST_CASE ("friction: a choice that changes in contact takes effect when the contact has opened", "[nodes][friction]")
{
    Drag a ({}), b ({});
    a.by (3e-5);
    b.by (3e-5);
    a.node.params.adhesion = Adhesion::dahl;
    a.node.params.integrator = Integrator::euler;
    a.node.params.load = Load::scale;
    for (int k = 0; k < 100; ++k)
        CHECK (sameBits (a.by (1e-5 * std::sin (k), 1.0 + 0.01 * k), b.by (1e-5 * std::sin (k), 1.0 + 0.01 * k)));

    a.by (0, 0);
    b.by (0, 0);
    a.by (0);
    b.by (0);
    CHECK (a.by (5e-5).force.x() != b.by (5e-5).force.x());
}

TEST_CASE ("friction: a user curve does the same as the built-in function", "[nodes][friction]")
{
    Drag ramp ({ .adhesion = Adhesion::ramp }), own ({ .adhesion = Adhesion::curve });
    own.node.settings.adhesion_curve = { { 0, 1 }, { 0, 1 } };
    for (int k = 0; k < 200; ++k)
    {
        const double dp = 3e-5 * std::sin (0.3 * k);
        CHECK (ramp.by (dp).force.x() == Approx (own.by (dp).force.x()).margin (1e-12));
    }
    CHECK (own.node.problem().empty());
    own.node.settings.adhesion_curve = { { 0, 1 }, { 0, 2 } };
    CHECK_FALSE (own.node.problem().empty());
    own.node.settings.adhesion_curve = {};
    CHECK_FALSE (own.node.problem().empty());
}

TEST_CASE ("friction: a new instance continues without a step in force", "[nodes][friction]")
{
    Drag drag ({ .adhesion = Adhesion::dahl });
    drag.stroke (2e-4, 10);
    ElastoPlastic next;
    next.params = drag.node.params;
    next.adopt (drag.node);
    CHECK (sameBits (next.tick ({ .position = { drag.p, 0, 0 } }), drag.by (0)));
}

TEST_CASE ("friction: no input breaks it", "[nodes][friction]")
{
    tactus::test::property ("outputs are finite and the state is known", [] {
        const auto number = rc::gen::element (0.0, -0.0, 1.0, -1.0, 1e-5, -3e-5, 1e-4, 1e-320, 1e-200, -1e160, 1e300, -1e308,
                                              not_a_number, tactus::inf, -tactus::inf);
        const auto positive = rc::gen::element (1e-9, 1e-5, 1e-4, 1.0, 1e150, 1e300);
        ElastoPlastic node;
        for (int k = 0; k < 40; ++k)
        {
            node.params.mu = *rc::gen::element (0.0, 0.4, 1e300, 1e-310);
            node.params.d_max = *positive;
            node.params.static_ratio = *rc::gen::element (1.0, 2.5, 1e300);
            node.params.break_away = *rc::gen::element (0.0, 0.7, 1.0);
            node.params.stiffness = *rc::gen::element (0.0, 1000.0, 1e300);
            node.params.load = *rc::gen::element (Load::bound, Load::scale, Load::passive);
            node.params.reference_load = *rc::gen::element (1e-9, 1.0, 1e300);
            node.params.adhesion = *rc::gen::elementOf (std::vector<Adhesion> (all_adhesions));
            node.params.integrator = *rc::gen::elementOf (std::vector<Integrator> (both_integrators));
            const Vec3 p { *number, *number, *number };
            const Vec3 n = *rc::gen::arbitrary<bool>() ? Vec3 { 0, 0, 1 } : Vec3 { *number, *number, *number };
            const auto out = node.tick ({ .position = p, .normal = n, .normal_force = *number });
            RC_ASSERT (tactus::isFinite (out.force, out.deflection, out.stored_energy, out.dissipated_energy));
            RC_ASSERT (out.state == -1.0 || out.state == 0.0 || out.state == 1.0 || out.state == 2.0);
        }
    });
}
