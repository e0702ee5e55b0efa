// SPDX-License-Identifier: MIT
#include "surface_rig.hpp"

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

using namespace tactus;
using namespace tactus::test;
using Frictions = ElasticSurface::Friction;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
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
    CHECK (out.dissipated_energy == Approx (400.0 * 1e-3 * 1e-3));   // slides by 1 mm at the bound

    out = node.tick ({ .position = Vec3 (0.022, 0.01, -0.002) });
    CHECK (out.state == 1.0);

    CHECK (node.tick ({ .position = Vec3 (0.022, 0.01, 0.0) }).state == 0.0);
}

TEST_CASE ("surface: tools are mixed, and the mix is latched", "[nodes][deform]")
{
    auto node = made (body (flat(), { { curves (100.0, 1000.0) }, { curves (100.0, 3000.0) }, { curves (100.0, 100.0) } }, { { .number = 0.5 } }));
    const auto press = [&] (double tool, double depth) { return node.tick ({ .position = Vec3 (0.02, 0.01, -depth), .tool = tool }).resistance; };

    press (0.25, -1e-3);
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
    property ("work over loops", [] (unsigned seed) {
        std::mt19937 dice (seed);
        std::uniform_real_distribution<double> one (-1.0, 1.0);
        const double bump = 0.002 * one (dice);   // a radius of at least 22 mm. The tool is at most 18 mm deep: much deeper, and the contact jumps
        const auto mesh = grid (4, 0.04, [&] (double x, double y) { return bump * std::sin (150.0 * x) * std::cos (110.0 * y); });
        Hand hand { made (uneven (mesh, seed, 1e3)) };   // mu is so large that nothing slips
        const Vec3 touch { 0.02 + 0.01 * one (dice), 0.02 + 0.01 * one (dice), bump + 0.01 };
        hand.p = touch;
        hand.line (touch - Vec3 (0.0, 0.0, 0.02), 20);
        RC_ASSERT (hand.out.state == 1.0);
        const Vec3 centre = hand.p;
        const double before = hand.out.stored_energy;
        double most = 0.0;
        const double a = 0.004 * one (dice), b = 0.003 * one (dice), c = 0.002 * one (dice);
        const auto around = [&] (int steps) {
            hand.work = 0.0;
            for (int k = 1; k <= steps; ++k)
            {
                const double phi = 2.0 * std::numbers::pi * k / steps;
                hand.to (centre + Vec3 (a * std::sin (phi), b * std::sin (2.0 * phi), c * (1.0 - std::cos (phi))));
                most = std::max (most, std::abs (hand.work));
            }
            return std::abs (hand.work);
        };
        // The rule of the trapezoids has an error where the foot passes a node. A real error would remain, however fine the steps are.
        const double coarse = around (4000), limit = 1e-6 * (most + before) + 1e-12;
        RC_ASSERT (std::abs (hand.out.stored_energy - before) <= 1e-12 * std::max (1.0, before));
        RC_ASSERT ((coarse <= limit || around (64'000) <= limit));
    });
}

TEST_CASE ("surface: the work of the hand is the stored plus the lost energy", "[nodes][deform]")
{
    property ("random strokes in and out", [] (unsigned seed) {
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
    property ("random strokes", [] (unsigned seed) {
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
    property ("closed paths over level frames", [] (unsigned seed) {
        std::mt19937 dice (seed);
        std::uniform_real_distribution<double> one (-1.0, 1.0);
        Hand hand { made (uneven (flat(), seed), Frictions::frictionless) };
        const auto at = [a = one (dice), b = one (dice), c = one (dice)] (double phi) {
            const double x = 0.02 + 0.012 * std::sin (phi + a), y = 0.02 + 0.012 * std::sin (2.0 * phi + b);
            return Vec3 (x, y, -0.0015 - 0.001 * std::sin (phi + c));
        };
        hand.to (at (0.0) + 0.01 * Vec3::UnitZ());
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

TEST_CASE ("surface: without friction, the force does not step where a slide crosses an edge", "[nodes][deform]")
{
    property ("slides over pads whose stiffness varies by half", [] (unsigned seed) {
        std::mt19937 dice (seed);
        std::uniform_real_distribution<double> one (-1.0, 1.0);
        const auto mesh = flat();
        std::vector<Surface::Curves> nodes;
        for (std::size_t i = 0; i < mesh.points.size(); ++i)
            nodes.push_back (curves (500.0, 1000.0 + 500.0 * one (dice)));
        const auto surface = body (mesh, { nodes }, {});
        const Vec3 from (0.004, 0.02 + 0.012 * one (dice), -0.002), to (0.036, 0.02 + 0.012 * one (dice), -0.002);
        const auto largestStep = [&] (int steps) {
            auto node = made (surface);
            double most = 0.0;
            node.tick ({ .position = from + 0.01 * Vec3::UnitZ() });
            Vec3 force = node.tick ({ .position = from }).force;
            for (int k = 1; k <= steps; ++k)
            {
                const auto out = node.tick ({ .position = from + (to - from) * k / steps });
                RC_ASSERT (out.state == 2.0);
                most = std::max (most, (out.force - force).norm());
                force = out.force;
            }
            return most;
        };
        const double coarse = largestStep (500);
        RC_ASSERT (coarse < 0.05);
        RC_ASSERT (largestStep (8000) < 0.2 * coarse);   // a real step would stay as large on a finer path
    });
}

TEST_CASE ("surface: the force does not step where a slide crosses an edge", "[nodes][deform]")
{
    property ("slides over uneven meshes", [] (unsigned seed) {
        std::mt19937 dice (seed);
        std::uniform_real_distribution<double> one (-1.0, 1.0);
        const auto mesh = grid (4, 0.04, [&] (double x, double y) { return 0.001 * std::sin (100.0 * x + y * 70.0); });
        auto node = made (uneven (mesh, seed, 0.5 * (1.1 + one (dice))));
        const Vec3 from (0.004, 0.02 + 0.012 * one (dice), -0.003), to (0.036, 0.02 + 0.012 * one (dice), -0.003);
        constexpr int steps = 8000;
        std::vector<double> inside, across;
        node.tick ({ .position = from + 0.01 * Vec3::UnitZ() });
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
        node.tick ({ .position = Vec3 (0.005, 0.02, 0.001) });
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
    node.tick ({ .position = Vec3 (0.02, 0.02, 0.001) });
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
    node.tick ({ .position = Vec3 (0.101, 0.02, -0.02) });
    const auto out = node.tick ({ .position = Vec3 (0.099, 0.02, -0.02) });
    CHECK (out.state == 1.0);
    CHECK (out.force.isApprox (Vec3 (1.0, 0.0, 0.0), 1e-9));
    CHECK (out.normal.isApprox (Vec3::UnitX(), 1e-12));
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
    old.tick ({ .position = Vec3 (0.02, 0.02, 0.001) });
    old.tick ({ .position = Vec3 (0.02, 0.02, -0.002) });
    auto stiffer = made (std::make_shared<const Surface> (Surface { mesh, {}, { { curves (400.0, 2000.0) } }, { { .number = 0.5 } } }));
    stiffer.adopt (old);
    const auto out = stiffer.tick ({ .position = Vec3 (0.0205, 0.02, -0.002) });
    CHECK (out.state == 1.0);
    CHECK (out.force.isApprox (Vec3 (-0.2, 0.0, 4.0), 1e-9));

    auto other = made (body (flat(), { { curves (400.0, 1000.0) } }, { { .number = 0.5 } }));
    other.adopt (old);
    CHECK (other.tick ({ .position = Vec3 (0.0205, 0.02, -0.002) }).force.isZero (0.0));
    other.tick ({ .position = Vec3 (0.0205, 0.02, 0.001) });
    CHECK (other.tick ({ .position = Vec3 (0.0205, 0.02, -0.002) }).force.isApprox (Vec3 (0.0, 0.0, 2.0), 1e-12));
}

TEST_CASE ("surface: a surface that faces the wrong way or pulls is reported, one with tilted frames is not", "[nodes][deform]")
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

    auto leaning = upward;
    leaning.frames.assign (4, Vec3 (1, -1, -1).asDiagonal() * Eigen::AngleAxisd (0.2, Vec3::UnitX()).toRotationMatrix());
    const auto measured = made (std::make_shared<const Surface> (leaning), Frictions::frictionless);
    CHECK (measured.warning ({}).empty());
    CHECK (measured.claims().passive);
    CHECK (made (std::make_shared<const Surface> (leaning)).claims().passive);
    CHECK (made (uneven (flat(), 3, 0.0)).warning ({}).find ("fewer than three cells") != std::string::npos);
}
