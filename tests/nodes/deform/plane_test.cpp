// SPDX-License-Identifier: MIT
#include <tactus/nodes/deform/plane.hpp>

#include <golden/golden.hpp>
#include <support/property.hpp>
#include <support/ready.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>
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

TEST_CASE ("plane: the dissipated energy is the area of the loop, m v^2 (1 - e^2) / 2", "[nodes][deform][energy]")
{
    struct Case
    {
        double x, e;
    };
    const double m = 0.05, v = 0.5, dt = 1e-6;
    for (const auto& [x, e] : { Case { 0.15, 0.909016 }, Case { 1.0, 0.593624 }, Case { 5.0, 0.196980 } })
    {
        auto node = ready<Plane> ({ .dissipation = x / v }, 1.0 / dt);
        node.settings.law = { .kind = tactus::Law::Kind::power, .a = 1e6, .b = 1.5, .table = {} };
        double z = 0.5 * v * dt, speed = -v, dissipated = 0.0;
        while (z < v * dt)
        {
            const auto out = node.tick ({ .position = { 0, 0, z } });
            CHECK (out.dissipated_energy >= dissipated);
            dissipated = out.dissipated_energy;
            speed += out.force.z() / m * dt;
            z += speed * dt;
        }
        INFO (x);
        CHECK (dissipated == Approx (0.5 * m * v * v * (1.0 - e * e)).epsilon (2e-3));
    }
}

TEST_CASE ("plane: the hand's work is what is stored plus what is dissipated, on any path", "[nodes][deform][energy]")
{
    tactus::test::property ("any law, damping and path", [] (unsigned seed) {
        std::mt19937 random { seed };
        const auto uniform = [&] (double from, double to) { return std::uniform_real_distribution { from, to }(random); };
        const double dt = 1e-5;
        auto node = ready<Plane> ({ .stiffness = 800.0, .damping = uniform (0.0, 3.0), .dissipation = uniform (0.0, 5.0) }, 1.0 / dt);
        if (random() % 2 == 0) node.settings.law = { .kind = tactus::Law::Kind::power, .a = 5e4, .b = 1.5, .table = {} };
        const double a = uniform (-2e-3, 2e-3), b = uniform (-2e-3, 2e-3), w = uniform (5.0, 60.0);
        const auto depth = [&] (int k) { return -1e-4 + a * std::sin (w * k * dt) + b * (1.0 - std::cos (2.3 * w * k * dt)); };

        double work = 0.0, moved = 0.0, dissipated = 0.0;
        Plane::Outputs last = node.tick ({ .position = { 0, 0, -depth (0) } });
        for (int k = 1; k < 20'000; ++k)
        {
            const auto out = node.tick ({ .position = { 0, 0, -depth (k) } });
            const double before = std::max (0.0, depth (k - 1)), now = std::max (0.0, depth (k));   // with damping, the force steps at the surface
            const double mean = before == 0.0 ? out.resistance : (now == 0.0 ? last.resistance : 0.5 * (out.resistance + last.resistance));
            const double step = mean * (now - before);
            work += step;
            moved += std::abs (step);
            RC_ASSERT (out.dissipated_energy >= dissipated);
            dissipated = out.dissipated_energy;
            last = out;
        }
        RC_ASSERT (std::abs (last.stored_energy + dissipated - work) <= 2e-3 * moved + 1e-7);
    });
}

TEST_CASE ("plane: a spring alone dissipates nothing, and a fault or a new instance keeps what was dissipated", "[nodes][deform][energy]")
{
    auto spring = ready<Plane> ({});
    auto damped = ready<Plane> ({ .damping = 2.0 });
    double dissipated = 0.0;
    for (const double z : { 0.001, -0.001, -0.003, -0.002, 0.001 })
    {
        CHECK (spring.tick ({ .position = { 0, 0, z } }).dissipated_energy == 0.0);
        dissipated = damped.tick ({ .position = { 0, 0, z } }).dissipated_energy;
    }
    CHECK (dissipated > 0.0);
    CHECK (damped.tick ({ .position = { 0, 0, not_a_number } }).dissipated_energy == dissipated);
    auto next = ready<Plane> ({ .damping = 2.0 });
    next.adopt (damped);
    CHECK (next.tick ({ .position = { 0, 0, 0.001 } }).dissipated_energy == dissipated);
}

TEST_CASE ("plane: a rate too low for a hard hit is reported, with the rate that the contact needs", "[nodes][deform]")
{
    auto node = ready<Plane> ({ .dissipation = 1.0 });
    node.settings.law = { .kind = tactus::Law::Kind::power, .a = 5e5, .b = 1.5, .table = {} };
    CHECK (node.warning ({ .rate_hz = 1000.0 }) == "");   // without a mass, the node cannot judge the rate
    node.learn ({ .mass = 0.05 });
    CHECK (node.warning ({ .rate_hz = 1000.0 })
           == "a tool of 0.05 kg that hits at 2 m/s comes back at 1.5 times its speed instead of 0.41 times, even without a delay, because the contact lasts "
              "only 5.2 samples; raise the rate to 3800 Hz, which gives 0.45 times without a delay, or use a softer law");
    CHECK (node.warning ({ .rate_hz = 2200.0 }) == "");
    CHECK (node.warning ({ .rate_hz = 20'000.0 }) == "");

    // A simulated mass confirms the warning: at 1 kHz it can come back faster than it came; at 2200 Hz it is right to within 0.22.
    const auto returned = [&] (double rate, double phase) {
        auto wall = node;
        wall.prepare ({ .rate_hz = rate });
        const double T = 1.0 / rate, v = 2.0;
        double z = (1.0 - phase) * v * T, speed = -v;
        wall.tick ({ .position = { 0, 0, z + v * T } });
        do
        {
            const double a = wall.tick ({ .position = { 0, 0, z } }).force.z() / 0.05;
            z += T * speed + 0.5 * T * T * a;
            speed += T * a;
        } while (z < 0.0 || speed < 0.0);
        return speed / v;
    };
    double least = 10.0, most = 0.0;
    for (double phase = 0.0; phase < 1.0; phase += 0.05)
    {
        least = std::min (least, returned (1000.0, phase));
        most = std::max (most, returned (1000.0, phase));
        CHECK (returned (2200.0, phase) == Approx (0.4107).margin (0.22));
    }
    CHECK (least < 1.27);
    CHECK (most > 1.27);
}

TEST_CASE ("plane: what a simulated device damps counts when the rate is judged", "[nodes][deform]")
{
    auto node = ready<Plane> ({ .stiffness = 4000.0 });
    node.learn ({ .mass = 0.05, .damping = 0.0 });
    CHECK (node.warning ({ .rate_hz = 1000.0 }) != "");
    node.learn ({ .mass = 0.05, .damping = 0.0 });
    CHECK (node.warning ({ .rate_hz = 10'000.0 }) == "");
    node.learn ({ .mass = 0.05, .damping = 20.0 });
    CHECK (node.warning ({ .rate_hz = 1000.0 }) == "");
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
    tactus::test::property ("outputs are finite", [] {
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

namespace
{
/// The largest error of the force on a tool that a hand moves up and down in a wall of 1 N/mm and 2 N s/m. The wall reads the position in
/// steps of 5 um.
double worstDamping (double rate, double window)
{
    Plane node;
    node.params = { .stiffness = 1000.0, .damping = 2.0 };
    node.settings.window = window;
    node.prepare ({ .rate_hz = rate });
    node.update();
    const double w = 2.0 * M_PI * 2.0, size = 1e-3, quantum = 5e-6;
    double worst = 0.0;
    for (int k = 0; k < static_cast<int> (0.5 * rate); ++k)
    {
        const double t = k / rate, depth = size * (1.0 + std::sin (w * t));
        const double force = node.tick ({ .position = { 0, 0, -quantum * std::floor (depth / quantum + 0.5) } }).force.z();
        if (t < 0.01 || depth < 5e-5) continue;
        worst = std::max (worst, std::abs (force - std::max (0.0, 1000.0 * depth + 2.0 * size * w * std::cos (w * t))));
    }
    return worst;
}
}   // namespace

TEST_CASE ("plane: with a window, the damping of a coarse position is the same at every rate", "[nodes][deform]")
{
    for (const double rate : { 1000.0, 4000.0, 20'000.0 })
        CHECK (worstDamping (rate, 1e-3) < 0.015);
    CHECK (worstDamping (20'000.0, 0.0) > 0.1);
}

TEST_CASE ("plane: with a window, the damping never gives energy", "[nodes][deform][energy]")
{
    tactus::test::property ("any tremor, seen exactly or in steps", [] {
        std::mt19937 random (*rc::gen::arbitrary<unsigned>());
        std::uniform_real_distribution<double> uniform;
        Plane node;
        node.params = { .stiffness = 1000.0, .damping = 5.0, .dissipation = 3.0 };
        node.settings.window = 1e-3 * (1.0 + 9.0 * uniform (random));
        node.prepare ({ .rate_hz = 4000.0 });
        node.update();
        const double quantum = uniform (random) < 0.5 ? 0.0 : 1e-5;
        double z = 1e-4, v = 0.0, work = 0.0, dissipated = 0.0;
        for (int k = 0; k < 2000; ++k)
        {
            v = 0.9 * v + 2e-5 * (uniform (random) - 0.5) - 0.01 * (z + 1e-4);
            const double before = z;
            z += v;
            const double seen = quantum > 0.0 ? quantum * std::floor (z / quantum + 0.5) : z;
            const double last = quantum > 0.0 ? quantum * std::floor (before / quantum + 0.5) : before;
            const auto out = node.tick ({ .position = { 0, 0, seen } });
            work -= out.force.z() * (seen - last);   // of the force at the end of the step: at least what is stored
            RC_ASSERT (work >= out.stored_energy - 1e-12);
            RC_ASSERT (out.dissipated_energy >= dissipated);
            dissipated = out.dissipated_energy;
        }
    });
}
