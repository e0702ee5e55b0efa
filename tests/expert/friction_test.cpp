// SPDX-License-Identifier: MIT
// Tests of what an expert tries first: friction.

#include "hands.hpp"
#include <support/property.hpp>
#include <support/rig.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

using namespace tactus;
using tactus::test::Dice;
using tactus::test::Sketch;

namespace
{
constexpr std::string_view adhesions[] { "stick", "dupont", "ramp", "dahl", "curve" };
constexpr std::string_view integrators[] { "exponential", "euler" };
constexpr std::string_view passive_loads[] { "bound", "passive" };

/// A tool dragged along x by a hand whose work is summed by the trapezoid rule.
struct Drag
{
    Drag (std::string_view adhesion, std::string_view integrator, double d_max, std::string_view load = "bound")
    {
        rig.param ("d_max", d_max).choose ("adhesion", adhesion).choose ("integrator", integrator).choose ("load", load);
        rig.prepare();
        to (0.0);
    }

    /// Moves to x and returns the new deflection.
    double to (double x, double normal_force = 1.0)
    {
        const double before = force();
        rig.input ("position", x).input ("normal_force", normal_force);
        rig.tick();
        work -= 0.5 * (before + force()) * (x - p);
        p = x;
        return rig.out ("deflection");
    }

    double force() const { return rig.out ("force"); }

    Rig rig { "friction.elasto_plastic" };
    double p = 0.0, work = 0.0;   // in m, J
};

bool sameBits (double a, double b) { return std::bit_cast<std::uint64_t> (a) == std::bit_cast<std::uint64_t> (b); }
}   // namespace

TEST_CASE ("expert 1: a tool that is leaned on for a minute does not drift", "[expert][friction]")
{
    // Breakaway is at 0.4 N. The hand leans with a fraction of this and trembles at 8 Hz.
    const auto drift = [] (std::string adhesion, double lean) {
        Sketch graph;
        graph.node ("hand", "device.position");
        graph.node ("drag", "friction.elasto_plastic", { { "mu", 0.4 }, { "d_max", "0.4 mm" }, { "adhesion", adhesion } });
        graph.node ("motor", "device.force");
        graph.wire ("hand.position -> drag.position").wire ("drag.force -> motor.force");
        test::Mass tool;
        tool.hand = [=] (double t) { return lean + 0.03 * std::sin (2.0 * M_PI * 8.0 * t); };
        Engine engine { test::planOf (graph, 1000.0) };
        engine.attach ("stylus", tool);
        double settled = 0.0;
        for (int k = 0; k < 62'000; ++k)
        {
            engine.tick();
            if (k == 1999) settled = tool.x;
        }
        return tool.x - settled;
    };

    for (const double lean : { 0.02, 0.1, 0.2, 0.3, 0.35 })
        for (const std::string adhesion : { "stick", "dupont" })
        {
            if (adhesion == "dupont" && lean + 0.03 > 0.7 * 0.4) continue;   // here dupont begins to yield
            INFO (adhesion << " at " << lean << " N");
            CHECK (std::abs (drift (adhesion, lean)) < 1e-9);
        }
    CHECK (drift ("dahl", 0.2) > 1e-3);
}

TEST_CASE ("expert 2: every node gives a finite and steady response to a tool at rest", "[expert]")
{
    // A node whose force depends on position alone gives identical bits for a repeated sample. A node with memory comes to rest.
    // hold.deadbeat estimates the force of the hand, smoothed over 10 ms; after that, its two planned forces differ only by rounding.
    constexpr std::string_view timeless[] { "friction.elasto_plastic", "cut.blade", "cut.scissors", "texture.grating" };

    for (const auto& type : catalogue())
    {
        const auto tellsPlace = [] (const PortSheet& p) { return p.id == "position" || p.id == "depth" || p.id == "angle"; };
        if (std::ranges::none_of (type.inputs, tellsPlace)) continue;

        const bool in_pairs = type.info.id == "hold.deadbeat";
        DYNAMIC_SECTION (type.info.id)
        {
            test::property ("after any motion", [&] (unsigned seed) {
                Dice dice { seed };
                Rig rig { type };
                rig.prepare();
                for (double& v : rig.in)
                    if (std::isfinite (v)) v += dice.uniform (-0.1, 1.0);
                for (int k = 0; k < 20; ++k)
                {
                    for (std::size_t i = 0; i < rig.in.size(); ++i)
                        if (std::isfinite (rig.in[i]) && tellsPlace (*rig.inputs[i].port)) rig.in[i] += dice.uniform (-1.0, 1.0) * dice.size (1e-9, 1e-2);
                    rig.tick();
                }

                auto before = rig.outs();
                const auto steady = [&] {
                    rig.tick();
                    const auto now = rig.outs();
                    bool same = true;
                    for (std::size_t i = 0; i < now.size(); ++i)
                    {
                        RC_ASSERT (std::isfinite (now[i]));
                        const bool is_near = in_pairs && std::abs (now[i] - before[i]) <= 1e-9 * std::abs (now[i]);
                        const auto id = rig.outputs[i].port->id;
                        const bool flows = type.info.id == "field.viscous" && id == "dissipated_energy";   // a liquid that flows past turns energy into heat
                        same = same && (is_near || sameBits (now[i], before[i]) || id == "state" || flows);
                    }
                    before = now;
                    return same;
                };
                if (std::ranges::count (timeless, type.info.id) > 0) RC_ASSERT (steady());
                for (int k = 0; k < (in_pairs ? 5000 : 500); ++k)
                    steady();
                RC_ASSERT (steady());
            });
        }
    }
}

TEST_CASE ("expert 3: in a slow slide, neither the state nor the force chatters", "[expert][friction]")
{
    test::property ("any adhesion, either integrator, any direction, steps much smaller and much larger than d_max", [] (unsigned seed) {
        Dice dice { seed };
        const double d_max = dice.size (1e-6, 1e-2), step = dice.size (0.02, 4.0) * d_max;
        Rig rig { "friction.elasto_plastic" };
        rig.param ("d_max", d_max).choose ("adhesion", dice.of (adhesions)).choose ("integrator", dice.of (integrators));
        rig.prepare();

        const double turn = dice.uniform (0.0, 2.0 * M_PI);
        const Vec3 from { dice.uniform (-0.1, 0.1), dice.uniform (-0.1, 0.1), dice.uniform (-0.1, 0.1) };
        const Vec3 dp = step * Vec3 { std::cos (turn), std::sin (turn), 0 };
        const int settled = 25 + static_cast<int> (25.0 * d_max / step);
        double least = inf, most = 0.0;
        for (int k = 0; k < settled + 1500; ++k)
        {
            rig.input ("position", from + k * dp);
            rig.tick();
            if (k < settled) continue;
            RC_ASSERT (rig.out ("state") == 2.0);
            least = std::min (least, rig.vector ("force").norm());
            most = std::max (most, rig.vector ("force").norm());
        }
        RC_ASSERT (most - least <= 1e-8);
    });
}

TEST_CASE ("expert 4: a reversal longer than d_max within one sample does not reverse the force", "[expert][friction]")
{
    test::property ("any adhesion, either integrator, any initial deflection", [] (unsigned seed) {
        Dice dice { seed };
        const auto adhesion = dice.of (adhesions), integrator = dice.of (integrators);
        const double d_max = 1e-5, stretch = dice.uniform (0.05, 0.95) * d_max;
        Drag drag (adhesion, integrator, d_max);
        double d = 0.0;
        for (int k = 0; k < 5000 && d > -stretch; ++k)
            d = drag.to (drag.p - 1e-3 * d_max);
        RC_ASSERT (d <= -stretch);

        const double dp = std::abs (d) + dice.size (0.01, 3.0) * d_max;
        const double after = drag.to (drag.p + dp);
        RC_ASSERT (after >= 0.0);
        RC_ASSERT (after <= d_max * (1.0 + 1e-9));
        RC_ASSERT (drag.force() <= 0.0);
        if (adhesion == "dahl" && integrator == "exponential")
            RC_ASSERT (std::abs (after / d_max - (1.0 - (1.0 - d / d_max) * std::exp (-dp / d_max))) < 1e-12);
        if (adhesion == "stick") RC_ASSERT (std::abs (after - std::min (d + dp, d_max)) < 1e-12 * d_max);
    });
}

TEST_CASE ("expert 5: a cycle of pressing, shearing and lifting generates no energy", "[expert][friction]")
{
    test::property ("any adhesion and integrator, any closed path of position and load", [] (unsigned seed) {
        Dice dice { seed };
        const auto adhesion = dice.of (adhesions), integrator = dice.of (integrators), rule = dice.of (passive_loads);
        const double d_max = 1e-4, reach = dice.size (0.1, 10.0) * d_max, press = dice.uniform (0.5, 3.0), lift = dice.uniform (0.0, 1.2) * press;
        const int waves = 1 + dice.below (4);
        const double phase = dice.uniform (0.0, 2.0 * M_PI);
        Drag drag (adhesion, integrator, d_max, rule);
        for (int k = 0; k <= 4000; ++k)
        {
            const double s = 2.0 * M_PI * k / 2000.0;
            drag.to (reach * std::sin (s), press + lift * std::sin (waves * s + phase));
        }
        RC_ASSERT (drag.work >= -1e-12);
    });

    // With the published rule, in which the whole force follows the load, the same path generates energy, and the node does not
    // claim to be passive.
    const auto strokes = [] (std::string_view load) {
        Drag drag ("stick", "exponential", 1e-4, load);
        for (int loop = 0; loop < 10; ++loop)
            for (int k = 0; k < 400; ++k)
            {
                const double way = (k % 100) / 100.0;
                const double x[] { way, 1.0, 1.0 - way, 0.0 }, f[] { 0.5, 0.5 + 2.5 * way, 3.0, 3.0 - 2.5 * way };
                drag.to (0.8e-4 * x[k / 100], f[k / 100]);
            }
        return drag;
    };
    for (const auto load : passive_loads)
    {
        CHECK (strokes (load).work > 0.0);
        CHECK (strokes (load).rig.claims().passive);
    }
    CHECK (strokes ("scale").work < -1e-4);
    CHECK_FALSE (strokes ("scale").rig.claims().passive);
}
