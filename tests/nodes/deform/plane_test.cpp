// SPDX-License-Identifier: MIT
#include <tactus/nodes/deform/plane.hpp>

#include <golden/golden.hpp>
#include <support/ready.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck/catch.h>

#include <cmath>
#include <vector>

using tactus::Vec3;
using tactus::nodes::Plane;
using tactus::test::Golden;
using tactus::test::ready;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The fraction of its speed that a free mass keeps after it hits the wall.
double restitution (Plane node, double mass, double v, double dt)
{
    double z = 0.5 * v * dt, speed = -v;
    do
    {
        speed += node.tick ({ .position = { 0, 0, z } }).force.z() / mass * dt;
        z += speed * dt;
    } while (z < v * dt);
    return speed / v;
}
}   // namespace

TEST_CASE ("plane: a mass against a sampled wall matches the golden columns", "[nodes][deform][golden]")
{
    const Golden golden ("wallsim");
    const double K = golden.param ("K"), B = golden.param ("B"), M = golden.param ("M"), T = golden.dt_s();
    struct Case
    {
        std::string name;
        double stiffness, damping, quantum;
    };
    // At half quanta the last bit decides how the quantiser rounds: the tolerance is 1e-6 m, as in the golden set.
    const Case cases[] { { "smooth", K, 0.0, 0.0 }, { "damped", K / 2, 0.2 * B, 0.0 }, { "quant", K / 2, 0.0, golden.param ("quantum") } };

    for (const auto& [name, stiffness, damping, quantum] : cases)
    {
        // The wall is at x > 0: its normal points to -x.
        auto node = ready<Plane> ({ .normal = -Vec3::UnitX(), .stiffness = stiffness, .damping = damping }, 1.0 / T);

        const double a = std::exp (-B * T / M), g = M * (1.0 - a) / B;
        double x = golden.param ("x0"), v = golden.param ("v0");
        std::vector<double> xs, vs, fs;
        for (std::size_t i = 0; i < golden.rows(); ++i)
        {
            const double measured = quantum > 0.0 ? quantum * std::floor (x / quantum + 0.5) : x;
            const double f = node.tick ({ .position = { measured, 0, 0 } }).force.x();
            xs.push_back (x);
            vs.push_back (v);
            fs.push_back (f);
            const double F = f + golden.param ("hand_force");
            x += g * v + (T - g) / B * F;
            v = a * v + (1.0 - a) / B * F;
        }

        INFO (name);
        const auto off = [&] (const std::string& column,
                              const std::vector<double>& actual) { return golden.worst (column, [&] (std::size_t i) { return actual[i]; }); };
        CHECK (off ("x_" + name, xs) <= (quantum > 0.0 ? 1e-6 / golden.tolerance ("x_") : 1.0));
        CHECK (off ("v_" + name, vs) <= 1.0);
        CHECK (off ("f_" + name, fs) <= 1.0);
    }
}

TEST_CASE ("plane: no force while apart, and the depth gives the distance", "[nodes][deform]")
{
    auto node = ready<Plane> ({ .offset = 0.02 });
    const auto out = node.tick ({ .position = { 5, 6, 0.03 } });
    CHECK (out.force.isZero (0.0));
    CHECK (out.depth == Approx (-0.01));
    CHECK (out.stored_energy == 0.0);
    CHECK (out.state == 0.0);

    const auto touching = node.tick ({ .position = { 5, 6, 0.02 } });
    CHECK (touching.depth == 0.0);
    CHECK (touching.state == 0.0);
}

TEST_CASE ("plane: a spring pushes along the normal, whatever the length of the normal", "[nodes][deform]")
{
    const auto [x, y, z] = GENERATE (table<double, double, double> ({ { 0, 0, 1 }, { 0, -3, 0 }, { 1e-200, 2e-200, 2e-200 }, { 1e300, -1e300, 0 } }));
    const Vec3 unit = Vec3 { x, y, z }.stableNormalized();
    auto node = ready<Plane> ({ .normal = { x, y, z }, .offset = 0.01, .stiffness = 500.0 });
    const auto out = node.tick ({ .position = unit * 0.008 });

    CHECK (out.depth == Approx (0.002));
    CHECK (out.resistance == Approx (1.0));
    CHECK ((out.force - unit).norm() < 1e-12);
    CHECK (out.stored_energy == Approx (0.5 * 500.0 * 0.002 * 0.002));
    CHECK (out.state == 1.0);
}

TEST_CASE ("plane: a law replaces stiffness", "[nodes][deform]")
{
    auto node = ready<Plane> ({ .stiffness = 1e9 });
    node.settings.law = { .kind = tactus::Law::Kind::exponential, .a = 0.1, .b = 400.0, .table = {} };
    const auto out = node.tick ({ .position = { 0, 0, -0.005 } });
    CHECK (out.resistance == Approx (0.1 * std::expm1 (2.0)));
    CHECK (out.stored_energy == Approx (0.1 * (std::expm1 (2.0) / 400.0 - 0.005)));
}

TEST_CASE ("plane: hit is the speed of the approach, only on the tick of the first touch", "[nodes][deform]")
{
    auto node = ready<Plane> ({});
    const double v = 0.3, dt = 1e-3;
    int hits = 0;
    for (int k = 0; k < 40; ++k)
    {
        const auto out = node.tick ({ .position = { 0, 0, 0.00505 - v * dt * k } });
        if (out.hit != 0.0)
        {
            ++hits;
            CHECK (out.hit == Approx (v));
            CHECK (out.depth > 0.0);
            CHECK (out.depth < v * dt);
        }
    }
    CHECK (hits == 1);
}

TEST_CASE ("plane: a tool that is inside from the start triggers no hit", "[nodes][deform]")
{
    auto node = ready<Plane> ({ .damping = 5.0, .dissipation = 2.0 });
    const auto out = node.tick ({ .position = { 0, 0, -0.003 } });
    CHECK (out.hit == 0.0);
    CHECK (out.resistance == Approx (3.0));   // and no damping, because a first sample has no speed
}

TEST_CASE ("plane: a damped wall pushes harder going in, and never pulls coming out", "[nodes][deform]")
{
    auto node = ready<Plane> ({ .stiffness = 1000.0, .damping = 3.0 });
    node.tick ({ .position = { 0, 0, 0.001 } });
    CHECK (node.tick ({ .position = { 0, 0, -0.001 } }).resistance == Approx (1.0 + 3.0 * 2.0));   // the rate is the speed of the approach, 2 m/s
    CHECK (node.tick ({ .position = { 0, 0, -0.0009 } }).resistance == Approx (0.9 - 0.3));
    CHECK (node.tick ({ .position = { 0, 0, -0.0001 } }).resistance == 0.0);
}

TEST_CASE ("plane: an undamped wall gives back what it took, over any closed path", "[nodes][deform][energy]")
{
    auto node = ready<Plane> ({ .normal = { 1, 2, 2 }, .stiffness = 800.0 }, 4000.0);
    node.settings.law = { .kind = tactus::Law::Kind::power, .a = 5e4, .b = 1.5, .table = {} };
    const int n = 20'000;
    double work = 0.0, taken = 0.0;
    Vec3 p = Vec3::Zero(), f = Vec3::Zero();
    for (int k = 0; k <= n; ++k)
    {
        const double s = 2.0 * M_PI * k / n;
        const Vec3 next { 3e-3 * std::sin (s), -4e-3 * std::sin (2 * s), 2e-3 * std::sin (3 * s) };
        const Vec3 force = node.tick ({ .position = next }).force;
        const double step = -0.5 * (f + force).dot (next - p);
        work += step;
        taken += std::abs (step);
        p = next;
        f = force;
    }
    CHECK (taken > 1e-3);
    CHECK (std::abs (work) < 1e-6 * taken);
}

TEST_CASE ("plane: with dissipation a mass rebounds by Hunt and Crossley's law", "[nodes][deform]")
{
    // e = (1 + W (-(1 + x) exp (-(1 + x)))) / x, x = dissipation v; whatever the stiffness, mass and power.
    struct Case
    {
        double x, e;
    };
    for (const auto& [x, e] : { Case { 0.15, 0.909016 }, Case { 1.0, 0.593624 }, Case { 5.0, 0.196980 } })
        for (const double power : { 1.0, 1.5 })
        {
            const double v = 0.5, dt = 1e-7;
            auto node = ready<Plane> ({ .dissipation = x / v }, 1.0 / dt);
            node.settings.law = { .kind = tactus::Law::Kind::power, .a = power == 1.0 ? 5e4 : 1e6, .b = power, .table = {} };
            INFO (x << " " << power);
            CHECK (restitution (node, 0.05, v, dt) == Approx (e).epsilon (2e-3));
        }
}

TEST_CASE ("plane: the slower the impact, the better the rebound", "[nodes][deform]")
{
    const double dt = 1e-6;
    double last = 1.0;
    for (const double v : { 0.05, 0.2, 0.8 })
    {
        const double e = restitution (ready<Plane> ({ .stiffness = 5e4, .dissipation = 1.0 }, 1.0 / dt), 0.05, v, dt);
        CHECK (e < last);
        if (v < 0.1) CHECK (1.0 - e == Approx (2.0 / 3.0 * v).epsilon (0.1));
        last = e;
    }
}

TEST_CASE ("plane: a fault gives 0, and the next sample counts as the first", "[nodes][deform]")
{
    for (const Vec3& bad : { Vec3 { 0, 0, not_a_number }, Vec3 { tactus::inf, 0, 0 }, Vec3 { 0, 0, -1.7e308 } })
    {
        auto node = ready<Plane> ({ .damping = 5.0 });
        node.tick ({ .position = { 0, 0, -0.001 } });
        const auto out = node.tick ({ .position = bad });
        CHECK (out.state == -1.0);
        CHECK (out.force.isZero (0.0));
        CHECK (out.resistance == 0.0);
        CHECK (out.depth == 0.0);
        CHECK (out.stored_energy == 0.0);
        CHECK (node.tick ({ .position = { 0, 0, -0.003 } }).resistance == Approx (3.0));
        CHECK (node.tick ({ .position = { 0, 0, -0.003 } }).hit == 0.0);
    }

    CHECK (ready<Plane> ({ .normal = Vec3::Zero() }).tick ({ .position = { 0, 0, -0.001 } }).state == -1.0);
    CHECK (ready<Plane> ({ .offset = -1.7e308 }).tick ({ .position = { 0, 0, 1.7e308 } }).depth == 0.0);   // the distance is too large for a double
}

TEST_CASE ("plane: no input breaks it", "[nodes][deform]")
{
    rc::prop ("outputs are finite", [] {
        const auto number = rc::gen::element (0.0, 1.0, -1.0, -1e-3, 1e-320, -1e160, 1e300, -1.7e308, not_a_number, tactus::inf);
        auto node = ready<Plane> ({ .stiffness = *rc::gen::element (0.0, 1e3, 1e300),
                                    .damping = *rc::gen::element (0.0, 5.0, 1e300),
                                    .dissipation = *rc::gen::element (0.0, 1.0, 1e300) });
        if (*rc::gen::arbitrary<bool>()) node.settings.law = { .kind = tactus::Law::Kind::exponential, .a = 1.0, .b = 300.0, .table = {} };
        for (int k = 0; k < 20; ++k)
        {
            const double x = *number, y = *number, z = *number;
            const auto out = node.tick ({ .position = { x, y, z } });
            RC_ASSERT (tactus::isFinite (out.force, out.resistance, out.depth, out.hit, out.stored_energy));
            RC_ASSERT (out.resistance >= 0.0);
        }
    });
}

TEST_CASE ("plane: a new instance adopts the previous depth", "[nodes][deform]")
{
    auto old = ready<Plane> ({ .damping = 2.0 }), next = ready<Plane> ({ .damping = 2.0 });
    old.tick ({ .position = { 0, 0, -0.001 } });
    next.adopt (old);
    CHECK (next.tick ({ .position = { 0, 0, -0.0015 } }).resistance == Approx (1.5 + 2.0 * 0.5));
}

TEST_CASE ("plane: it claims the steepest slope of its law", "[nodes][deform]")
{
    auto node = ready<Plane> ({ .stiffness = 700.0, .damping = 2.0 });
    CHECK (node.claims().passive);
    CHECK (node.claims().stiffness == 700.0);
    CHECK (node.claims().damping == 2.0);
    node.settings.law = { .kind = tactus::Law::Kind::table, .a = 0.0, .b = 1.0, .table = { { 0.001, 0.002, 0.004 }, { 0.1, 0.5, 0.6 } } };
    CHECK (node.claims().stiffness == Approx (400.0));
    node.settings.law = { .kind = tactus::Law::Kind::exponential, .a = 0.1, .b = 300.0, .table = {} };
    CHECK (node.claims().stiffness == tactus::inf);
}
