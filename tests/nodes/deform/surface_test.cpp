// SPDX-License-Identifier: MIT
#include <nodes/deform/surface.hpp>

#include <framework/run/query_thread.hpp>

#include <support/no_allocation.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck/catch.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <thread>

using namespace tactus;
using tactus::nodes::ElasticSurface;
using Frictions = ElasticSurface::Friction;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Law power (double k, double n = 1.0) { return { .kind = Law::Kind::power, .a = k, .b = n }; }
Law exponential (double a, double b) { return { .kind = Law::Kind::exponential, .a = a, .b = b }; }
Surface::Curves curves (double across, double along, double n = 1.0) { return { power (across), power (across), power (along, n) }; }

/// A square of side length on [0, length]², n cells per side, facing up, with heights from a function.
template <typename Height>
Mesh grid (int n, double length, Height height)
{
    Mesh mesh;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
        {
            const double x = length * i / n, y = length * j / n;
            mesh.points.push_back (Vec3 (x, y, height (x, y)));
        }
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
        {
            const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
            mesh.triangles.push_back ({ a, b, c });
            mesh.triangles.push_back ({ a, c, d });
        }
    return mesh;
}

Mesh flat (int n = 4, double length = 0.04)
{
    return grid (n, length, [] (double, double) { return 0.0; });
}

/// A ball about the origin: an octahedron whose faces are divided and pushed out.
Mesh ball (double radius, int divisions)
{
    Mesh mesh;
    const Vec3 tips[] { Vec3::UnitX(), Vec3::UnitY(), -Vec3::UnitX(), -Vec3::UnitY(), Vec3::UnitZ(), -Vec3::UnitZ() };
    const int n = 1 << divisions;
    std::map<std::array<long, 3>, int> known;
    const auto point = [&] (const Vec3& p) {
        const std::array<long, 3> key { std::lround (p.x() * n), std::lround (p.y() * n), std::lround (p.z() * n) };
        const auto [at, fresh] = known.try_emplace (key, static_cast<int> (mesh.points.size()));
        if (fresh) mesh.points.push_back (radius * p.normalized());
        return at->second;
    };
    for (int side = 0; side < 4; ++side)
        for (const int pole : { 4, 5 })
        {
            const Vec3 a = tips[pole], b = tips[pole == 4 ? side : (side + 1) % 4], c = tips[pole == 4 ? (side + 1) % 4 : side];
            const auto at = [&] (int i, int j) { return point ((a * (n - i) + b * (i - j) + c * j) / n); };
            for (int i = 0; i < n; ++i)
                for (int j = 0; j <= i; ++j)
                {
                    mesh.triangles.push_back ({ at (i, j), at (i + 1, j), at (i + 1, j + 1) });
                    if (j < i) mesh.triangles.push_back ({ at (i, j), at (i + 1, j + 1), at (i, j + 1) });
                }
        }
    return mesh;
}

std::shared_ptr<const Surface> body (Mesh mesh, std::vector<std::vector<Surface::Curves>> tools, std::vector<Ratio> mu)
{
    return std::make_shared<const Surface> (Surface { std::make_shared<const Mesh> (std::move (mesh)), {}, std::move (tools), std::move (mu) });
}

/// Every node of the mesh has its own laws: springs of different stiffness along x and y, and all kinds of laws along z.
std::shared_ptr<const Surface> uneven (Mesh mesh, unsigned seed, double mu = 0.5)
{
    std::mt19937 dice (seed);
    std::uniform_real_distribution<double> one (0.0, 1.0);
    std::vector<Surface::Curves> nodes;
    std::vector<Ratio> ratios;
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
    {
        const auto z = [&]() -> Law {
            if (i % 3 == 0) return exponential (0.1 + one (dice), 200.0 * one (dice) + 50.0);
            if (i % 3 == 1) return power (2e4 * (1.0 + one (dice)), 1.5);
            return { .kind = Law::Kind::table, .table = { { 1e-3, 3e-3 }, { 0.5 * one (dice), 2.0 + one (dice) } } };
        };
        const Law along_z = z();
        nodes.push_back ({ power (300.0 + 900.0 * one (dice)), power (300.0 + 900.0 * one (dice)), along_z });
        ratios.push_back ({ .number = mu * (0.5 + one (dice)) });
    }
    return body (std::move (mesh), { nodes }, ratios);
}

ElasticSurface made (std::shared_ptr<const Surface> surface, Frictions friction = Frictions::bound, double rate_hz = 1000.0)
{
    ElasticSurface node;
    node.settings.surface = std::move (surface);
    node.params.friction = friction;
    node.prepare ({ .rate_hz = rate_hz });
    return node;
}

/// The work of the hand along a path, computed with the trapezoid rule.
struct Hand
{
    ElasticSurface node;
    Vec3 p = Vec3::Zero();
    ElasticSurface::Outputs out {};
    double work = 0.0, moved = 0.0;   // J; moved: the sum of absolute values

    const ElasticSurface::Outputs& to (const Vec3& next)
    {
        const Vec3 before = out.force, step = next - p;
        out = node.tick ({ .position = next });
        const double done = -0.5 * (before + out.force).dot (step);
        work += done;
        moved += std::abs (done);
        p = next;
        return out;
    }

    void line (const Vec3& end, int steps)
    {
        const Vec3 start = p;
        for (int k = 1; k <= steps; ++k)
            to (start + (end - start) * k / steps);
    }
};
}   // namespace

TEST_CASE ("surface: one triangle with one curve, computed manually", "[nodes][deform]")
{
    auto node = made (body (flat (1), { { curves (400.0, 1000.0) } }, { { .number = 0.5 } }));
    CHECK (node.tick ({ .position = Vec3 (0.02, 0.01, 0.001) }).state == 0.0);

    auto out = node.tick ({ .position = Vec3 (0.02, 0.01, -0.002) });
    CHECK (out.state == 1.0);
    CHECK (out.hit == Approx (3.0));   // 3 mm within 1 ms
    CHECK (out.force.isApprox (Vec3 (0.0, 0.0, 2.0), 1e-12));
    CHECK (out.resistance == Approx (2.0));
    CHECK (out.depth == Approx (0.002));
    CHECK (out.contact.isApprox (Vec3 (0.02, 0.01, 0.0), 1e-12));
    CHECK (out.normal.isApprox (Vec3::UnitZ(), 1e-12));
    CHECK (out.stored_energy == Approx (0.002));

    out = node.tick ({ .position = Vec3 (0.0205, 0.01, -0.002) });   // 0.5 mm sideways is within the bound of 0.5 * 2 mm
    CHECK (out.state == 1.0);
    CHECK (out.hit == 0.0);
    CHECK (out.force.isApprox (Vec3 (-0.2, 0.0, 2.0), 1e-12));

    out = node.tick ({ .position = Vec3 (0.022, 0.01, -0.002) });   // beyond the bound: c is dragged, 1 mm behind the tool
    CHECK (out.state == 2.0);
    CHECK (out.force.isApprox (Vec3 (-0.4, 0.0, 2.0), 1e-12));
    CHECK (out.contact.isApprox (Vec3 (0.021, 0.01, 0.0), 1e-12));
    CHECK (out.dissipated_energy == Approx (0.5 * 400.0 * (4e-6 - 1e-6)));

    out = node.tick ({ .position = Vec3 (0.022, 0.01, -0.002) });
    CHECK (out.state == 1.0);

    CHECK (node.tick ({ .position = Vec3 (0.022, 0.01, 0.0) }).state == 0.0);
}

TEST_CASE ("surface: tools are mixed, and the mix is latched", "[nodes][deform]")
{
    auto node = made (body (flat(), { { curves (100.0, 1000.0) }, { curves (100.0, 3000.0) }, { curves (100.0, 100.0) } }, { { .number = 0.5 } }));
    const auto press = [&] (double tool, double depth) { return node.tick ({ .position = Vec3 (0.02, 0.01, -depth), .tool = tool }).resistance; };

    CHECK (press (0.25, 1e-3) == Approx (1.5));
    CHECK (press (2.0, 1e-3) == Approx (1.5));   // during contact, the mix does not change
    press (2.0, -1e-3);
    CHECK (press (2.0, 1e-3) == Approx (0.1));
    press (9.0, -1e-3);
    CHECK (press (9.0, 1e-3) == Approx (0.1));
    press (-1.0, -1e-3);
    CHECK (press (-1.0, 1e-3) == Approx (1.0));
}

TEST_CASE ("surface: a closed path that sticks gives and takes nothing, whatever the mesh, frames and curves", "[nodes][deform]")
{
    rc::prop ("work over loops", [] (unsigned seed) {
        std::mt19937 dice (seed);
        std::uniform_real_distribution<double> one (-1.0, 1.0);
        const double bump = 0.003 * one (dice);
        const auto mesh = grid (4, 0.04, [&] (double x, double y) { return bump * std::sin (150.0 * x) * std::cos (110.0 * y); });
        Hand hand { made (uneven (mesh, seed, 1e3)) };   // mu is so large that nothing slips
        const Vec3 touch (0.02 + 0.01 * one (dice), 0.02 + 0.01 * one (dice), bump + 0.01);
        hand.p = touch;
        hand.line (touch - Vec3 (0.0, 0.0, 0.02), 20);
        RC_ASSERT (hand.out.state == 1.0);
        const Vec3 centre = hand.p;
        const double before = hand.out.stored_energy;
        hand.work = 0.0;

        double most = 0.0;
        const double a = 0.004 * one (dice), b = 0.003 * one (dice), c = 0.002 * one (dice);
        for (int k = 1; k <= 4000; ++k)
        {
            const double phi = 2.0 * std::numbers::pi * k / 4000;
            hand.to (centre + Vec3 (a * std::sin (phi), b * std::sin (2.0 * phi), c * (1.0 - std::cos (phi))));
            most = std::max (most, std::abs (hand.work));
        }
        RC_ASSERT (std::abs (hand.out.stored_energy - before) <= 1e-12 * std::max (1.0, before));
        RC_ASSERT (std::abs (hand.work) <= 1e-6 * (most + before) + 1e-12);
    });
}

TEST_CASE ("surface: the work of the hand is the stored plus the lost energy", "[nodes][deform]")
{
    rc::prop ("random strokes in and out", [] (unsigned seed) {
        const auto surface = uneven (flat(), seed);
        double moved = 0.0;
        const auto missing = [&] (int steps) {
            std::mt19937 dice (seed);
            std::uniform_real_distribution<double> one (-1.0, 1.0);
            Hand hand { made (surface) };
            hand.p = Vec3 (0.02, 0.02, 0.002);
            for (int stroke = 0; stroke < 6; ++stroke)
                hand.line (Vec3 (0.02 + 0.015 * one (dice), 0.02 + 0.015 * one (dice), -0.001 + 0.003 * one (dice)), steps);
            moved = hand.moved;
            return hand.work - hand.out.stored_energy - hand.out.dissipated_energy;
        };
        // The error of a slip is proportional to the step, so the difference is extrapolated to a step of 0. A stroke that only
        // grazes the surface has few steps in contact, so if the result is too large, it is computed again with finer steps: a
        // real error would remain, however fine they are.
        const auto extrapolated = [&] (int steps) { return std::abs (2.0 * missing (2 * steps) - missing (steps)); };
        const double at_once = extrapolated (1000);
        RC_ASSERT ((at_once <= 5e-3 * moved || extrapolated (16000) <= 5e-3 * moved));
    });
}

TEST_CASE ("surface: a pad of uniform softness never generates energy on a closed path", "[nodes][deform]")
{
    rc::prop ("random strokes", [] (unsigned seed) {
        std::mt19937 dice (seed);
        std::uniform_real_distribution<double> one (-1.0, 1.0);
        auto node = made (body (flat(), { { { power (400.0), power (900.0), exponential (0.5, 300.0) } } }, { { .number = std::abs (one (dice)) } }));
        RC_ASSERT (node.claims().passive);
        double lost = 0.0;
        for (int k = 0; k < 2000; ++k)
        {
            const auto out = node.tick ({ .position = Vec3 (0.02 + 0.015 * one (dice), 0.02 + 0.015 * one (dice), 0.003 * one (dice)) });
            RC_ASSERT (out.dissipated_energy >= lost - 1e-12);
            lost = out.dissipated_energy;
        }
    });
}

TEST_CASE ("surface: without friction, moving from soft to stiff and back costs nothing", "[nodes][deform]")
{
    rc::prop ("closed paths over level frames", [] (unsigned seed) {
        std::mt19937 dice (seed);
        std::uniform_real_distribution<double> one (-1.0, 1.0);
        Hand hand { made (uneven (flat(), seed), Frictions::frictionless) };
        const auto at = [a = one (dice), b = one (dice), c = one (dice)] (double phi) {
            const double x = 0.02 + 0.012 * std::sin (phi + a), y = 0.02 + 0.012 * std::sin (2.0 * phi + b);
            return Vec3 (x, y, -0.0015 - 0.001 * std::sin (phi + c));
        };
        hand.p = at (0.0);
        hand.to (at (0.0));
        hand.work = 0.0;
        double most = 0.0;
        for (int k = 1; k <= 8000; ++k)
        {
            hand.to (at (2.0 * std::numbers::pi * k / 8000));
            RC_ASSERT (hand.out.state == 2.0);
            most = std::max (most, std::abs (hand.work));
        }
        RC_ASSERT (std::abs (hand.work) <= 1e-2 * most);
    });   // the quadrature has an error at each edge, where the gradient steps
}

TEST_CASE ("surface: without -dU/dc, pressing where it is soft and releasing where it is stiff would generate energy", "[nodes][deform]")
{
    std::vector<Surface::Curves> nodes;
    const auto mesh = flat (8);
    for (const auto& p : mesh.points)
        nodes.push_back (curves (400.0, 200.0 + 5e4 * p.x()));
    const auto loop = [&] (Frictions friction, double mu) {
        Hand hand { made (body (mesh, { nodes }, { { .number = mu } }), friction) };
        hand.p = Vec3 (0.005, 0.02, 0.001);
        hand.line (Vec3 (0.005, 0.02, -0.003), 2000);
        hand.line (Vec3 (0.035, 0.02, -0.003), 20000);
        hand.line (Vec3 (0.035, 0.02, 0.001), 2000);
        return std::pair { hand.work, hand.node };
    };
    CHECK (std::abs (loop (Frictions::frictionless, 0.5).first) < 1e-6);
    CHECK (std::abs (loop (Frictions::bound, 0.0).first) < 1e-6);   // mu 0 is frictionless
    CHECK (loop (Frictions::bound, 0.01).first < -1e-4);            // this loop generates energy, and the warning says so
    CHECK (loop (Frictions::bound, 0.01).second.warning ({}).find ("generates energy") != std::string::npos);
    CHECK_FALSE (loop (Frictions::bound, 0.01).second.claims().passive);
    CHECK (loop (Frictions::bound, 0.6).first > 1e-4);
}

TEST_CASE ("surface: the force does not step where a slide crosses an edge", "[nodes][deform]")
{
    rc::prop ("slides over uneven meshes", [] (unsigned seed) {
        std::mt19937 dice (seed);
        std::uniform_real_distribution<double> one (-1.0, 1.0);
        const auto mesh = grid (4, 0.04, [&] (double x, double y) { return 0.001 * std::sin (100.0 * x + y * 70.0); });
        auto node = made (uneven (mesh, seed, 0.3));
        const Vec3 from (0.004, 0.02 + 0.012 * one (dice), -0.003), to (0.036, 0.02 + 0.012 * one (dice), -0.003);
        constexpr int steps = 8000;
        std::vector<double> inside, across;
        Vec3 force = node.tick ({ .position = from }).force;
        double triangle = -2.0;
        for (int k = 1; k <= steps; ++k)
        {
            const auto out = node.tick ({ .position = from + (to - from) * k / steps });
            if (k > 1000) (triangle == out.triangle ? inside : across).push_back ((out.force - force).norm());
            force = out.force;
            triangle = out.triangle;
        }
        RC_ASSERT (across.size() > 3u);
        const double usual = *std::ranges::max_element (inside);
        for (const double step : across)
            RC_ASSERT (step <= 3.0 * usual + 1e-9);
    });
}

TEST_CASE ("surface: a slipping tool drags its contact behind, by mu times the depth", "[nodes][deform]")
{
    const Ratio law { .law = { .kind = Law::Kind::table, .table = { { 1e-3, 4e-3 }, { 0.8, 0.2 } } } };
    for (const auto& ratio : { Ratio { .number = 0.7 }, law })
    {
        auto node = made (body (flat(), { { curves (400.0, 1000.0) } }, { ratio }));
        node.tick ({ .position = Vec3 (0.005, 0.02, -0.002) });
        ElasticSurface::Outputs out;
        for (int k = 0; k < 1000; ++k)
            out = node.tick ({ .position = Vec3 (0.005 + 2e-5 * k, 0.02, -0.002) });
        CHECK (out.state == 2.0);
        CHECK ((0.005 + 2e-5 * 999) - out.contact.x() == Approx (ratio (0.002) * 0.002));
        CHECK (-out.force.x() / out.force.z() == Approx (ratio (0.002) * 400.0 / 1000.0));   // Amontons
    }
}

TEST_CASE ("surface: a fault gives 0, and the next touch starts fresh", "[nodes][deform]")
{
    auto node = made (body (flat(), { { curves (400.0, 1000.0) } }, { { .number = 0.5 } }));
    node.tick ({ .position = Vec3 (0.02, 0.02, -0.002) });
    node.tick ({ .position = Vec3 (0.025, 0.02, -0.002) });
    for (const auto& in : { ElasticSurface::Inputs { .position = Vec3 (0.02, not_a_number, 0.0) },
                            { .position = Vec3 (0.02, 0.02, -0.002), .tool = not_a_number } })
    {
        const auto out = node.tick (in);
        CHECK (out.state == -1.0);
        CHECK (out.force.isZero (0.0));
        CHECK (out.contact.isZero (0.0));
        CHECK (out.triangle == -1.0);
        CHECK (out.stored_energy == 0.0);
        CHECK (out.dissipated_energy > 0.0);

        const auto fresh = node.tick ({ .position = Vec3 (0.03, 0.02, -0.002) });
        CHECK (fresh.state == 1.0);
        CHECK (fresh.hit == 0.0);
        CHECK (fresh.force.isApprox (Vec3 (0.0, 0.0, 2.0), 1e-12));
    }
}

TEST_CASE ("surface: scale, origin and rotation place the mesh", "[nodes][deform]")
{
    auto node = made (body (flat (4, 40.0), { { curves (400.0, 1000.0) } }, { { .number = 0.5 } }));
    node.settings.scale = 1e-3;
    node.settings.origin = Vec3 (0.1, 0.0, 0.0);
    node.settings.rotation = Vec3 (0.0, std::numbers::pi / 2.0, 0.0);   // up becomes +x
    node.prepare ({ .rate_hz = 1000.0 });
    const auto out = node.tick ({ .position = Vec3 (0.099, 0.02, -0.02) });
    CHECK (out.state == 1.0);
    CHECK (out.force.isApprox (Vec3 (1.0, 0.0, 0.0), 1e-9));
    CHECK (out.normal.isApprox (Vec3::UnitX(), 1e-12));
}

TEST_CASE ("surface: a ball is felt from all sides, with a search of any length", "[nodes][deform]")
{
    rc::prop ("presses from random directions", [] (unsigned seed) {
        std::mt19937 dice (seed);
        std::normal_distribution<double> bell;
        auto node = made (body (ball (0.03, 3), { { curves (400.0, 1000.0) } }, { { .number = 0.5 } }));
        node.settings.search_ticks = static_cast<int> (seed % 7);
        node.prepare ({ .rate_hz = 1000.0 });
        for (int press = 0; press < 4; ++press)
        {
            const Vec3 towards = Vec3 (bell (dice), bell (dice), bell (dice)).normalized();
            ElasticSurface::Outputs out;
            for (int k = 0; k <= 100; ++k)
                out = node.tick ({ .position = towards * (0.04 - 0.012 * k / 100.0) });
            RC_ASSERT (out.state >= 1.0);
            RC_ASSERT (out.normal.dot (towards) > 0.98);
            RC_ASSERT (out.force.dot (towards) > 0.9 * out.force.norm());
            RC_ASSERT (std::abs (out.depth - 0.002) < 5e-4);   // the ball has facets
            node.tick ({ .position = towards * 0.05 });
        }
    });
}

TEST_CASE ("surface: a search changes no force in contact, and costs only the first ticks", "[nodes][deform]")
{
    rc::prop ("the same strokes, searched immediately or later", [] (unsigned seed) {
        const auto surface = uneven (grid (12, 0.04, [] (double x, double y) { return 0.002 * std::sin (90.0 * x) * std::sin (80.0 * y); }), seed);
        auto at_once = made (surface), later = made (surface);
        later.settings.search_ticks = 8;
        later.prepare ({ .rate_hz = 1000.0 });
        for (int k = 0; k < 1000; ++k)
        {
            const double t = 3e-3 * k;
            const Vec3 position (0.02 + 0.015 * std::sin (3.0 * t + seed % 5), 0.02 + 0.015 * std::sin (2.0 * t), 0.003 * std::cos (5.0 * t));
            const ElasticSurface::Inputs in { .position = position };
            const auto a = at_once.tick (in), b = later.tick (in);
            RC_ASSERT (k < 9 || a.force == b.force);
            RC_ASSERT (k < 9 || a.contact == b.contact);
        }
    });
}

TEST_CASE ("surface: searched by a thread on 100 000 triangles, live runs are bit-identical and allocate nothing", "[nodes][deform]")
{
    const auto surface = body (ball (0.03, 7), { { curves (400.0, 1000.0) } }, { { .number = 0.5 } });
    REQUIRE (surface->mesh->triangles.size() > 100'000);

    const auto run = [&] (QueryService* answers, std::chrono::microseconds pause) {
        ElasticSurface node;
        node.settings.surface = surface;
        node.settings.search_ticks = 40;
        node.prepare ({ .rate_hz = 4000.0, .services = { .answers = answers } });
        std::vector<double> forces;
        for (int k = 0; k < 1200; ++k)
        {
            std::this_thread::sleep_for (pause);
            const double t = k / 4000.0;
            const Vec3 p (0.01 * std::sin (30.0 * t), 0.01 * std::cos (20.0 * t), 0.0285 + 0.004 * std::cos (25.0 * t));
            const NoAllocation watch;
            const auto out = node.tick ({ .position = p });
            REQUIRE (watch.allocations() == 0);
            REQUIRE (watch.locks() == 0);
            for (int i = 0; i < 3; ++i)
                forces.push_back (out.force[i]);
        }
        return forces;
    };
    const auto rendered = run (nullptr, {});
    CHECK (std::ranges::any_of (rendered, [] (double f) { return f != 0.0; }));

    for (std::chrono::microseconds pause { 500 };; pause *= 2)   // the busier the machine, the more time the search gets
    {
        QueryThread answers;
        const auto live = run (&answers, pause);
        if (answers.lateTicks() > 0 && pause < std::chrono::milliseconds (20)) continue;
        CHECK (answers.lateTicks() == 0);
        CHECK (live == rendered);
        break;
    }
}

TEST_CASE ("surface: a mesh that cannot be used is reported", "[nodes][deform]")
{
    const std::vector<std::vector<Surface::Curves>> tools { { curves (1.0, 1.0) } };
    const auto problem = [] (std::shared_ptr<const Surface> s) {
        ElasticSurface node;
        node.settings.surface = std::move (s);
        return node.problem();
    };
    CHECK (problem (body ({}, tools, {})).find ("no triangles") != std::string::npos);
    CHECK (problem (body (flat(), {}, {})).find ("no curves") != std::string::npos);

    auto thin = flat();
    thin.triangles[3] = { 0, 1, 1 };
    CHECK (problem (body (thin, tools, {})) == "triangle 3 has no area");

    auto skew = Surface { std::make_shared<const Mesh> (flat (1)), std::vector<Mat3> (4, Mat3::Identity()), tools, {} };
    CHECK (problem (std::make_shared<const Surface> (skew)).empty());
    skew.frames[2](0, 1) = 0.1;
    CHECK (problem (std::make_shared<const Surface> (skew)).find ("node 2") != std::string::npos);

    auto many = made (body (ball (0.03, 5), tools, { { .number = 0.5 } }));
    CHECK (many.warning ({}).find ("search_ticks") != std::string::npos);
    many.settings.search_ticks = 8;
    CHECK (many.warning ({}).empty());
}

TEST_CASE ("surface: a new instance on the same mesh keeps the contact", "[nodes][deform]")
{
    const auto mesh = std::make_shared<const Mesh> (flat());
    auto old = made (std::make_shared<const Surface> (Surface { mesh, {}, { { curves (400.0, 1000.0) } }, { { .number = 0.5 } } }));
    old.tick ({ .position = Vec3 (0.02, 0.02, -0.002) });
    auto stiffer = made (std::make_shared<const Surface> (Surface { mesh, {}, { { curves (400.0, 2000.0) } }, { { .number = 0.5 } } }));
    stiffer.adopt (old);
    const auto out = stiffer.tick ({ .position = Vec3 (0.0205, 0.02, -0.002) });
    CHECK (out.state == 1.0);
    CHECK (out.force.isApprox (Vec3 (-0.2, 0.0, 4.0), 1e-12));

    auto other = made (body (flat(), { { curves (400.0, 1000.0) } }, { { .number = 0.5 } }));
    other.adopt (old);
    CHECK (other.tick ({ .position = Vec3 (0.0205, 0.02, -0.002) }).force.isApprox (Vec3 (0.0, 0.0, 2.0), 1e-12));
}

TEST_CASE ("surface: past the rim of an open mesh there is nothing to touch", "[nodes][deform]")
{
    for (const auto friction : { Frictions::bound, Frictions::frictionless })
    {
        auto node = made (body (flat(), { { curves (400.0, 1000.0) } }, { { .number = 0.5 } }), friction);
        CHECK (node.tick ({ .position = Vec3 (0.3, 0.02, -0.002) }).state == 0.0);
        CHECK (node.tick ({ .position = Vec3 (0.05, 0.05, -0.002) }).state == 0.0);

        double most = 0.0;
        ElasticSurface::Outputs out;
        for (int k = 0; k <= 1000; ++k)
        {
            out = node.tick ({ .position = Vec3 (0.02 + 3e-5 * k, 0.0213, -0.002) });
            most = std::max (most, std::hypot (out.force.x(), out.force.y()));
        }
        CHECK (out.state == 0.0);
        CHECK (most <= 400.0 * 0.002 + 1e-9);                                         // k_t d^z
        CHECK (node.tick ({ .position = Vec3 (0.02, 0.02, -0.002) }).state == 0.0);   // the tool came in past the rim, from behind
        CHECK (node.tick ({ .position = Vec3 (0.02, 0.02, 0.002) }).state == 0.0);
        out = node.tick ({ .position = Vec3 (0.02, 0.02, -0.002) });
        CHECK (out.state > 0.0);
        CHECK (out.hit == Approx (4.0));
    }
}

TEST_CASE ("surface: a closed body has no rim", "[nodes][deform]")
{
    rc::prop ("points inside and outside a ball", [] (unsigned seed) {
        std::mt19937 dice (seed);
        std::normal_distribution<double> bell;
        const MeshWalk walk { ball (0.03, 2) };
        for (int k = 0; k < 50; ++k)
        {
            const Vec3 p = 0.03 * Vec3 (bell (dice), bell (dice), bell (dice));
            RC_ASSERT (! walk.isBeyondRim (walk.nearestOfAll (p), p));
        }
    });
}

TEST_CASE ("surface: a path around the rim and up through the surface generates no energy", "[nodes][deform]")
{
    for (const auto friction : { Frictions::bound, Frictions::frictionless })
    {
        Hand hand { made (body (flat(), { { curves (400.0, 1000.0) } }, { { .number = 0.01 } }), friction) };
        hand.p = Vec3 (0.06, 0.02, 0.005);
        for (int round = 0; round < 3; ++round)
        {
            hand.line (Vec3 (0.06, 0.02, -0.01), 1000);
            hand.line (Vec3 (0.02, 0.02, -0.01), 1000);
            hand.line (Vec3 (0.02, 0.02, 0.005), 1000);
            hand.line (Vec3 (0.06, 0.02, 0.005), 1000);
            CHECK (hand.work == 0.0);
        }
    }
}

TEST_CASE ("surface: a tool that was inside when the first search ended feels the body once it has been outside", "[nodes][deform]")
{
    auto node = made (body (flat(), { { curves (400.0, 1000.0) } }, { { .number = 0.5 } }));
    node.settings.search_ticks = 20;
    node.prepare ({ .rate_hz = 1000.0 });
    double steepest = 0.0, before = 0.0;
    const auto move = [&] (double depth) {
        const double force = node.tick ({ .position = Vec3 (0.02, 0.01, -depth) }).resistance;
        steepest = std::max (steepest, std::abs (force - before));
        before = force;
    };
    for (int k = 0; k < 100; ++k)
        move (-0.001 + 1e-4 * k);
    CHECK (before == 0.0);
    for (int k = 100; k >= 0; --k)
        move (-0.001 + 1e-4 * k);
    for (int k = 0; k < 100; ++k)
        move (-0.001 + 1e-4 * k);
    CHECK (before > 8.0);
    CHECK (steepest < 0.11);
}

TEST_CASE ("surface: a surface that faces the wrong way, pulls, or has tilted frames is reported", "[nodes][deform]")
{
    const std::vector<std::vector<Surface::Curves>> tools { { curves (400.0, 1000.0) } };
    auto inside_out = ball (0.03, 2);
    for (auto& t : inside_out.triangles)
        std::swap (t[0], t[1]);
    CHECK (made (body (inside_out, tools, { { .number = 0.5 } })).warning ({}).find ("faces inwards") != std::string::npos);
    CHECK (made (body (ball (0.03, 2), tools, { { .number = 0.5 } })).warning ({}).empty());

    auto upward = Surface { std::make_shared<const Mesh> (flat (1)), std::vector<Mat3> (4, Mat3::Identity()), tools, { { .number = 0.5 } } };
    CHECK (made (std::make_shared<const Surface> (upward)).warning ({}).find ("node 0") != std::string::npos);

    const Law pulls { .kind = Law::Kind::table, .table = { { 0.005, 0.01 }, { 5.0, -5.0 } } };
    CHECK (made (body (flat(), { { { power (1.0), power (1.0), pulls } } }, {})).problem().find ("must not pull") != std::string::npos);

    const auto bumpy = grid (4, 0.04, [] (double x, double y) { return 0.003 * std::sin (150.0 * x) * std::cos (110.0 * y); });
    CHECK (made (body (bumpy, tools, { { .number = 0.5 } }), Frictions::frictionless).warning ({}).find ("tilted") != std::string::npos);
    CHECK (made (uneven (flat(), 3, 0.0)).warning ({}).empty());   // no friction: no warning, although the nodes differ
}
