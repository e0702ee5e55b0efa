// SPDX-License-Identifier: MIT
#include <tactus/run/device/flexible_tool.hpp>
#include <tactus/run/device/rigid_tool.hpp>
#include <tactus/run/device/sim.hpp>

#include <golden/golden.hpp>
#include <support/no_allocation.hpp>
#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace tactus;

namespace
{
using Properties = FlexibleTool::Properties;

double between (double low, double high) { return low + (high - low) * 1e-6 * *rc::gen::inRange (0, 1'000'001); }
Vec3 alongX (double x) { return { x, 0, 0 }; }

Properties anyTool (bool is_dry)
{
    Properties p;
    p.motor_mass = between (0.01, 0.2);
    p.end_mass = between (0.01, 0.2);
    p.damping = between (0.0, 4.0);
    p.coulomb = is_dry ? between (0.01, 1.0) : 0.0;
    p.first_mode_hz = between (10.0, 600.0);
    p.first_mode_damping = between (0.0, 0.5);
    return p;
}

/// The times at which a sampled signal rises through 0.
std::vector<double> risesOf (const std::vector<double>& samples, double dt)
{
    std::vector<double> times;
    for (std::size_t i = 1; i < samples.size(); ++i)
        if (samples[i - 1] < 0.0 && samples[i] >= 0.0)
            times.push_back (dt * (static_cast<double> (i) - samples[i] / (samples[i] - samples[i - 1])));
    return times;
}
}   // namespace

TEST_CASE ("flexible tool: it follows an independent integration, phase by phase", "[host][devices][golden]")
{
    const test::Golden golden ("flexible_tool");
    for (const std::string name : { "soft", "stiff", "heavy" })
    {
        INFO (name);
        const auto given = [&] (const char* what) { return golden.param (std::string (what) + "_" + name); };
        FlexibleTool tool ({ .motor_mass = given ("M") - given ("end_mass"),
                             .end_mass = given ("end_mass"),
                             .damping = given ("B"),
                             .coulomb = given ("coulomb"),
                             .first_mode_hz = given ("F0"),
                             .first_mode_damping = given ("zeta") },
                           golden.dt_s());
        tool.start (alongX (given ("x")), alongX (given ("v")));

        std::vector<FlexibleTool::Axis> path;
        for (std::size_t i = 0; i < golden.rows(); ++i)
        {
            path.push_back (tool.axis (0));
            tool.step (alongX (golden (i, "motor")), alongX (golden (i, "hand")));
        }
        CHECK (golden.worst ("x_" + name, [&] (std::size_t i) { return path[i].x; }) <= 1.0);
        CHECK (golden.worst ("v_" + name, [&] (std::size_t i) { return path[i].v; }) <= 1.0);
        CHECK (golden.worst ("s_" + name, [&] (std::size_t i) { return path[i].stretch; }) <= 1.0);
        CHECK (golden.worst ("e_" + name, [&] (std::size_t i) { return path[i].end_v; }) <= 1.0);
        CHECK (tool.axis (1).x == 0.0);
    }
}

TEST_CASE ("flexible tool: while a force is constant, the motion does not depend on the tick", "[host][devices]")
{
    test::property ("any tool, with and without dry friction", [] (bool is_dry) {
        const auto properties = anyTool (is_dry);
        const int parts = *rc::gen::inRange (2, 9);
        const double dt = between (1e-4, 5e-3);
        FlexibleTool whole (properties, dt), split (properties, dt / parts);
        const Vec3 x = alongX (between (-0.1, 0.1)), v = alongX (between (-0.2, 0.2));
        whole.start (x, v);
        split.start (x, v);
        for (int k = 0; k < 20; ++k)
        {
            const Vec3 motor = alongX (between (-1.5, 1.5)), hand = alongX (between (-1.0, 1.0));
            whole.step (motor, hand);
            for (int i = 0; i < parts; ++i)
                split.step (motor, hand);
        }
        // A phase change is located to within 1e-12 s, so speeds differ by that times the acceleration, at most 1e4 m/s2.
        RC_ASSERT (std::abs (whole.axis (0).x - split.axis (0).x) < 1e-10);
        RC_ASSERT (std::abs (whole.axis (0).v - split.axis (0).v) < 2e-7);
        RC_ASSERT (std::abs (whole.axis (0).end_v - split.axis (0).end_v) < 2e-7);
    });
}

TEST_CASE ("flexible tool: without damping and friction, energy changes by the work of the forces, to rounding", "[host][devices][energy]")
{
    test::property ("any tool", [] {
        auto properties = anyTool (false);
        properties.damping = properties.first_mode_damping = 0.0;
        FlexibleTool tool (properties, 1e-3);
        tool.start (Vec3::Zero(), alongX (between (-0.2, 0.2)));
        for (int k = 0; k < 100; ++k)
        {
            const Vec3 motor = alongX (between (-1.0, 1.0)), hand = alongX (between (-1.0, 1.0)), m = tool.motor(), e = tool.end();
            const double before = tool.energy();
            tool.step (motor, hand);
            const double work = motor.dot (tool.motor() - m) + hand.dot (tool.end() - e);
            RC_ASSERT (std::abs (tool.energy() - before - work) < 1e-13 + 1e-11 * tool.energy());
        }
    });
}

TEST_CASE ("flexible tool: damping and friction only take energy", "[host][devices][energy]")
{
    test::property ("any tool", [] {
        const auto properties = anyTool (true);
        FlexibleTool tool (properties, between (1e-4, 4e-3));
        tool.start (Vec3::Zero(), alongX (between (-0.2, 0.2)));
        for (int k = 0; k < 60; ++k)
        {
            const Vec3 motor = alongX (between (-1.5, 1.5)), hand = alongX (between (-1.0, 1.0)), m = tool.motor(), e = tool.end();
            const double before = tool.energy();
            tool.step (motor, hand);
            const double work = motor.dot (tool.motor() - m) + hand.dot (tool.end() - e), lost = before + work - tool.energy();
            const double slid = std::abs (tool.motor().x() - m.x());   // the motor slid at least this far; farther if it has turned back
            RC_ASSERT (lost > properties.coulomb * slid - 1e-13 - 1e-10 * tool.energy());
        }
        RC_ASSERT (tool.mostPhases() < 64);
    });
}

TEST_CASE ("flexible tool: while the motor is held, the end swings at the first mode and decays with its damping ratio", "[host][devices]")
{
    for (const double zeta : { 0.0, 0.05 })
        for (const double f : { 30.0, 400.0 })
        {
            constexpr double dt = 1e-4;
            FlexibleTool tool ({ .motor_mass = 0.05, .end_mass = 0.05, .coulomb = 1000.0, .first_mode_hz = f, .first_mode_damping = zeta }, dt);
            tool.start (Vec3::Zero(), Vec3::Zero());
            std::vector<double> stretch;
            for (int k = 0; k < 4000; ++k)
            {
                tool.step (Vec3::Zero(), alongX (k < 10 ? -0.1 : 0.0));
                if (k >= 10) stretch.push_back (tool.axis (0).stretch);
            }
            REQUIRE (tool.axis (0).x == 0.0);
            const auto rises = risesOf (stretch, dt);
            REQUIRE (rises.size() > 8);
            const double period = (rises[8] - rises[0]) / 8.0, damped = f * std::sqrt (1.0 - zeta * zeta);
            CHECK (1.0 / period == Approx (damped).epsilon (2e-3));

            const auto at = [&] (int k) { return stretch[static_cast<std::size_t> (k)]; };
            const auto amplitude = [&] (int k) {   // from the stretch and its rate
                const double rate = (at (k + 1) - at (k - 1)) / (2.0 * dt), w = 2.0 * std::numbers::pi * f;
                return std::hypot (at (k), (rate + zeta * w * at (k)) / w);
            };
            if (f < 100.0) CHECK (amplitude (2000) / amplitude (1000) == Approx (std::exp (-zeta * 2.0 * std::numbers::pi * f * 0.1)).epsilon (0.02));
        }
}

TEST_CASE ("flexible tool: a force below the Coulomb friction never moves it", "[host][devices]")
{
    FlexibleTool tool ({ .coulomb = 0.3, .first_mode_hz = 30.0 }, 1e-3);
    tool.start (alongX (0.01), Vec3::Zero());
    for (int k = 0; k < 60'000; ++k)                                     // for a minute
        tool.step (alongX (0.1 * std::sin (0.05 * k)), alongX (0.19));   // at the start, the end overshoots, by less than a factor of 2
    CHECK (std::abs (tool.motor().x() - 0.01) < 1e-3);
    const double there = tool.motor().x();
    for (int k = 0; k < 60'000; ++k)
        tool.step (alongX (0.1 * std::sin (0.05 * k)), alongX (0.19));
    CHECK (tool.motor().x() == there);
    CHECK (tool.axis (0).v == 0.0);

    RigidTool rigid (0.1, 1.0, 0.3, 1e-3);
    rigid.start (alongX (0.01), Vec3::Zero());
    for (int k = 0; k < 60'000; ++k)
        rigid.step (alongX (0.299 * std::sin (0.05 * k)));
    CHECK (rigid.position().x() == 0.01);
}

TEST_CASE ("rigid tool: on a spring, Coulomb friction shortens each half swing by the same amount", "[host][devices]")
{
    // Per half swing, the amplitude falls by 2 f_f/k. The spring is sampled so finely that the error is below 10 um.
    constexpr double mass = 0.1, k = 400.0, friction = 0.2, start = 0.0102, dt = 2e-6;
    RigidTool tool (mass, 0.0, friction, dt);
    tool.start (alongX (start), Vec3::Zero());
    std::vector<double> turns;
    double before = 0.0;
    for (int i = 0; i < 500'000; ++i)
    {
        tool.step (-k * tool.position());
        const double v = tool.velocity().x();
        if (before * v < 0.0 || (before != 0.0 && v == 0.0)) turns.push_back (std::abs (tool.position().x()));
        before = v;
    }
    REQUIRE (turns.size() == 10);   // the tool stops where |x| < f_f/k = 0.5 mm
    for (std::size_t i = 0; i < turns.size(); ++i)
        CHECK (turns[i] == Approx (start - 2.0 * friction / k * static_cast<double> (i + 1)).margin (1e-5));
    CHECK (tool.velocity().x() == 0.0);
}

TEST_CASE ("rigid tool: with friction, the motion does not depend on the tick, and a stop is exact", "[host][devices]")
{
    // v' = -(f_f + B v)/M from v0: it stops at the time (M/B) ln (1 + B v0/f_f), at x = (M/B) (v0 - f_f/B ln (1 + B v0/f_f)).
    constexpr double mass = 0.1, b = 2.0, friction = 0.25, v0 = 0.3;
    const double way = mass / b * (v0 - friction / b * std::log1p (b * v0 / friction));
    for (const double dt : { 1e-4, 1e-3, 7e-3, 1.0 })
    {
        RigidTool tool (mass, b, friction, dt);
        tool.start (Vec3::Zero(), alongX (v0));
        for (double t = 0.0; t < 0.5; t += dt)
            tool.step (alongX (0.0));
        CHECK (tool.position().x() == Approx (way).epsilon (1e-13));
        CHECK (tool.velocity().x() == 0.0);
    }
}

TEST_CASE ("flexible tool: the stiffer the structure, the closer it is to the rigid tool", "[host][devices]")
{
    double last = 1.0;
    for (const double f : { 100.0, 1000.0, 10'000.0, 100'000.0 })
        for (const double friction : { 0.0, 0.1 })
        {
            if (friction > 0.0 && f > 1000.0) continue;   // the ringing then changes where the tool sticks
            const Properties properties {
                .motor_mass = 0.06, .end_mass = 0.04, .damping = 1.0, .coulomb = friction, .first_mode_hz = f, .first_mode_damping = 0.5
            };
            FlexibleTool soft (properties, 1e-3);
            RigidTool rigid (0.1, 1.0, friction, 1e-3);
            soft.start (Vec3::Zero(), alongX (0.1));
            rigid.start (Vec3::Zero(), alongX (0.1));
            double worst = 0.0;
            for (int k = 0; k < 300; ++k)
            {
                const Vec3 motor = alongX (0.5 * std::sin (0.02 * k)), hand = alongX (0.3);
                soft.step (motor, hand);
                rigid.step (motor + hand);
                worst = std::max ({ worst, std::abs (soft.motor().x() - rigid.position().x()), std::abs (soft.end().x() - rigid.position().x()) });
            }
            INFO (f << " Hz, " << friction << " N: " << worst);
            if (friction == 0.0) CHECK (worst < 0.2 * last);
            if (friction == 0.0) last = worst;
            if (friction > 0.0) CHECK (worst < 1e-3);
        }
    CHECK (last < 1e-7);
}

TEST_CASE ("sim: with a first mode, the sensor is at the motor, and hand and truth are at the end", "[host][devices]")
{
    SimulatedDevice device ({ .mass = 0.1, .coulomb = 50.0, .first_mode = 30.0, .end_mass = 0.05, .hand_force = alongX (1.0) });
    device.prepare (1e-3);
    const double k = 0.05 * std::pow (2.0 * std::numbers::pi * 30.0, 2);
    const NoAllocation watched;
    for (int i = 0; i < 3000; ++i)
    {
        device.read();
        device.write ({ .force = alongX (2.0) });
    }
    CHECK (watched.allocations() == 0);
    const auto now = device.read();
    CHECK (now.position.x() == 0.0);
    CHECK (now.true_position.x() == Approx (1.0 / k).epsilon (1e-9));
    CHECK (now.valid);
}
