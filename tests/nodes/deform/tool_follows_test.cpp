// SPDX-License-Identifier: MIT
// A surface whose tool follows its tilt within a contact: the hand pays dU/dw with the torque.
#include "surface_rig.hpp"

#include <expert/hands.hpp>
#include <support/no_allocation.hpp>
#include <tactus/nodes/deform/tool.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

using namespace tactus;
using namespace tactus::test;
using nodes::DeformTool;

namespace
{
/// A smooth random motion of a tool that touches, presses, shears, tilts, and leaves.
class Motion
{
public:
    explicit Motion (Dice& dice)
    {
        for (auto& wave : waves)
            for (auto& v : wave)
                v = { dice.uniform (-1.0, 1.0), dice.uniform (-1.0, 1.0), dice.uniform (-1.0, 1.0) };
    }

    Vec3 position (double t) const
    {
        const double down = std::sin (std::numbers::pi * t);
        return Vec3 (0.02, 0.02, 1e-3 - 4e-3 * down) + 1e-3 * down * sum (0, t);
    }
    Vec3 rotation (double t) const { return 0.6 * sum (2, t); }

private:
    Vec3 sum (std::size_t first, double t) const
    {
        return std::sin (2.0 * std::numbers::pi * t) * waves[first][0] + std::cos (2.0 * std::numbers::pi * t) * waves[first][1]
               + std::sin (4.0 * std::numbers::pi * t) * waves[first + 1][0] + std::cos (4.0 * std::numbers::pi * t) * waves[first + 1][1];
    }

    std::array<std::array<Vec3, 2>, 4> waves;
};

std::shared_ptr<const Surface> uneven (double mu)
{
    Surface s;
    s.mesh = std::make_shared<const Mesh> (flat());
    s.curves = { { curves (100.0, 1000.0) }, { curves (700.0, 8000.0) }, { curves (300.0, 2000.0) } };
    s.mu = { { .number = mu } };
    return std::make_shared<const Surface> (s);
}
}   // namespace

TEST_CASE ("surface: if the tool follows the tilt, work of the hand = stored + dissipated energy, at 1, 4 and 20 kHz", "[nodes][deform][energy]")
{
    for (unsigned seed = 0; seed < 15; ++seed)   // random smooth motions and tilts, sticking and slipping
    {
        CAPTURE (seed);
        Dice dice { seed };
        const Motion motion { dice };
        const double mu = dice.uniform (0.0, 1.0) < 0.3 ? 0.0 : dice.size (0.05, 1.0);
        double missing[3], paid = 0.0;
        const double rates[] { 1e3, 4e3, 20e3 };
        for (std::size_t i = 0; i < 3; ++i)
        {
            auto node = made (uneven (mu));
            node.params.blend = ElasticSurface::Blend::follows;
            DeformTool faces;
            faces.settings.faces = { { -Vec3::UnitZ(), 0.0 }, { Vec3::UnitX(), 1.0 }, { Vec3 (0.0, 1.0, -0.5), 2.0 } };
            faces.prepare ({});
            const int steps = static_cast<int> (0.25 * rates[i]);
            double work = 0.0, moved = 0.0;
            paid = 0.0;
            ElasticSurface::Outputs before;
            for (int k = 0; k <= steps; ++k)
            {
                const double t = static_cast<double> (k) / steps, earlier = static_cast<double> (k - 1) / steps;
                const auto tilt = faces.tick ({ .rotation = motion.rotation (t) });
                const auto out = node.tick ({ .position = motion.position (t), .tool = tilt.tool, .turn = tilt.turn });
                CHECK (out.dissipated_energy >= before.dissipated_energy);
                if (k > 0)
                {
                    const Mat3 d = rotationMatrix (motion.rotation (t)) * rotationMatrix (motion.rotation (earlier)).transpose();
                    const Vec3 turn = 0.5 * Vec3 { d (2, 1) - d (1, 2), d (0, 2) - d (2, 0), d (1, 0) - d (0, 1) };
                    const double by_turning = -0.5 * (out.torque + before.torque).dot (turn);
                    const double step = -0.5 * (out.force + before.force).dot (motion.position (t) - motion.position (earlier)) + by_turning;
                    work += step;
                    moved += std::abs (step);
                    paid += std::abs (by_turning);
                }
                before = out;
            }
            missing[i] = std::abs (work - before.stored_energy - before.dissipated_energy) / (moved + 1e-12);
        }
        CHECK (missing[0] <= 6e-2);
        CHECK (missing[1] <= 2e-2);
        CHECK (missing[2] <= 4e-3);
        CHECK (paid > 0.0);
    }
}

TEST_CASE ("surface: a tool that follows costs no memory in the tick, and feels no torque while apart or latched", "[nodes][deform]")
{
    auto node = made (uneven (0.5));
    node.params.blend = ElasticSurface::Blend::follows;
    const Vec3 turn { 0.0, 1.0, 0.0 };
    CHECK (node.tick ({ .position = { 0.02, 0.02, 1e-3 }, .tool = 0.5, .turn = turn }).torque.isZero (0.0));
    node.tick ({ .position = { 0.02, 0.02, -1e-3 }, .tool = 0.0, .turn = turn });
    const NoAllocation watch;
    const auto out = node.tick ({ .position = { 0.02, 0.02, -1e-3 }, .tool = 0.5, .turn = turn });
    CHECK (watch.allocations() == 0);
    CHECK (out.resistance == Approx (4.5));
    CHECK (out.torque.y() == Approx (-0.5 * 7000.0 * 1e-6));

    node = made (uneven (0.5));
    node.tick ({ .position = { 0.02, 0.02, 1e-3 }, .turn = turn });
    node.tick ({ .position = { 0.02, 0.02, -1e-3 }, .turn = turn });
    const auto latched = node.tick ({ .position = { 0.02, 0.02, -1e-3 }, .tool = 0.5, .turn = turn });
    CHECK (latched.resistance == Approx (1.0));
    CHECK (latched.torque.isZero (0.0));
}
