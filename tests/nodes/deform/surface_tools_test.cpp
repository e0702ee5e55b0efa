// SPDX-License-Identifier: MIT
// Shapes of tools on an elastic surface: eq. (8) and (9) of the chapter.
#include "bodies.hpp"
#include "surface_rig.hpp"

#include <support/no_allocation.hpp>

#include <catch2/catch.hpp>

#include <cmath>

using namespace tactus;
using namespace tactus::test;

namespace
{
constexpr double depth = 1e-3;

ElasticSurface::Outputs press (ElasticSurface& node, double tool, const Vec3& place = Vec3 (0.02, 0.01, 0.0))
{
    node.tick ({ .position = place + Vec3 (0.0, 0.0, 1e-3), .tool = tool });
    return node.tick ({ .position = place - Vec3 (0.0, 0.0, depth), .tool = tool });
}

Surface threeShapes()
{
    Surface s;
    s.mesh = std::make_shared<const Mesh> (flat());
    s.curves = { { curves (100.0, 1000.0) }, { curves (100.0, 3000.0) }, { curves (100.0, 8000.0) } };
    s.mu = { { .number = 0.5 } };
    return s;
}
}   // namespace

TEST_CASE ("surface: a tool may be a mix of any number of shapes, and there may be more tools than shapes", "[nodes][deform]")
{
    auto s = threeShapes();
    s.weights = { { { 1.0, 0.0, 0.0 } }, { { 0.2, 0.3, 0.5 } }, { { 0.0, 0.0, 1.0 } }, { { 0.5, 0.5, 0.0 } } };
    auto node = made (std::make_shared<const Surface> (s));
    CHECK (node.problem().empty());
    CHECK (press (node, 0.0).resistance == Approx (1.0));
    CHECK (press (node, 1.0).resistance == Approx (0.2 * 1.0 + 0.3 * 3.0 + 0.5 * 8.0));
    CHECK (press (node, 3.0).resistance == Approx (2.0));
    CHECK (press (node, 9.0).resistance == Approx (2.0));
    CHECK (press (node, 2.5).resistance == Approx (0.5 * 8.0 + 0.5 * 2.0));   // halfway between tools 2 and 3
    CHECK (press (node, 0.25).resistance == Approx (0.75 * 1.0 + 0.25 * 5.1));
}

TEST_CASE ("surface: weights at the nodes make a tool feel different over bone, and hold while it touches", "[nodes][deform]")
{
    auto s = threeShapes();
    auto& tool = s.weights.emplace_back();
    for (const auto& p : s.mesh->points)
        tool.push_back ({ 1.0 - p.x() / 0.04, 0.0, p.x() / 0.04 });
    auto node = made (std::make_shared<const Surface> (s));
    CHECK (press (node, 0.0, Vec3 (0.01, 0.013, 0.0)).resistance == Approx (0.75 * 1.0 + 0.25 * 8.0));
    CHECK (press (node, 0.0, Vec3 (0.03, 0.013, 0.0)).resistance == Approx (0.25 * 1.0 + 0.75 * 8.0));

    press (node, 0.0, Vec3 (0.01, 0.013, 0.0));
    const NoAllocation watch;
    const auto dragged = node.tick ({ .position = Vec3 (0.03, 0.013, -depth) });   // the contact point is over the bone now
    CHECK (watch.allocations() == 0);
    CHECK (dragged.state == 2.0);
    CHECK (dragged.resistance == Approx (0.75 * 1.0 + 0.25 * 8.0));
}

TEST_CASE ("surface: each shape may have its own sideways axes and mu", "[nodes][deform]")
{
    auto s = threeShapes();
    const Surface::Curves grained { power (100.0), power (300.0), power (1000.0) };   // stiffer along u^y
    s.curves = { { grained }, { grained } };
    const auto nodes = s.mesh->points.size();
    Mat3 level, turned;
    level << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    turned << 0, 1, 0, 1, 0, 0, 0, 0, -1;
    s.frames.assign (nodes, level);
    s.frames.insert (s.frames.end(), nodes, turned);
    s.mu.assign (nodes, { .number = 0.2 });
    s.mu.insert (s.mu.end(), nodes, { .number = 0.8 });
    auto node = made (std::make_shared<const Surface> (s));
    CHECK (node.problem().empty());
    for (const double tool : { 0.0, 1.0, 0.5 })
    {
        CHECK (press (node, tool, Vec3 (0.02, 0.013, 0.0)).normal.isApprox (Vec3::UnitZ(), 1e-12));
        const double pulled = 1e-5;   // sticks; halfway, the axes lie between x and y, so both springs are stretched
        CHECK (node.tick ({ .position = Vec3 (0.02, 0.013 + pulled, -depth), .tool = tool }).force.y() == Approx (-(300.0 - 200.0 * tool) * pulled));
        const double held = node.tick ({ .position = Vec3 (0.02, 0.03, -depth), .tool = tool }).contact.y();
        CHECK (0.03 - held == Approx ((0.2 + 0.6 * tool) * depth).epsilon (0.02));
    }
}

TEST_CASE ("surface: the normal is that of the body, however the frames lean", "[nodes][deform]")
{
    auto s = threeShapes();
    Mat3 leaning;
    leaning << std::cos (0.1), 0, std::sin (0.1), 0, -1, 0, std::sin (0.1), 0, -std::cos (0.1);
    s.frames.assign (s.mesh->points.size(), leaning);
    auto node = made (std::make_shared<const Surface> (s));
    const auto out = press (node, 0.0);
    CHECK (out.normal.isApprox (Vec3::UnitZ(), 1e-12));
    CHECK (out.force.isApprox (out.resistance * Vec3::UnitZ(), 1e-12));
}

TEST_CASE ("surface: weights that do not add up to 1 are refused", "[nodes][deform]")
{
    auto s = threeShapes();
    s.weights = { { { 1.0, 0.0, 0.0 } }, { { 0.2, 0.3, 0.6 } } };
    CHECK (made (std::make_shared<const Surface> (s)).problem().find ("tool 1, node 0") != std::string::npos);
    s.weights = { { { 1.5, -0.5, 0.0 } } };
    CHECK (made (std::make_shared<const Surface> (s)).problem().find ("at least 0") != std::string::npos);
}

TEST_CASE ("surface: mu may be a curve of depth, constant beyond its ends", "[nodes][deform]")
{
    const Ratio ratio { .curve = { { 1e-3, 3e-3 }, { 0.2, 0.8 } } };
    CHECK (ratio (0.0) == 0.2);
    CHECK (ratio (2e-3) == Approx (0.5));
    CHECK (ratio (1.0) == 0.8);
    CHECK_FALSE (ratio.isNone());
    for (const double deep : { 5e-4, 2e-3, 4e-3 })
    {
        auto node = made (body (flat(), { { curves (400.0, 1000.0) } }, { ratio }));
        node.tick ({ .position = Vec3 (0.005, 0.02, 0.001) });
        ElasticSurface::Outputs out;
        for (int k = 0; k < 1500; ++k)
            out = node.tick ({ .position = Vec3 (0.005 + 2e-5 * k, 0.02, -deep) });
        CHECK (-out.force.x() / out.force.z() == Approx (ratio (deep) * 400.0 / 1000.0));
    }
}
