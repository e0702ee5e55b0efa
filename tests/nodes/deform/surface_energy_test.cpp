// SPDX-License-Identifier: MIT
// An elastic surface never gives energy, whatever its mesh, frames, curves and friction.
#include "bodies.hpp"
#include "surface_rig.hpp"

#include "support/rounds.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <random>

using namespace tactus;
using namespace tactus::test;
using Frictions = ElasticSurface::Friction;

namespace
{
/// A closed path of the tool around the surface of a body. It begins and ends above the body.
class Loop
{
public:
    Loop (const Body& b, unsigned seed) : body (b)
    {
        std::mt19937 dice (seed);
        std::uniform_real_distribution<double> one (-1.0, 1.0);
        for (int w = 0; w < waves; ++w)
            for (int i = 0; i < 3; ++i)
            {
                sines[w][i] = one (dice) * body.reach[i] / (w + 1);
                cosines[w][i] = one (dice) * body.reach[i] / (w + 1);
            }
    }

    /// The position at a share of the path from 0 to 1. The first tenth leads down, the last tenth leads up.
    Vec3 operator() (double share) const
    {
        const double down = std::clamp (10.0 * std::min (share, 1.0 - share), 0.0, 1.0), s = 2.0 * std::numbers::pi * (share - 0.1) / 0.8;
        Vec3 p = body.centre;
        for (int w = 0; w < waves; ++w)
            p += sines[w] * std::sin ((w + 1) * s) + cosines[w] * std::cos ((w + 1) * s);
        const double high = body.centre.z() + 3.0 * body.reach.z() + 0.01;
        p.z() = high + (p.z() - high) * down;
        return p;
    }

private:
    static constexpr int waves = 3;
    const Body& body;
    Vec3 sines[waves], cosines[waves];
};

struct Balance
{
    double missing = 0.0;   // J; the largest |dissipated + stored - work|
    double fall = 0.0;      // J; the largest fall of dissipated_energy
    double moved = 0.0;     // J; the sum of |work| over all steps
    double held = 0.0;      // J; the work of the hand by the trapezoid rule
    double begun = 0.0;     // J; the largest energy of a step in which a contact begins
    int slips = 0, touches = 0;
};

PlacedSurface placedAt0 (const Body& body) { return { body.surface, 1.0, Vec3::Zero(), Vec3::Zero(), std::numbers::pi / 6.0 }; }

/// The work of the step in which a contact begins, computed from the place where the tool enters the body.
double workOfEntry (const PlacedSurface& placed, const ElasticSurface& node, const Vec3& to)
{
    auto tool = placed.noTool();
    placed.choose (0.0, Spot { 0, {} }, tool);
    const auto& [touch, cross] = node.begunAt();
    const Vec3 between = node.movedAt() < 1.0 ? Vec3 { cross + node.movedAt() * (to - cross) } : to;
    return followed (placed, tool, touch, cross, between).felt.energy + node.energyAt (to) - node.energyAt (between);
}

/// Moves the tool through a loop. The work of the step in which a contact begins is the energy at the point of entry.
Balance handled (ElasticSurface node, const PlacedSurface& placed, const Loop& loop, int steps)
{
    Balance balance;
    double work = 0.0;
    Vec3 p = loop (0.0);
    auto before = node.tick ({ .position = p });
    for (int k = 1; k <= steps; ++k)
    {
        const Vec3 next = loop (static_cast<double> (k) / steps);
        const auto earlier = node;
        const auto out = node.tick ({ .position = next });
        double step = workOf (earlier, node, p, next);
        const double lost = out.dissipated_energy - before.dissipated_energy;
        const bool begins = before.state == 0.0 && (out.state > 0.0 || lost > 0.0);   // a contact may begin and end in one step
        if (begins)
        {
            step = workOfEntry (placed, node, next);
            balance.begun = std::max (balance.begun, step);
        }
        work += step;
        balance.moved += std::abs (step);
        balance.held -= 0.5 * (before.force + out.force).dot (next - p);
        balance.missing = std::max (balance.missing, std::abs (out.dissipated_energy + out.stored_energy - work));
        balance.fall = std::max (balance.fall, -lost);
        balance.slips += out.state == 2.0;
        balance.touches += begins;
        p = next;
        before = out;
    }
    return balance;
}

/// Many short loops over every body, at every friction.
void neverGives (int loops, int steps)
{
    for (const double mu : { 0.01, 0.1, 0.5, 1.0, 0.0 })
        for (const auto& body : bodies (mu))
        {
            CAPTURE (body.name, mu);
            const auto node = made (body.surface, mu > 0.0 ? Frictions::bound : Frictions::frictionless);
            const auto placed = placedAt0 (body);
            CHECK (node.claims().passive);
            double missing = 0.0, fall = 0.0;
            int touches = 0, slips = 0;
            double begun = 0.0;
            for (int i = 0; i < loops; ++i)
            {
                const auto balance = handled (node, placed, Loop { body, static_cast<unsigned> (i) }, steps);
                missing = std::max (missing, balance.missing / (balance.moved + 1e-12));
                fall = std::max (fall, balance.fall);
                touches += balance.touches;
                slips += balance.slips;
                begun = std::max (begun, balance.begun);
            }
            CHECK (missing <= 1e-12);
            CHECK (fall == 0.0);
            CHECK (touches > loops / 2);
            CHECK (begun > 0.0);
            CHECK (slips > loops);
        }
}
}   // namespace

TEST_CASE ("surface: dissipated plus stored energy equals the work, to rounding, and dissipated energy never falls", "[nodes][deform][energy]")
{
    neverGives (test::rounds (200), 60);   // 5 frictions, so 1000 loops on each body
}

TEST_CASE ("surface: dissipated plus stored energy equals the work, on long loops too", "[.][long][nodes][deform][energy]")
{
    neverGives (1000, 2000);
}

TEST_CASE ("surface: the work by the trapezoid rule agrees as the path gets finer", "[nodes][deform][energy]")
{
    for (const double mu : { 0.01, 0.5, 0.0 })
        for (const auto& body : bodies (mu))
        {
            CAPTURE (body.name, mu);
            const auto node = made (body.surface, mu > 0.0 ? Frictions::bound : Frictions::frictionless);
            const auto placed = placedAt0 (body);
            double given = 0.0, moved = 0.0;
            for (unsigned i = 0; i < test::rounds (4u); ++i)
            {
                const auto balance = handled (node, placed, Loop { body, i }, 8000);
                given = std::max (given, -balance.held);
                moved += balance.moved;
            }
            CHECK (given <= 2e-3 * moved);
        }
}

TEST_CASE ("surface: the energy of the first touch vanishes as the path gets finer", "[nodes][deform][energy]")
{
    for (const double mu : { 0.3, 0.0 })
        for (const auto& body : bodies (mu))
        {
            CAPTURE (body.name, mu);
            const auto placed = placedAt0 (body);
            const auto begun = [&] (int steps) {
                double most = 0.0;
                for (unsigned i = 0; i < 4; ++i)
                    most = std::max (most, handled (made (body.surface), placed, Loop { body, i }, steps).begun);
                return most;
            };
            const double coarse = begun (200);
            CHECK (coarse > 0.0);
            CHECK (begun (6400) < 0.03 * coarse);   // proportional to the square of the step, apart from where the samples fall
        }
}

TEST_CASE ("surface: pressing where it is soft and releasing where it is stiff gives no energy, with little friction or none", "[nodes][deform][energy]")
{
    std::vector<Surface::Curves> nodes;
    const auto mesh = flat (8);
    for (const auto& p : mesh.points)
        nodes.push_back (curves (400.0, 200.0 + 5e4 * p.x()));
    for (const double mu : { 0.0, 0.01, 0.1, 0.6 })
    {
        Hand hand { made (body (mesh, { nodes }, { { .number = mu } })) };
        CHECK (hand.node.claims().passive);
        CHECK (hand.node.warning ({}).empty());
        hand.p = Vec3 (0.005, 0.02, 0.001);
        hand.line (Vec3 (0.005, 0.02, -0.003), 2000);
        hand.line (Vec3 (0.035, 0.02, -0.003), 20000);
        hand.line (Vec3 (0.035, 0.02, 0.001), 2000);
        CAPTURE (mu);
        CHECK (hand.work > -1e-6);
        if (mu == 0.0) CHECK (std::abs (hand.work) < 1e-6);
        if (mu == 0.6) CHECK (hand.work > 1e-4);
    }
}
