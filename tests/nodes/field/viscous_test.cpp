// SPDX-License-Identifier: MIT
#include <tactus/nodes/field/viscous.hpp>

#include <support/property.hpp>
#include <tactus/check/factors.hpp>
#include <tactus/run/device/sim.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using tactus::Position;
using tactus::SimulatedDevice;
using tactus::Vec3;
using tactus::nodes::Viscous;

namespace
{
/// The drag at a steady speed along x.
double dragAt (const Viscous::Params& params, double speed, double rate = 1000.0, double window = 0.0)
{
    Viscous node;
    node.params = params;
    node.settings.window = window;
    node.prepare ({ .rate_hz = rate });
    double drag = 0.0;
    for (int k = 0; k < 200; ++k)
        drag = -node.tick ({ .position = { speed * k / rate, 0, 0 } }).force.x();
    return drag;
}

/// The largest speed of a tool in a liquid over the second half of some ticks, after a nudge.
double swing (double linear, double mass, double damping)
{
    SimulatedDevice tool ({ .mass = mass, .damping = damping, .velocity = { 1e-3, 0, 0 } });
    Viscous node;
    node.params = { .linear = linear, .max_damping = tactus::inf };
    node.prepare ({ .rate_hz = 1000.0 });
    tool.prepare (1e-3);
    double largest = 0.0;
    for (int k = 0; k < 4000; ++k)
    {
        const auto now = tool.read();
        if (k >= 2000) largest = std::max (largest, now.true_velocity.norm());
        tool.write ({ .force = node.tick ({ .position = now.position }).force });
    }
    return largest;
}
}   // namespace

TEST_CASE ("viscous: the drag is linear plus quadratic, up to the largest slope", "[nodes][field][viscous]")
{
    CHECK (dragAt ({ .linear = 3.0 }, 0.2) == Approx (0.6));
    CHECK (dragAt ({ .linear = 0.0, .quadratic = 5.0, .max_damping = 100.0 }, 0.2) == Approx (0.2));
    CHECK (dragAt ({ .linear = 2.0, .quadratic = 5.0, .max_damping = 100.0 }, 0.2) == Approx (0.6));
    CHECK (dragAt ({ .linear = 2.0, .quadratic = 5.0, .max_damping = 4.0 }, 0.5) == Approx (0.6 + 0.3 * 4.0));   // straight from 0.2 m/s on
    CHECK (dragAt ({ .linear = 20.0, .max_damping = 4.0 }, 0.5) == Approx (2.0));

    tactus::test::property ("its slope is never below `linear` nor above `max_damping`", [] (unsigned seed) {
        std::mt19937 random (seed);
        std::uniform_real_distribution<double> uniform;
        const double b = 10.0 * uniform (random), most = b + 10.0 * uniform (random), v = 2.0 * uniform (random), more = 1e-3 + uniform (random);
        const Viscous::Params params { .linear = b, .quadratic = 30.0 * uniform (random), .max_damping = most };
        const double slope = (dragAt (params, v + more) - dragAt (params, v)) / more;
        RC_ASSERT (slope >= b * (1.0 - 1e-6) - 1e-9);
        RC_ASSERT (slope <= most * (1.0 + 1e-6) + 1e-9);
    });
}

TEST_CASE ("viscous: a tool that a force pulls comes to the speed at which the drag is the force", "[nodes][field][viscous]")
{
    const double pull = 0.5, b = 2.0, c = 3.0;
    for (const double rate : { 1000.0, 4000.0, 20'000.0 })
    {
        SimulatedDevice tool ({ .mass = 0.1, .damping = 0.0, .hand_force = { pull, 0, 0 } });
        Viscous node;
        node.params = { .linear = b, .quadratic = c };
        node.prepare ({ .rate_hz = rate });
        tool.prepare (1.0 / rate);
        for (int k = 0; k < 2.0 * rate; ++k)
            tool.write ({ .force = node.tick ({ .position = tool.read().position }).force });
        INFO (rate);
        CHECK (tool.read().true_velocity.x() == Approx ((std::sqrt (b * b + 4.0 * c * pull) - b) / (2.0 * c)).epsilon (1e-6));
    }
}

TEST_CASE ("viscous: a liquid at rest only brakes, and takes exactly the work of the hand", "[nodes][field][viscous][energy]")
{
    tactus::test::property ("any path, quantum, window, rate and amount", [] (unsigned seed) {
        std::mt19937 random (seed);
        std::uniform_real_distribution<double> uniform;
        std::normal_distribution<double> gauss;
        const double quantum = uniform (random) < 0.5 ? 0.0 : 1e-5, rate = 500.0 * std::pow (40.0, uniform (random));
        Viscous node;
        node.params = { .linear = 10.0 * uniform (random), .quadratic = 20.0 * uniform (random), .max_damping = 20.0 };
        node.settings.window = uniform (random) < 0.3 ? 0.0 : 0.02 * uniform (random);
        node.prepare ({ .rate_hz = rate });
        Vec3 p = Vec3::Zero(), v = Vec3::Zero(), before = Vec3::Zero();
        double work = 0.0, heat = 0.0;
        for (int k = 0; k < 1000; ++k)
        {
            v = 0.98 * v + 0.05 * Vec3 { gauss (random), gauss (random), gauss (random) };
            p += v / rate;
            const Vec3 at = quantum > 0.0 ? Vec3 { quantum * (p / quantum).array().floor().matrix() } : p;
            const auto out = node.tick ({ .position = at, .amount = 2.0 * uniform (random) - 0.5 });
            const Vec3 way = k > 0 ? Vec3 { at - before } : Vec3::Zero();
            RC_ASSERT (out.force.dot (way) <= 1e-15 * out.force.norm() * way.norm());
            RC_ASSERT (out.dissipated_energy >= heat);
            work -= out.force.dot (way);
            heat = out.dissipated_energy;
            before = at;
            RC_ASSERT (std::abs (work - heat) <= 1e-12 * work);
        }
    });
}

TEST_CASE ("viscous: a flow takes the tool along, and a tool that goes with it feels nothing", "[nodes][field][viscous]")
{
    const Vec3 flow { 0.1, -0.2, 0.05 };
    Viscous node;
    node.prepare ({ .rate_hz = 1000.0 });
    for (int k = 0; k < 5; ++k)
        CHECK ((node.tick ({ .position = { 1, 2, 3 }, .flow = flow }).force - 2.0 * flow).norm() < 1e-15);

    for (int k = 0; k < 100; ++k)
    {
        const auto out = node.tick ({ .position = 1e-3 * k * flow, .flow = flow });
        if (k > 0) CHECK (out.force.norm() < 1e-12);
    }

    // Held in a flow, the liquid turns all the work of the flow into heat.
    Viscous held;
    held.prepare ({ .rate_hz = 1000.0 });
    double heat = 0.0;
    for (int k = 0; k < 1000; ++k)
        heat = held.tick ({ .flow = flow }).dissipated_energy;
    CHECK (heat == Approx (2.0 * flow.squaredNorm()));
}

TEST_CASE ("viscous: outside of the liquid there is no force, and `amount` is the share of it", "[nodes][field][viscous]")
{
    for (const double amount : { -1.0, 0.0, 0.25, 1.0, 7.0 })
    {
        Viscous node;
        node.prepare ({ .rate_hz = 1000.0 });
        node.tick ({ .amount = amount });
        const auto out = node.tick ({ .position = { 1e-4, 0, 0 }, .amount = amount });
        const double share = std::clamp (amount, 0.0, 1.0);
        CHECK (out.force.x() == Approx (-0.2 * share));
        CHECK (out.state == (share > 0.0 ? 1.0 : 0.0));
    }
}

TEST_CASE ("viscous: a steady speed is felt the same at every rate and window", "[nodes][field][viscous]")
{
    for (const double rate : { 1000.0, 4000.0, 20'000.0 })
        for (const double window : { 0.0, 2e-3, 5e-3 })
            CHECK (dragAt ({ .linear = 2.0, .quadratic = 3.0 }, 0.15, rate, window) == Approx (0.3 + 3.0 * 0.15 * 0.15));
}

TEST_CASE ("viscous: beyond the limit of a virtual damper a tool swings, below it comes to rest", "[nodes][field][viscous]")
{
    const double mass = 0.1, damping = 2.0, limit = tactus::check::largestDamper (mass, damping, 1e-3);
    CHECK (limit == Approx (202.68).epsilon (1e-4));
    CHECK (swing (0.99 * limit, mass, damping) < 1e-6);
    CHECK (swing (1.01 * limit, mass, damping) > 1.0);
}

TEST_CASE ("viscous: its claims hold", "[nodes][field][viscous]")
{
    Viscous node;
    CHECK (node.claims().passive);
    CHECK (node.claims().damping == 2.0);
    node.params.max_damping = 1.5;
    CHECK (node.claims().damping == 1.5);
}
