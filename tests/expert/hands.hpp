// SPDX-License-Identifier: MIT
#pragma once

#include <support/sketch.hpp>
#include <tactus/run/engine.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

/// Helpers for these tests: random numbers, simulated hands that move the tool, and the forces on them.
namespace tactus::test
{

/// Generates random numbers; the seed determines the whole run.
class Dice
{
public:
    explicit Dice (unsigned seed) : random (seed) {}

    double uniform (double from, double to) { return std::uniform_real_distribution { from, to }(random); }
    double size (double from, double to) { return std::exp (uniform (std::log (from), std::log (to))); }
    int below (int n) { return std::uniform_int_distribution { 0, n - 1 }(random); }

    template <typename List>
    const auto& of (const List& list)
    {
        return list[static_cast<std::size_t> (below (static_cast<int> (std::size (list))))];
    }

private:
    std::mt19937 random;
};

/// A tool that follows a path whatever the force, and records its forces.
class Led final : public Device
{
public:
    explicit Led (std::function<Reading (int)> way) : at (std::move (way)) {}
    explicit Led (std::function<Vec3 (int)> path)
        : Led ([path = std::move (path)] (int k) { return Reading { .position = path (k) }; })
    {
    }

    void prepare (double) override {}
    Reading read() noexcept override { return at (static_cast<int> (forces.size())); }
    void write (const Effort& effort) noexcept override { forces.push_back (effort.force); }

    std::vector<Vec3> forces;   ///< in N, one per tick

private:
    std::function<Reading (int)> at;
};

/// A free mass with a damper, pushed by a hand along x. Each force is held for a tick and the motion is solved exactly.
class Mass final : public Device
{
public:
    double mass = 0.1, damping = 2.0, quantum = 0.0;    // in kg, N s/m, m
    double x = 0.0, v = 0.0;                            // in m, m/s
    std::function<double (double)> hand = [] (double)   // force in N at a time in s
    { return 0.0; };

    void prepare (double dt_s) override { dt = dt_s; }

    Reading read() noexcept override { return { .position = { quantum > 0.0 ? quantum * std::floor (x / quantum + 0.5) : x, 0, 0 } }; }

    void write (const Effort& effort) noexcept override
    {
        const double a = std::exp (-damping * dt / mass), g = mass * (1.0 - a) / damping;
        const double force = effort.force.x() + hand (ticks++ * dt);
        x += g * v + (dt - g) / damping * force;
        v = a * v + (1.0 - a) / damping * force;
    }

private:
    double dt = 1e-3;
    int ticks = 0;
};

/// A graph that is ready to run; fails the test if it does not compile.
inline std::shared_ptr<Plan> planOf (const Sketch& sketch, double rate_hz, CompileOptions options = {})
{
    options.rate_hz = rate_hz;
    auto compiled = sketch.compile (options);
    std::erase_if (compiled.messages, [] (const Message& m) { return m.id == "param/unusual"; });   // experts try what is unusual
    INFO (text (compiled.messages));
    REQUIRE (compiled.plan);
    REQUIRE (compiled.messages.empty());
    return compiled.plan;
}

/// The force on each tick of a path.
inline std::vector<Vec3> felt (const Sketch& sketch, std::function<Vec3 (int)> path, int ticks, double rate_hz = 1000.0)
{
    Engine engine { planOf (sketch, rate_hz) };
    Led hand { std::move (path) };
    engine.attach ("stylus", hand);
    for (int k = 0; k < ticks; ++k)
        engine.tick();
    return hand.forces;
}

}   // namespace tactus::test
