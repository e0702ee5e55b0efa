// SPDX-License-Identifier: MIT
// Tests of what an expert tries first: touching, releasing and touching again.

#include "hands.hpp"
#include <support/property.hpp>
#include <support/rig.hpp>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

using namespace tactus;
using tactus::test::Dice;
using tactus::test::Sketch;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A random sample that ruptures, and blades to cut it.
struct Potato
{
    explicit Potato (Dice& dice)
    {
        const double width = dice.uniform (0.005, 0.05), toughness = dice.uniform (50.0, 3000.0), depth = dice.size (1e-3, 1e-2);
        f_cut = width * toughness;
        f_rupture = f_cut * dice.uniform (1.0, 3.0);
        if (dice.below (2) == 0)
        {
            const double n = dice.uniform (1.0, 3.0);
            law = { .kind = Law::Kind::power, .a = f_rupture / std::pow (depth, n), .b = n };
        }
        else
        {
            const double b = dice.uniform (50.0, 500.0);
            law = { .kind = Law::Kind::exponential, .a = f_rupture / std::expm1 (b * depth), .b = b };
        }
        d_rupture = law.inverse (f_rupture);
    }

    Rig blade() const
    {
        Rig rig { "cut.blade" };
        rig.set ("law", law).param ("width", 0.01).param ("toughness", f_cut / 0.01).param ("rupture_force", f_rupture);
        REQUIRE (rig.problem().empty());
        rig.prepare();
        return rig;
    }

    double f_cut, f_rupture, d_rupture;   // in N, N, m
    Law law;
};

/// What the hand feels along a path.
struct Felt
{
    double most = 0.0;   // largest force, in N
    bool bursts = false;
};

/// Presses the blade in n equal steps.
Felt press (Rig& rig, double from, double to, int n)
{
    Felt felt;
    for (int k = 1; k <= n; ++k)
    {
        rig.input ("depth", k == n ? to : from + (to - from) * k / n);
        rig.tick();
        felt.most = std::max (felt.most, rig.out ("resistance"));
        felt.bursts = felt.bursts || rig.out ("state") == 2.0;
    }
    return felt;
}

/// A 4 cm square that faces upwards: two triangles with a diagonal seam, soft at some corners and stiff at others. Sideways it
/// is half as stiff as along the normal.
std::shared_ptr<const Surface> flesh (Dice& dice, double mu, bool frames_lean)
{
    Surface s;
    const Mesh square { { { -0.02, -0.02, 0 }, { 0.02, -0.02, 0 }, { 0.02, 0.02, 0 }, { -0.02, 0.02, 0 } }, { { 0, 1, 2 }, { 0, 2, 3 } } };
    s.mesh = std::make_shared<const Mesh> (square);
    auto& corners = s.curves.emplace_back();
    for (int i = 0; i < 4; ++i)
    {
        const double k = dice.size (500.0, 2000.0), n = 1.0 + 0.5 * dice.below (2), along = k * std::pow (1e-3, 1.0 - n);
        const auto law = [&] (double share) { return Law { .kind = Law::Kind::power, .a = share * along, .b = n }; };
        corners.push_back ({ law (0.5), law (0.5), law (1.0) });
        if (! frames_lean) continue;
        const double angle = dice.uniform (-0.2, 0.2);
        const Vec3 axis { dice.uniform (-1.0, 1.0), dice.uniform (-1.0, 1.0), 0.1 };
        const Eigen::Quaterniond lean { Eigen::AngleAxisd (angle, axis.normalized()) };
        s.frames.push_back (Vec3 { 1, -1, -1 }.asDiagonal() * lean.toRotationMatrix());
    }
    s.mu.push_back ({ .number = mu });
    return std::make_shared<const Surface> (std::move (s));
}

Rig skin (const std::shared_ptr<const Surface>& surface, bool rubs)
{
    Rig rig { "deform.surface" };
    rig.set ("surface", surface).choose ("friction", rubs ? "bound" : "frictionless");
    REQUIRE (rig.problem().empty());
    rig.prepare();
    return rig;
}
}   // namespace

// Long because it checks two properties of the same surface, each with its own path of the hand.
TEST_CASE ("expert 6: sliding across an edge from a soft to a stiff triangle causes no step in force and generates no energy", "[expert][deform]")
{
    test::property ("smaller position steps give smaller force steps, so the force itself has no step", [] (unsigned seed) {
        Dice dice { seed };
        const double mu = dice.uniform (0.2, 1.0);
        const auto surface = flesh (dice, mu, true);
        const double depth = dice.uniform (0.2e-3, 2e-3), turn = dice.uniform (0.0, 2.0 * M_PI), off = dice.uniform (-3e-3, 3e-3);
        const Vec3 way { std::cos (turn), std::sin (turn), 0 }, from { -off * way.y(), off * way.x(), -depth };
        const auto steepest = [&] (int n) {
            Rig rig = skin (surface, true);
            double most = 0.0;
            Vec3 before = Vec3::Zero();
            rig.input ("position", from - 0.012 * way + 0.01 * Vec3::UnitZ());
            rig.tick();
            for (int k = 0; k <= n; ++k)
            {
                const double s = 2.0 * k / n - 1.0;
                rig.input ("position", from + 0.012 * s * way);
                rig.tick();
                const Vec3 force = rig.vector ("force");
                if (s > -0.6) most = std::max (most, (force - before).norm());   // by now the contact is dragged along
                before = force;
            }
            return most;
        };
        // A steep slope shorter than a step shows up only with finer steps; a jump remains, however fine the steps are.
        double coarse = steepest (250);
        RC_ASSERT (coarse > 0.0);
        bool finer = false;
        for (int n = 1000; ! finer && n <= 16'000; n *= 4)
        {
            const double fine = steepest (n);
            finer = fine <= 0.35 * coarse;
            coarse = fine;
        }
        RC_ASSERT (finer);
    });

    test::property ("any closed path: without friction it costs no energy, with enough friction it costs some", [] (unsigned seed) {
        Dice dice { seed };
        const double mu = dice.uniform (0.6, 1.0), depth = dice.uniform (0.2e-3, 2e-3), lift = dice.uniform (-0.8, 0.8), phase = dice.uniform (0.0, 2.0 * M_PI);
        const double size[] { dice.uniform (1e-3, 0.012), dice.uniform (1e-3, 0.012) };
        const int waves[] { 1 + dice.below (3), 1 + dice.below (3), 1 + dice.below (3) };
        const auto surface = flesh (dice, mu, false);
        const auto handled = [&] (bool rubs) {
            Rig rig = skin (surface, rubs);
            constexpr int n = 1200;
            double work = 0.0, moved = 0.0;
            Vec3 p = Vec3::Zero(), before = Vec3::Zero();
            for (int k = 0; k <= n; ++k)
            {
                const double s = 2.0 * M_PI * k / n;
                const Vec3 next { size[0] * std::sin (waves[0] * s), size[1] * std::cos (waves[1] * s + phase), depth * (lift - std::cos (waves[2] * s)) };
                if (k == 0)
                {
                    rig.input ("position", next + 0.01 * Vec3::UnitZ());   // the tool comes from outside
                    rig.tick();
                }
                rig.input ("position", next);
                rig.tick();
                const Vec3 force = rig.vector ("force");
                const double step = k == 0 ? 0.0 : -0.5 * (force + before).dot (next - p);
                work += step;
                moved += std::abs (step);
                p = next;
                before = force;
            }
            return std::pair { work, moved };
        };
        const auto [glides, glided] = handled (false);
        RC_ASSERT (std::abs (glides) <= 5e-3 * glided);
        const auto [rubs, rubbed] = handled (true);
        RC_ASSERT (rubs >= -1e-3 * rubbed);
    });
}

TEST_CASE ("expert 7: a touch that follows a touch elsewhere starts without a kick", "[expert][friction][deform]")
{
    const double mu = 0.5, d_max = 2e-4, stiffness = 1000.0, rate = 1000.0;
    Sketch graph;
    graph.node ("hand", "device.position").node ("floor", "deform.plane", { { "stiffness", stiffness } });
    graph.node ("drag", "friction.elasto_plastic", { { "mu", mu }, { "d_max", d_max } }).node ("motor", "device.force");
    graph.wire ("hand.position -> floor.position").wire ("hand.position -> drag.position");
    graph.wire ("floor.resistance -> drag.normal_force").wire ("floor.force -> motor.force").wire ("drag.force -> motor.force");

    test::property ("a hand that taps in different places and drags while it is down", [&] (unsigned seed) {
        Dice dice { seed };
        const double reach = dice.uniform (0.01, 0.1), deepest = dice.size (1e-4, 1e-2);
        const double taps = dice.uniform (5.0, 20.0), strokes = dice.uniform (0.5, 3.0), phase = dice.uniform (0.0, 6.0);
        const auto path = [&] (int k) {
            const double s = 2.0 * M_PI * k / rate;
            return Vec3 { reach * std::sin (strokes * s), reach * std::cos (0.7 * strokes * s), -deepest * std::sin (taps * s + phase) };
        };
        const auto forces = test::felt (graph, path, 1000, rate);

        int touches = 0;
        for (int k = 1; k < 1000; ++k)
        {
            const auto now = static_cast<std::size_t> (k);
            const Vec3 &before = forces[now - 1], &force = forces[now], dp = path (k) - path (k - 1);
            const double depth = std::max (0.0, -path (k).z());
            RC_ASSERT (std::abs (force.z() - stiffness * depth) <= 1e-12);
            RC_ASSERT (force.head<2>().norm() <= mu * force.z() * (1.0 + 1e-9));
            if (before.z() > 0.0 || force.z() == 0.0) continue;
            ++touches;
            RC_ASSERT (force.head<2>().isZero (0.0));
            RC_ASSERT (force.norm() <= stiffness * dp.norm() * (1.0 + 1e-9));
        }
        RC_ASSERT (touches >= 3);
    });
}

TEST_CASE ("expert 8: in an existing cut the blade feels no force down to the end of the cut, and nothing ruptures again", "[expert][cut]")
{
    test::property ("any sample; tracking of the hand may be lost in between", [] (unsigned seed) {
        Dice dice { seed };
        const Potato potato { dice };
        Rig rig = potato.blade();
        const double deep = dice.uniform (2.5, 8.0) * potato.d_rupture;
        press (rig, 0.0, deep, 500);
        const double crack = rig.out ("crack");
        RC_ASSERT (crack > 0.0);

        press (rig, deep, -1e-3, 50);
        if (dice.below (2) == 0) press (rig, 0.0, not_a_number, 1);
        RC_ASSERT (press (rig, -1e-3, crack, 200).most == 0.0);
        RC_ASSERT (rig.out ("state") == 0.0);
        const auto again = press (rig, crack, crack + 2.0 * deep, 2000);
        RC_ASSERT (! again.bursts);
        RC_ASSERT (again.most <= potato.f_cut * (1.0 + 1e-6));
        RC_ASSERT (rig.out ("state") == 4.0);
    });
}

TEST_CASE ("expert 9: a blade that passes the rupture in one sample ends where a slow one would", "[expert][cut]")
{
    test::property ("any sample, any depth", [] (unsigned seed) {
        Dice dice { seed };
        const Potato potato { dice };
        Rig jumps = potato.blade(), creeps = potato.blade();
        const double deep = dice.uniform (1.001, 10.0) * potato.d_rupture;
        press (jumps, 0.0, deep, 1);
        RC_ASSERT (press (creeps, 0.0, deep, 5000).most >= 0.99 * potato.f_rupture);

        const auto same = [&] (const char* output, double scale) { RC_ASSERT (std::abs (jumps.out (output) - creeps.out (output)) <= 1e-8 * scale); };
        same ("resistance", potato.f_rupture);
        same ("crack", deep);
        same ("stored_energy", potato.f_rupture * deep);
        same ("dissipated_energy", potato.f_rupture * deep);
        RC_ASSERT (jumps.out ("state") == 2.0);
        RC_ASSERT (jumps.out ("crack") > 0.0);
    });
}
