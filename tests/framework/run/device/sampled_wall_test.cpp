// SPDX-License-Identifier: MIT
// The effect of a wall computed from samples on a hand, through the whole loop: device, graph, guard, device.

#include <support/property.hpp>
#include <tactus/run/device/sim.hpp>

#include <expert/hands.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace tactus;
using tactus::test::Dice;
using tactus::test::Sketch;

namespace
{
/// A tool pressed against a wall at x > 0.
struct Press
{
    Sketch graph;
    SimulatedDevice tool;
    Engine engine;

    Press (Json wall, Simulation simulation, double rate_hz, Json law = Json::object())
        : graph (sketch (std::move (wall), std::move (law))), tool (std::move (simulation)),
          engine (test::planOf (graph, rate_hz, { .records = { "wall.resistance" } }))
    {
        engine.attach ("stylus", tool);
    }

    static Sketch sketch (Json wall, Json settings)
    {
        wall["normal"] = { -1, 0, 0 };
        Sketch s;
        s.node ("hand", "device.position").node ("wall", "deform.plane", std::move (wall), std::move (settings)).node ("motor", "device.force");
        return s.wire ("hand.position -> wall.position").wire ("wall.force -> motor.force");
    }

    double x() { return tool.read().true_position.x(); }
    double v() { return tool.read().true_velocity.x(); }
    double force() { return *engine.plan().taps()[0].value; }
};

/// The residual motion of the tool in the last fifth of twenty seconds, pressed with 0.5 N, at 1 kHz.
double restlessness (double stiffness, int delay)
{
    Press press ({ { "stiffness", stiffness } },
                 { .mass = 0.1, .damping = 2.0, .delay = delay, .position = { -1e-3, 0, 0 }, .velocity = { 0.1, 0, 0 }, .hand_force = { 0.5, 0, 0 } }, 1000.0);
    double low = inf, high = -inf;
    for (int k = 0; k < 20'000; ++k)
    {
        press.engine.tick();
        if (k < 16'000) continue;
        low = std::min (low, press.x());
        high = std::max (high, press.x());
    }
    return high - low;
}

/// Hunt and Crossley's coefficient of restitution e, where x is dissipation times impact speed: the root of x - ln (1 + x) = -x e - ln (1 - x e).
double restitution (double x)
{
    double low = 0.0, high = std::min (1.0, 1.0 / x);
    for (int i = 0; i < 200; ++i)
    {
        const double e = 0.5 * (low + high);
        (x - std::log1p (x) + x * e + std::log1p (-x * e) > 0.0 ? low : high) = e;
    }
    return low;
}
}   // namespace

TEST_CASE ("sampled wall: up to 0.9 times 2 b / ((2 d + 1) T) the tool comes to rest, and at 1.3 times it buzzes", "[host][devices][deform]")
{
    for (const int delay : { 0, 1, 2, 5 })
    {
        const double limit = 2.0 * 2.0 / ((2 * delay + 1) * 1e-3);
        INFO (delay << " ticks, " << limit << " N/m");
        CHECK (restlessness (0.5 * limit, delay) < 1e-17);
        CHECK (restlessness (0.9 * limit, delay) < 1e-9);   // the motion still decays, by a factor of a thousand in seven seconds
        CHECK (restlessness (1.05 * limit, delay) > 1e-4);
        CHECK (restlessness (1.3 * limit, delay) > 3.9e-4);
        CHECK (restlessness (1.3 * limit, delay) < 1e-2);
    }
}

TEST_CASE ("sampled wall: at a high rate, a mass rebounds according to Hunt and Crossley's law", "[host][devices][deform][energy]")
{
    CHECK (restitution (0.15) == Approx (0.909016).epsilon (1e-6));
    CHECK (restitution (1.0) == Approx (0.593624).epsilon (1e-6));
    CHECK (restitution (5.0) == Approx (0.196980).epsilon (1e-5));

    test::property ("any mass, law, speed and dissipation: speed of the rebound, and area of the loop of force against depth", [] (unsigned seed) {
        Dice dice { seed };
        const double m = dice.size (0.01, 0.5), v = dice.size (0.05, 1.0), d_max = v * dice.size (2e-3, 1e-2), n = dice.uniform (1.0, 2.0),
                     x = dice.size (0.05, 5.0);
        const double k = 0.5 * (n + 1.0) * m * v * v / std::pow (d_max, n + 1.0), rate = 2000.0 * v / d_max, e = restitution (x);
        Press press ({ { "dissipation", x / v } },
                     { .mass = m, .damping = 0.0, .position = { -0.4 * v / rate, 0, 0 }, .velocity = { v, 0, 0 } }, rate,
                     { { "law", { { "power", { k, n } } } } });

        double loop = 0.0, f = 0.0, at = press.x();
        do
        {
            const double now = press.x(), before = f;
            press.engine.tick();
            f = press.force();
            loop += 0.5 * (before + f) * (now - at);
            at = now;
        } while (at > 0.0 || press.v() > 0.0);

        RC_ASSERT (std::abs (-press.v() / v - e) < 1e-3);
        RC_ASSERT (std::abs (loop / (0.5 * m * v * v) - (1.0 - e * e)) < 2e-3);
    });
}
