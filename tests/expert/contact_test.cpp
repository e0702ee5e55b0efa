// SPDX-License-Identifier: MIT
// What an expert tries first: touching, leaving and coming back.

#include <expert/hands.hpp>
#include <support/rig.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck/catch.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace tactus;
using tactus::test::Dice;
using tactus::test::Sketch;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A sample that bursts open, one blade in it, and the largest force since it was last asked for.
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

    double f_cut, f_rupture, d_rupture;   // N, N, m
    Law law;
};

/// What was felt on the way.
struct Felt
{
    double most = 0.0;   // N
    bool bursts = false;
};

/// In n equal steps.
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
}   // namespace

TEST_CASE ("expert 7: a touch, and the next one elsewhere, starts without a kick", "[expert][friction][deform]")
{
    const double mu = 0.5, d_max = 2e-4, stiffness = 1000.0, rate = 1000.0;
    const auto graph = Sketch {}.node ("hand", "device.position").node ("floor", "deform.plane", { { "stiffness", stiffness } }).node ("drag", "friction.elasto_plastic", { { "mu", mu }, { "d_max", d_max } }).node ("motor", "device.force").wire ("hand.position -> floor.position").wire ("hand.position -> drag.position").wire ("floor.resistance -> drag.normal_force").wire ("floor.force -> motor.force").wire ("drag.force -> motor.force");

    rc::prop ("a hand that taps about, and drags while it is down", [&] (unsigned seed)
              {
        Dice dice { seed };
        const double reach = dice.uniform (0.01, 0.1), deepest = dice.size (1e-4, 1e-2), taps = dice.uniform (5.0, 20.0), strokes = dice.uniform (0.5, 3.0), phase = dice.uniform (0.0, 6.0);
        const auto path = [&] (int k)
        {
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
        RC_ASSERT (touches >= 3); });
}

TEST_CASE ("expert 8: in a cut that is there, the blade feels nothing down to its tip, and nothing bursts again", "[expert][cut]")
{
    rc::prop ("any sample; the hand may be lost meanwhile", [] (unsigned seed)
              {
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
        RC_ASSERT (rig.out ("state") == 4.0); });
}

TEST_CASE ("expert 9: a blade that is past rupture in one sample is where a slow one would be", "[expert][cut]")
{
    rc::prop ("any sample, any depth", [] (unsigned seed)
              {
        Dice dice { seed };
        const Potato potato { dice };
        Rig jumps = potato.blade(), creeps = potato.blade();
        const double deep = dice.uniform (1.001, 10.0) * potato.d_rupture;
        press (jumps, 0.0, deep, 1);
        RC_ASSERT (press (creeps, 0.0, deep, 5000).most >= 0.99 * potato.f_rupture);

        const auto same = [&] (const char* output, double scale)
        { RC_ASSERT (std::abs (jumps.out (output) - creeps.out (output)) <= 1e-8 * scale); };
        same ("resistance", potato.f_rupture);
        same ("crack", deep);
        same ("stored_energy", potato.f_rupture * deep);
        same ("dissipated_energy", potato.f_rupture * deep);
        RC_ASSERT (jumps.out ("state") == 2.0);
        RC_ASSERT (jumps.out ("crack") > 0.0); });
}
