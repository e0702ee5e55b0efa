// SPDX-License-Identifier: MIT
#include <tactus/nodes/hold/deadbeat.hpp>

#include <support/property.hpp>
#include <tactus/nodes/deform/plane.hpp>
#include <tactus/run/device/sim.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace tactus;
using nodes::DeadbeatHold;

namespace
{
double between (double low, double high) { return low + (high - low) * 1e-6 * *rc::gen::inRange (0, 1'000'001); }

struct Trial
{
    double mass = 0.1, damping = 2.0, dt = 1e-3, start = -1.3e-3, speed = 0.1, hand = 0.0, quantum = 0.0;   // start, speed and hand: positive into the wall
    double believed = 1.0;                                                                                  // mass given to the node, divided by the true mass
    int delay = 0;                                                                                          // of the device, and known to the node, in ticks
    int ticks = 200;

    double stiffnessOf (double times) const { return times * 2.0 * damping / dt; }
};

/// Plays `wall`, a node with the input `position` and the output `force`, on a simulated device. The surface is at z = 0. Calls `see` with
/// the true depth and speed before each tick.
template <typename Wall, typename See>
void play (const Trial& t, Wall& wall, const See& see)
{
    SimulatedDevice device ({ .mass = t.mass,
                              .damping = t.damping,
                              .quantum = t.quantum,
                              .delay = t.delay,
                              .position = { 0, 0, -t.start },
                              .velocity = { 0, 0, -t.speed },
                              .hand_force = { 0, 0, -t.hand } });
    device.prepare (t.dt);
    wall.prepare ({ .rate_hz = 1.0 / t.dt });
    wall.update();
    for (int k = 0; k < t.ticks; ++k)
    {
        const auto now = device.read();
        see (-now.true_position.z(), -now.true_velocity.z());
        device.write ({ .force = wall.tick ({ .position = now.position }).force });
    }
}

DeadbeatHold wallFor (const Trial& t, double stiffness)
{
    DeadbeatHold wall;
    wall.params.stiffness = stiffness;
    wall.params.mass = t.believed * t.mass;
    wall.params.damping = t.damping;
    wall.settings.delay = t.delay;
    return wall;
}

BouncingMass continuous (const Trial& t, double stiffness) { return { .mass = t.mass, .damping = t.damping, .stiffness = stiffness, .force = t.hand }; }
}   // namespace

TEST_CASE ("deadbeat: a tool bounces as it would off a continuous wall, wherever the samples fall", "[nodes][hold]")
{
    test::property ("any start, speed and rate", [] {
        const double times = *rc::gen::element (0.5, 3.0, 10.0, 30.0);
        Trial t;
        t.dt = *rc::gen::element (1e-4, 2.5e-4, 1e-3);
        t.speed = between (0.02, 0.4);
        t.start = -t.speed * t.dt * between (1.01, 3.0);   // the node needs two samples to know the speed
        t.ticks = 400;
        const double stiffness = t.stiffnessOf (times);
        auto wall = wallFor (t, stiffness);

        BouncingMass::State ideal { t.start, t.speed };
        double worst = 0.0;
        int k = 0;
        play (t, wall, [&] (double, double v) {
            if (k++ > 0) ideal = continuous (t, stiffness).after (ideal, t.dt).state;
            if (k == t.ticks) worst = std::abs (v - ideal.speed) / t.speed;
        });
        RC_ASSERT (ideal.speed < 0.0);
        RC_ASSERT (worst < 1e-5);
    });
}

TEST_CASE ("deadbeat: at 3 times 2B/T, a tool leaves as fast as from a continuous wall, where a sampled spring adds speed", "[nodes][hold]")
{
    const Trial t;
    const double stiffness = t.stiffnessOf (3.0);
    const auto ideal = continuous (t, stiffness).after ({ t.start, t.speed }, (t.ticks - 1) * t.dt).state;
    double dead = 0.0, sampled = 0.0;

    auto wall = wallFor (t, stiffness);
    play (t, wall, [&] (double, double v) { dead = v; });
    CHECK (dead == Approx (ideal.speed).epsilon (1e-6));

    nodes::Plane plane;
    plane.params.stiffness = stiffness;
    play (t, plane, [&] (double, double v) { sampled = v; });
    CHECK (std::abs (sampled / ideal.speed) > 1.2);
}

TEST_CASE ("deadbeat: with a mass that is off by 20 %, a tool bounces within 1 % of the right speed", "[nodes][hold]")
{
    for (const auto& [times, error] : { std::pair { 3.0, 0.01 }, { 10.0, 0.1 } })
        for (const double believed : { 0.8, 1.2 })
            for (const double start : { -1e-3, -1.03e-3, -1.07e-3 })
            {
                Trial t;
                t.believed = believed;
                t.start = start;
                const double stiffness = t.stiffnessOf (times);
                const auto ideal = continuous (t, stiffness).after ({ t.start, t.speed }, (t.ticks - 1) * t.dt).state;
                auto wall = wallFor (t, stiffness);
                double leaves = 0.0;
                play (t, wall, [&] (double, double v) { leaves = v; });
                CHECK (leaves == Approx (ideal.speed).epsilon (error));
            }
}

TEST_CASE ("deadbeat: with a mass that is off by 20 %, it stays bounded", "[nodes][hold]")
{
    test::property ("any hand, quantum and start", [] {
        Trial t;
        t.believed = *rc::gen::element (0.8, 1.2);
        t.start = between (-2e-3, 0.0);
        t.speed = between (0.0, 0.3);
        t.hand = *rc::gen::element (0.0, 0.3, 1.0, 3.0);
        t.quantum = *rc::gen::element (0.0, 1e-5);
        t.ticks = 3000;
        const double stiffness = t.stiffnessOf (3.0);
        auto wall = wallFor (t, stiffness);
        double most = 0.0, last = 0.0, fastest = 0.0;
        int k = 0;
        play (t, wall, [&] (double e, double v) {
            most = std::max (most, e);
            fastest = std::max (fastest, std::abs (v));
            if (k++ > 2500) last = std::max (last, std::abs (v));
        });
        // Speed and depth at a continuous wall without damping. The hand pushes from the start.
        const double arrives = std::sqrt (t.speed * t.speed + 2.0 * t.hand * -t.start / t.mass);
        const double reach = arrives * std::sqrt (t.mass / stiffness) + 2.0 * t.hand / stiffness;
        RC_ASSERT (most < 1.5 * reach + 1e-4);
        RC_ASSERT (fastest < 1.3 * arrives + 0.1);
        if (t.hand > 0.0) RC_ASSERT (last < (t.quantum > 0.0 ? 0.05 : 0.003));
    });
}

TEST_CASE ("deadbeat: a hand that rests on the wall sinks in as far as the stiffness says", "[nodes][hold]")
{
    Trial t;
    t.start = -1e-4;
    t.speed = 0.0;
    t.hand = 0.7;
    t.ticks = 1000;
    for (const double times : { 0.5, 3.0, 10.0 })
    {
        auto wall = wallFor (t, t.stiffnessOf (times));
        double e = 0.0;
        play (t, wall, [&] (double depth, double) { e = depth; });
        CHECK (e == Approx (t.hand / t.stiffnessOf (times)).epsilon (0.01));
    }
}

TEST_CASE ("deadbeat: a tool far from the wall feels no force", "[nodes][hold]")
{
    Trial t;
    t.start = -0.05;
    t.speed = 0.1;
    auto wall = wallFor (t, 1e5);
    play (t, wall, [&] (double, double) {});
    CHECK (wall.tick ({ .position = { 0, 0, 0.04 } }).force.norm() == 0.0);
    for (int k = 0; k < 10; ++k)
    {
        const auto out = wall.tick ({ .position = { 0.3, 0.01 * k, 0.04 } });
        CHECK (out.force == Vec3 (0, 0, 0));
        CHECK (out.depth == -0.04);
        CHECK (out.state == 0.0);
    }
}

TEST_CASE ("deadbeat: mass and damping 0 mean those of the device", "[nodes][hold]")
{
    const Trial t;
    const double stiffness = t.stiffnessOf (3.0);
    auto given = wallFor (t, stiffness), learnt = given;
    learnt.params.mass = learnt.params.damping = 0.0;
    learnt.learn ({ .mass = t.mass, .damping = t.damping });
    std::vector<double> a, b;
    play (t, given, [&] (double e, double) { a.push_back (e); });
    play (t, learnt, [&] (double e, double) { b.push_back (e); });
    CHECK (a == b);

    learnt.learn ({ .mass = 0.05, .damping = t.damping });
    play (t, learnt, [&] (double e, double) { b.push_back (e); });
    CHECK_FALSE (std::equal (a.begin(), a.end(), b.end() - t.ticks));
}

TEST_CASE ("deadbeat: a delay that the node knows changes neither a bounce nor a hand that presses", "[nodes][hold]")
{
    for (const int delay : { 1, 2, 5, 16 })
        for (const double times : { 0.5, 3.0, 10.0 })
        {
            INFO (delay << " ticks, wall of " << times << " times 2B/T");
            Trial t;
            t.delay = delay;
            t.start = -t.speed * t.dt * (delay + 3.4);   // the node needs two samples to know the speed, and its force comes `delay` later
            t.ticks = 300;
            const double stiffness = t.stiffnessOf (times);
            const auto ideal = continuous (t, stiffness).after ({ t.start, t.speed }, (t.ticks - 1) * t.dt).state;
            auto wall = wallFor (t, stiffness);
            double leaves = 0.0;
            play (t, wall, [&] (double, double v) { leaves = v; });
            CHECK (leaves == Approx (ideal.speed).epsilon (1e-5));

            t.start = -1e-4;
            t.speed = 0.0;
            t.hand = 0.7;
            t.ticks = 3000;
            wall = wallFor (t, stiffness);
            double e = 0.0;
            play (t, wall, [&] (double depth, double) { e = depth; });
            CHECK (e == Approx (t.hand / stiffness).epsilon (0.01));
        }
}

TEST_CASE ("deadbeat: with a delay that the node does not know, a bounce gains speed", "[nodes][hold]")
{
    Trial t;
    t.delay = 2;
    const double stiffness = t.stiffnessOf (3.0);
    auto wall = wallFor (t, stiffness);
    wall.settings.delay = 0;
    double fastest = 0.0;
    play (t, wall, [&] (double, double v) { fastest = std::max (fastest, std::abs (v)); });
    CHECK (fastest > 1.5 * t.speed);
}

TEST_CASE ("deadbeat: a position quantum changes the speed of a tool that leaves by less than the header says", "[nodes][hold]")
{
    test::property ("any mass, damping, stiffness, period, quantum and delay", [] {
        const auto spread = [] (double low, double high) { return low * std::pow (high / low, between (0.0, 1.0)); };
        Trial t;
        t.delay = *rc::gen::element (0, 0, 1, 4);
        t.dt = spread (1e-4, 1e-3);
        t.mass = spread (0.01, 1.0);
        t.damping = between (0.0, 0.01) * t.mass / t.dt;
        t.speed = spread (0.01, 0.5);
        t.quantum = spread (0.003, 1.0) * t.speed * t.dt;
        t.start = -t.speed * t.dt * (15.0 + t.delay + between (0.0, 10.0));
        const double turn = spread (0.05, 2.0), stiffness = t.mass * turn * turn / (t.dt * t.dt);   // turn: by how much the bounce advances per sample, rad
        t.ticks = 60 + t.delay + static_cast<int> (4.0 / turn);

        auto wall = wallFor (t, stiffness);
        BouncingMass::State ideal { t.start, t.speed };
        double leaves = 0.0;
        int k = 0;
        play (t, wall, [&] (double, double v) {
            if (k++ > 0) ideal = continuous (t, stiffness).after (ideal, t.dt).state;
            leaves = v;
        });
        RC_ASSERT (ideal.speed < 0.0);
        RC_ASSERT (std::abs (leaves - ideal.speed) < (3.0 + 2.0 * t.delay) * t.quantum * std::sqrt (stiffness / t.mass));
    });
}
