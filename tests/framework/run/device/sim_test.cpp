// SPDX-License-Identifier: MIT
#include <tactus/run/device/sim.hpp>

#include <golden/golden.hpp>
#include <support/no_allocation.hpp>
#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

using namespace tactus;

namespace
{
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

Effort pushing (const Vec3& force) { return { .force = force }; }

SimulatedDevice prepared (Simulation simulation, double dt = 1e-3)
{
    SimulatedDevice device (std::move (simulation));
    device.prepare (dt);
    return device;
}

double energy (const Simulation& sim, const Reading& now) { return 0.5 * sim.mass * now.true_velocity.squaredNorm(); }

rc::Gen<double> within (double low, double high)
{
    return rc::gen::map (rc::gen::inRange (0, 1'000'001), [=] (int i) { return low + (high - low) * 1e-6 * i; });
}

Vec3 anyVector (double reach)
{
    const double x = *within (-reach, reach), y = *within (-reach, reach), z = *within (-reach, reach);
    return { x, y, z };
}
}   // namespace

TEST_CASE ("sim: a hand of infinite stiffness takes the tool along its path, whatever the force", "[host][devices]")
{
    const auto path = std::make_shared<GesturePath> (*findGesture ("stroke"), Placement {});
    const double first_mode = GENERATE (0.0, 30.0);
    Simulation what { .first_mode = first_mode, .position = path->at (0.0).position };
    what.hand = { .stiffness = std::numeric_limits<double>::infinity(), .damping = 1.0, .path = path };
    constexpr double dt = 1e-3;
    auto device = prepared (what, dt);
    for (int k = 0; k < 500; ++k)
    {
        const auto now = device.read();
        const auto there = path->at (k * dt);
        REQUIRE (Vec3 (now.position) == there.position);
        if (k > 0) REQUIRE (now.true_velocity == there.velocity);
        device.write (pushing (Vec3 (0.0, 1.0, 5.0)));
    }
}

TEST_CASE ("sim: an axis in addition to the tool moves like a mass on a spring", "[host][devices]")
{
    // Critically damped: m x'' + b x' + k x = f, from rest, with b = 2 sqrt (k m).
    constexpr double mass = 0.05, stiffness = 80.0, force = 2.0, dt = 1e-4;
    SimulatedDevice device ({ .axes = { { .name = "rest" }, { .name = "trigger", .mass = mass, .damping = 4.0, .stiffness = stiffness, .position = 0.01 } } });
    device.prepare (dt);
    Effort push;
    push.axes.set (1, force);
    for (int k = 0; k < 2000; ++k)
    {
        const double t = k * dt, w = std::sqrt (stiffness / mass);
        const auto axes = device.read().axes;
        REQUIRE (axes[1] - 0.01 == Approx (force / stiffness * (1.0 - (1.0 + w * t) * std::exp (-w * t))).margin (1e-4));
        REQUIRE (axes[0] == 0.0);
        device.write (push);
    }
    push.axes.set (1, std::numeric_limits<double>::quiet_NaN());
    device.write (push);
    CHECK (std::isfinite (device.read().axes[1]));
    device.prepare (dt);
    CHECK (device.read().axes[1] == 0.01);
}

TEST_CASE ("sim: against a wall, the tool follows the exact solution of the sampled loop", "[host][devices]")
{
    const test::Golden golden ("wallsim");
    const auto [name, stiffness_share, damping_share, is_quantised] = GENERATE (table<std::string, double, double, bool> ({
        { "smooth", 1.0, 0.0, false },
        { "quant", 0.5, 0.0, true },
        { "damped", 0.5, 0.2, false },
    }));
    const double stiffness = stiffness_share * golden.param ("K"), damping = damping_share * golden.param ("B"), dt = golden.dt_s();

    auto device = prepared ({ .mass = golden.param ("M"),
                              .damping = golden.param ("B"),
                              .quantum = is_quantised ? golden.param ("quantum") : 0.0,
                              .position = { golden.param ("x0"), 0, 0 },
                              .velocity = { golden.param ("v0"), 0, 0 },
                              .hand_force = { golden.param ("hand_force"), 0, 0 } },
                            dt);

    // At half a quantum, the last bit of a position decides how it is rounded, so the golden set allows a micrometre.
    const double x_tolerance = is_quantised ? 1e-6 : golden.tolerance ("x_"), v_tolerance = golden.tolerance ("v_");
    double before = device.read().position.x(), x_error = 0.0, v_error = 0.0;

    for (std::size_t k = 0; k < 300; ++k)
    {
        const auto now = device.read();
        x_error = std::max (x_error, std::abs (now.true_position.x() - golden (k, "x_" + name)));
        v_error = std::max (v_error, std::abs (now.true_velocity.x() - golden (k, "v_" + name)));

        const double x = now.position.x();
        const double push = x > 0.0 ? std::min (0.0, -stiffness * x - damping * (x - before) / dt) : 0.0;
        device.write (pushing ({ push, 0, 0 }));
        before = x;
    }

    CAPTURE (name, x_error, v_error);
    CHECK (x_error <= x_tolerance);
    CHECK (v_error <= v_tolerance);
}

TEST_CASE ("sim: a constant force moves the tool equally at every rate", "[host][devices]")
{
    const double damping = GENERATE (0.0, 1e-9, 0.02, 1.0, 50.0, 2000.0);
    const Simulation sim { .mass = 0.05, .damping = damping, .velocity = { 0.1, -0.2, 0.3 }, .hand_force = { 0.5, 0.1, -0.2 } };

    auto slow = prepared (sim, 1e-3), fast = prepared (sim, 0.25e-3);
    for (int k = 0; k < 1000; ++k)
        slow.write ({});
    for (int k = 0; k < 4000; ++k)
        fast.write ({});

    const auto a = slow.read(), b = fast.read();
    CHECK ((a.true_position - b.true_position).norm() <= 1e-12 * std::max (1.0, a.true_position.norm()));
    CHECK ((a.true_velocity - b.true_velocity).norm() <= 1e-12 * std::max (1.0, a.true_velocity.norm()));
}

TEST_CASE ("sim: motion under a constant force follows the differential equation", "[host][devices]")
{
    const double mass = 0.05, damping = GENERATE (1e-7, 0.3, 7.0), force = 0.4, t = 0.8;
    auto device = prepared ({ .mass = mass, .damping = damping, .hand_force = { force, 0, 0 } });
    for (int k = 0; k < 800; ++k)
        device.write ({});

    const double tau = mass / damping, lag = -tau * std::expm1 (-t / tau);
    CHECK (device.read().true_velocity.x() == Approx (force / damping * lag / tau).epsilon (1e-11));
    CHECK (device.read().true_position.x() == Approx (damping < 1e-6 ? 0.5 * force / mass * t * t : force / damping * (t - lag)).epsilon (1e-5));
}

TEST_CASE ("sim: with the tiniest damping, the tool moves as without damping", "[host][devices]")
{
    const double damping = GENERATE (5e-324, 1e-100, 1e-18, 1e-13);
    auto none = prepared ({ .damping = 0.0, .velocity = { 1, 2, 3 }, .hand_force = { 1, 0, 0 } });
    auto tiny = prepared ({ .damping = damping, .velocity = { 1, 2, 3 }, .hand_force = { 1, 0, 0 } });

    for (int k = 0; k < 1000; ++k)
    {
        none.write ({});
        tiny.write ({});
    }
    CHECK ((none.read().true_position - tiny.read().true_position).norm() < 1e-11);
    CHECK ((none.read().true_velocity - tiny.read().true_velocity).norm() < 1e-11);
}

TEST_CASE ("sim: the step has no seam between small and large damping", "[host][devices]")
{
    // At B T/M = 1/4 the closed form takes over from a series.
    const auto after = [] (double h) {
        auto device = prepared ({ .mass = 1.0, .damping = h * 1e3 });
        device.write (pushing ({ 1.0, 0, 0 }));
        return device.read().true_position.x();
    };
    CHECK (after (0.25) == Approx (after (std::nextafter (0.25, 1.0))).epsilon (1e-14));
}

TEST_CASE ("sim: left alone, a damped tool loses energy on every tick", "[host][devices]")
{
    test::property ("any mass, damping and speed", [] {
        const Simulation sim { .mass = *within (1e-3, 2.0), .damping = *within (1e-3, 50.0), .velocity = anyVector (2.0) };
        auto device = prepared (sim);
        for (int k = 0; k < 50; ++k)
        {
            const double before = energy (sim, device.read());
            device.write ({});
            RC_ASSERT (energy (sim, device.read()) <= before);
        }
    });
}

TEST_CASE ("sim: without damping, momentum equals the impulse of the force", "[host][devices]")
{
    test::property ("any mass, any forces", [] {
        const Simulation sim { .mass = *within (1e-3, 2.0), .damping = 0.0, .velocity = anyVector (2.0) };
        auto device = prepared (sim);
        Vec3 momentum = sim.mass * sim.velocity;
        for (int k = 0; k < 50; ++k)
        {
            const Vec3 force = anyVector (10.0);
            momentum += 1e-3 * force;
            device.write (pushing (force));
            RC_ASSERT ((sim.mass * device.read().true_velocity - momentum).norm() < 1e-12);
        }
    });
}

TEST_CASE ("sim: the reported position is rounded half up to the quantum, but the true position is not", "[host][devices]")
{
    const auto seen = [] (double x) { return prepared ({ .quantum = 1e-5, .position = { x, 0, 0 } }).read(); };

    CHECK (seen (0.49e-5).position.x() == 0.0);
    CHECK (seen (0.5e-5).position.x() == 1e-5);
    CHECK (seen (-0.5e-5).position.x() == 0.0);
    CHECK (seen (-0.51e-5).position.x() == -1e-5);
    CHECK (seen (1.23456e-3).true_position.x() == 1.23456e-3);
}

TEST_CASE ("sim: a force smaller than half its quantum has no effect", "[host][devices]")
{
    auto device = prepared ({ .force_quantum = 0.01 });
    device.write (pushing ({ 0.0049, 0.0051, -0.0149 }));

    const Vec3 v = device.read().true_velocity;
    CHECK (v.x() == 0.0);
    CHECK (v.y() == Approx (-v.z()));
    CHECK (v.y() > 0.0);
}

TEST_CASE ("sim: with a delay of d ticks, the force from d ticks ago acts on the tool, and zero before that", "[host][devices]")
{
    const int delay = GENERATE (0, 1, 2, 7);
    auto late = prepared ({ .delay = delay }), now = prepared ({});

    for (int k = 0; k < 30; ++k)
    {
        const Vec3 force { std::sin (0.3 * k), 0, 1 };
        late.write (pushing (force));
        if (k < delay)
            CHECK (late.read().true_velocity.isZero (0.0));
        else
        {
            now.write (pushing ({ std::sin (0.3 * (k - delay)), 0, 1 }));
            CHECK (late.read().true_position == now.read().true_position);
        }
    }
}

TEST_CASE ("sim: each tick of delay reduces the stiffness that a wall can have", "[host][devices]")
{
    // A tool is released 1 mm deep in a two-sided spring, at 1 kHz. The limits are within 3 % of 2b/((2d+1) T) for d = 0, 1, 2.
    const auto [delay, limit] = GENERATE (table<int, double> ({ { 0, 4110.0 }, { 1, 1357.0 }, { 2, 817.0 } }));
    const auto swing = [d = delay] (double stiffness) {
        auto device = prepared ({ .mass = 0.1, .damping = 2.0, .delay = d, .position = { 1e-3, 0, 0 } });
        double largest = 0.0;
        for (int k = 0; k < 4000; ++k)
        {
            const double x = device.read().position.x();
            if (k >= 3000) largest = std::max (largest, std::abs (x));
            device.write (pushing ({ -stiffness * x, 0, 0 }));
        }
        return largest;
    };

    CHECK (swing (0.95 * limit) < 1e-3);
    CHECK (swing (1.05 * limit) > 1e-3);
}

TEST_CASE ("sim: the hand carries the tool along a gesture with a small lag", "[host][devices]")
{
    const auto& stroke = *findGesture ("stroke");
    const auto path = std::make_shared<GesturePath> (stroke, Placement { .offset = { 0, 0.1, 0 } });
    auto device = prepared ({ .mass = 0.05, .damping = 0.5, .position = path->at (0).position, .hand = { 100.0, 2.0, path } });

    double furthest = 0.0;
    for (int k = 0; k < 4000; ++k)
    {
        furthest = std::max (furthest, (device.read().true_position - path->at (k * 1e-3).position).norm());
        device.write ({});
    }
    CHECK (furthest < 3e-3);
    CHECK (furthest > 1e-5);
    CHECK (device.duration() == stroke.duration_s);
}

TEST_CASE ("sim: a force that is not a number does no harm", "[host][devices]")
{
    auto poisoned = prepared ({ .force_quantum = 0.01, .delay = 1, .hand_force = { 0.1, 0, 0 } });
    auto spared = prepared ({ .force_quantum = 0.01, .delay = 1, .hand_force = { 0.1, 0, 0 } });

    for (int k = 0; k < 20; ++k)
    {
        poisoned.write (pushing ({ 1, k % 5 == 0 ? not_a_number : 2.0, k % 7 == 0 ? 1.7e308 : 0.0 }));
        spared.write (k % 5 == 0 || k % 7 == 0 ? Effort {} : pushing ({ 1, 2, 0 }));
    }
    CHECK (poisoned.read().valid);
    CHECK (poisoned.read().true_position == spared.read().true_position);
}

TEST_CASE ("sim: preparing it again restarts it", "[host][devices]")
{
    auto device = prepared ({ .delay = 2, .position = { 0, 0, 0.01 }, .hand = { 100, 2, std::make_shared<GesturePath> (*findGesture ("tap"), Placement()) } });
    const auto run = [&] {
        for (int k = 0; k < 100; ++k)
            device.write (pushing ({ 1, 0, 0 }));
        return device.read().true_position;
    };

    const Vec3 first = run();
    device.prepare (1e-3);
    CHECK (device.read().true_position == Vec3 (0, 0, 0.01));
    CHECK (run() == first);
}

TEST_CASE ("sim: the rotation is constant, and a torque has no effect", "[host][devices]")
{
    auto device = prepared ({ .rotation = { 0.1, 0.2, 0.3 } });
    device.write ({ .torque = { 5, 5, 5 } });

    CHECK (device.read().rotation == Vec3 (0.1, 0.2, 0.3));
    CHECK (device.read().true_position.isZero (0.0));
}

TEST_CASE ("sim: the tick allocates nothing and takes no lock", "[host][devices]")
{
    const auto path = std::make_shared<GesturePath> (*findGesture ("hold"), Placement());
    auto device = prepared ({ .quantum = 1e-5, .force_quantum = 0.01, .delay = 3, .hand = { 100, 2, path } });

    const NoAllocation watch;
    for (int k = 0; k < 1000; ++k)
        device.write (pushing (-100.0 * device.read().position));
    CHECK (watch.allocations() == 0);
    CHECK (watch.locks() == 0);
}
