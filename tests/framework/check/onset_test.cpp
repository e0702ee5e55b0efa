// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/check/hands.hpp>
#include <tactus/check/judge.hpp>
#include <tactus/check/sampled_loop.hpp>

#include "onset.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace tactus;
using namespace tactus::test;

namespace
{
/// A wall, for a tool that a constant force presses against it. The tool always touches, so the wall acts as a spring.
graph::Graph wall (double stiffness, double rate_hz)
{
    test::Sketch s;
    s.node ("hand", "device.position").node ("motor", "device.force");
    for (auto& node : s.graph.root.nodes)
        node.role = "tip";
    s.node ("wall", "deform.plane", { { "stiffness", stiffness } }).wire ("hand.position -> wall.position").wire ("wall.force -> motor.force");
    s.graph.rate_hz = rate_hz;
    return s.graph;
}

/// The stiffness of the wall, in N/m, that just meets a condition: measured on a soft wall, and scaled up to the limit.
double predicted (const Simulation& sim, double rate_hz, std::string_view id)
{
    const double soft = 10.0;
    const auto graph = wall (soft, rate_hz);
    SimulatedDevice still { resting (sim, soft) };
    const std::vector<check::Hand> hands { { "tip", still } };
    const auto motion = check::recordMotion (compile (graph, catalogue()).plan, hands, 8);
    const auto demand = check::measure ({ graph, catalogue() }, motion, { .places = 2 });
    const std::vector<check::RoleDevice> devices { { "tip", numbersOf (sim), "sim" } };
    for (const auto& c : check::judge (demand, devices))
        if (c.id == id) return soft * c.margin();
    FAIL ("no condition " << id);
    return 0.0;
}

/// A tool in a wall, which it may leave.
struct Run
{
    Trail halves[2];   // of the time

    Run (const Simulation& sim, double stiffness, double rate_hz, int ticks)
    {
        SimulatedDevice device { resting (sim, stiffness) };
        Engine engine { compile (wall (stiffness, rate_hz), catalogue()).plan };
        engine.attach ("tip", device);
        for (int k = 0; k < ticks; ++k)
        {
            engine.tick();
            halves[k < ticks / 2 ? 0 : 1].to (engine.plan().roles()[0].state->reading.true_position.z());
        }
    }

    double relative (double to) const { return halves[0].range() > 0.0 ? to / halves[0].range() : 0.0; }
};

/// The range of the positions in the second half of a run, divided by their range in the first half.
double growth (const Simulation& sim, double stiffness, double rate_hz, int ticks)
{
    const Run run (sim, stiffness, rate_hz, ticks);
    return run.relative (run.halves[1].range());
}

/// How far the tool swings in the second half of a run of 60 000 ticks, divided by the range of its positions in the first half.
double swing (const Simulation& sim, double stiffness, double rate_hz)
{
    const Run run (sim, stiffness, rate_hz, 60'000);
    return run.relative (run.halves[1].swing());
}
}   // namespace

TEST_CASE ("a wall on a light damped tool starts to oscillate within 10 % of where the condition says", "[check]")
{
    // The condition is exact if the damping takes many ticks to stop the tool (B T << M), and the delay is short compared with the period.
    property ("onset", [] {
        const double rate_hz = *between (500.0, 10e3), mass = *between (0.02, 1.0), share = *between (0.003, 0.02);
        const int delay = *rc::gen::inRange (0, 4);
        const Simulation sim { .mass = mass, .damping = share * mass * rate_hz, .delay = delay };
        const double stiffest = predicted (sim, rate_hz, "stiffness");
        const int ticks = static_cast<int> (80.0 / share) + 200;
        RC_LOG() << "stiffest " << stiffest << " N/m, at 0.9: " << growth (sim, 0.9 * stiffest, rate_hz, ticks)
                 << ", at 1.1: " << growth (sim, 1.1 * stiffest, rate_hz, ticks) << '\n';
        RC_ASSERT (growth (sim, 0.9 * stiffest, rate_hz, ticks) < 1.0);
        RC_ASSERT (growth (sim, 1.1 * stiffest, rate_hz, ticks) > 1.0);
    });
}

namespace
{
/// A wall with virtual damping, from the last two positions.
std::vector<double> dampedWall (double stiffness, double virtual_damping, double rate_hz) { return { stiffness + virtual_damping * rate_hz, stiffness }; }

std::array<double, 2> lateRanges (const Simulation& sim, double stiffness, double rate_hz)
{
    return test::lateRanges (wall (stiffness, rate_hz), resting (sim, stiffness));
}

/// The stiffness at which the sampled loop begins to swing, in N/m.
double onset (const DeviceNumbers& numbers, double virtual_damping, double rate_hz, const check::HeldHand& hand = {})
{
    double low = 1.0, high = 1e8;
    for (int i = 0; i < 60; ++i)
    {
        const double middle = std::sqrt (low * high);
        const auto radius = check::loopRadius (dampedWall (middle, virtual_damping, rate_hz), numbers, 1.0 / rate_hz, hand);
        (radius.value() <= 1.0 ? low : high) = middle;
    }
    return low;
}
}   // namespace

TEST_CASE ("the sampled loop of a wall begins to swing where simulations do, with and without virtual damping", "[check]")
{
    const Simulation arm { .mass = 0.1, .damping = 2.0 };   // at 1 kHz, simulated for seconds
    for (const auto& [virtual_damping, limit] : { std::pair { 0.0, 4.0e3 }, { 1.0, 6.0e3 }, { 5.0, 13.5e3 }, { 20.0, 36e3 } })
    {
        INFO (virtual_damping);
        CHECK (onset (numbersOf (arm), virtual_damping, 1000.0) == Approx (limit).epsilon (0.02));
    }

    property ("a wall, a delay, a structure that bends", [] {
        const double rate_hz = *between (1000.0, 20e3), mass = *between (0.02, 1.0), share = *between (0.01, 1.0);
        Simulation sim { .mass = mass, .damping = share * mass * rate_hz, .delay = *rc::gen::inRange (0, 6) };
        if (*rc::gen::arbitrary<bool>()) sim.first_mode = *between (0.005, 0.1) * rate_hz;
        const double limit = onset (numbersOf (sim), 0.0, rate_hz);
        const auto [below, above] = std::pair { lateRanges (sim, 0.98 * limit, rate_hz), lateRanges (sim, 1.02 * limit, rate_hz) };
        RC_LOG() << "limit " << limit << " N/m, at 0.98: " << below[0] << " to " << below[1] << " m, at 1.02: " << above[0] << " to "
                 << above[1] << " m\n";
        constexpr double rounding = 1e-13;   // m
        RC_ASSERT (below[1] < std::max (rounding, 0.999 * below[0]));
        const double bounce = 0.5 * pressing_n / limit;   // m; a swing as large as this soon leaves the wall, and grows no more
        RC_ASSERT (above[1] > std::max (rounding, std::min (0.999 * above[0], bounce)));
    });
}

TEST_CASE ("a wall that is not passive, but rests, is called stable, and one that swings is called broken", "[check]")
{
    const Simulation arm { .mass = 0.1, .damping = 2.0 };
    const auto judged = [&] (double stiffness, double virtual_damping) {
        test::Sketch s;
        s.node ("hand", "device.position").node ("motor", "device.force");
        for (auto& node : s.graph.root.nodes)
            node.role = "tip";
        s.node ("wall", "deform.plane", { { "stiffness", stiffness }, { "damping", virtual_damping } });
        s.wire ("hand.position -> wall.position").wire ("wall.force -> motor.force");
        s.graph.rate_hz = 1000.0;
        SimulatedDevice still { resting (arm, stiffness) };
        const std::vector<check::Hand> hands { { "tip", still } };
        const auto motion = check::recordMotion (compile (s.graph, catalogue()).plan, hands, 8);
        const auto demand = check::measure ({ s.graph, catalogue() }, motion, { .places = 2 });
        const std::vector<check::RoleDevice> devices { { "tip", numbersOf (arm), "sim" } };
        const auto all = check::judge (demand, devices);
        return *std::ranges::find (all, "stiffness", &check::Condition::id);
    };
    const auto verdictOf = [&] (double stiffness, double virtual_damping) { return judged (stiffness, virtual_damping).verdict; };
    CHECK (verdictOf (2e3, 0.0) == check::Verdict::passive);
    CHECK (verdictOf (20e3, 20.0) == check::Verdict::stable);
    CHECK (verdictOf (20e3, 0.0) == check::Verdict::unstable);
    CHECK (verdictOf (5e3, 1.0) == check::Verdict::stable);
    CHECK (verdictOf (7e3, 1.0) == check::Verdict::unstable);
    CHECK (judged (5e3, 1.0).margin() == Approx (1.31).epsilon (0.02));   // stiffness and damping grow: 6.56 kN/m with 1.31 N s/m
}

TEST_CASE ("a virtual damper on any tool starts to swing within 1 % of where the condition says", "[check]")
{
    // A tool that moves freely along z in a damper without a spring. Exact, so any ratio of damping to mass will do.
    const auto growthOf = [] (const Simulation& sim, double virtual_damping, double rate_hz) {
        double speed = 0.0, first_half = 0.0, second_half = 0.0;
        constexpr int ticks = 4000;
        const double w = sim.damping / (sim.mass * rate_hz), a = std::exp (-w);
        double step = 1e-6;   // m, per tick
        for (int k = 0; k < ticks; ++k)
        {
            const double force = -virtual_damping * step * rate_hz;
            step = (sim.mass / sim.damping) * (1.0 - a) * speed + (1.0 / rate_hz - (1.0 - a) * sim.mass / sim.damping) * force / sim.damping;
            speed = a * speed + (1.0 - a) * force / sim.damping;
            if (std::abs (step) > 1.0) return 1e9;
            (k < ticks / 2 ? first_half : second_half) += std::abs (step);
        }
        return second_half / first_half;
    };
    property ("damper", [&] {
        const double rate_hz = *between (500.0, 20e3), mass = *between (0.01, 1.0), share = *between (0.01, 20.0);
        const Simulation sim { .mass = mass, .damping = share * mass * rate_hz };
        const double limit = check::largestDamper (mass, sim.damping, 1.0 / rate_hz);
        RC_LOG() << "limit " << limit << " N s/m, B T/M " << share << '\n';
        RC_ASSERT (growthOf (sim, 0.99 * limit, rate_hz) < 1.0);
        RC_ASSERT (growthOf (sim, 1.01 * limit, rate_hz) > 1.0);
    });
    CHECK (check::largestDamper (0.1, 2.0, 1e-3) == Approx (202.682).epsilon (1e-5));
    CHECK (check::largestDamper (0.1, 2.0, 1e-3) == Approx (2.0 * 0.1 / 1e-3 + 4.0 / 3.0 * 2.0).epsilon (1e-4));
    CHECK (check::largestDamper (0.1, 0.0, 1e-3) == Approx (200.0));
}

TEST_CASE ("on a heavily damped or compliant tool, a wall that meets the condition never oscillates", "[check]")
{
    property ("safe side", [] {
        const double rate_hz = *between (500.0, 10e3), mass = *between (0.02, 1.0), share = *between (0.02, 1.5);
        Simulation sim { .mass = mass, .damping = share * mass * rate_hz, .delay = *rc::gen::inRange (0, 4) };
        if (*rc::gen::arbitrary<bool>()) sim.first_mode = *between (10.0, 400.0);
        const double stiffest = predicted (sim, rate_hz, "stiffness");
        RC_ASSERT (growth (sim, 0.95 * stiffest, rate_hz, 20'000) < 1.0);
    });
}

TEST_CASE ("on a wall that meets the conditions for quanta and damping, no tool swings for ever", "[check]")
{
    property ("rest", [] {
        const double rate_hz = *between (500.0, 10e3), mass = *between (0.02, 0.5), share = *between (0.005, 0.5);
        Simulation sim { .mass = mass, .damping = share * mass * rate_hz };
        sim.quantum = *between (1e-7, 5e-5);
        sim.coulomb = *between (1e-3, 0.1);
        const double stiffest = std::min (predicted (sim, rate_hz, "stiffness"), predicted (sim, rate_hz, "quantum"));
        RC_ASSERT (swing (sim, 0.95 * stiffest, rate_hz) < 1e-3);
    });
}

TEST_CASE ("on a wall at the limit of the conditions, no tool swings for ever, whatever the seven quantities of the device", "[check]")
{
    property ("all at once", [] {
        const double rate_hz = *between (500.0, 10e3), mass = *between (0.02, 0.5), share = *between (0.005, 0.5);
        Simulation sim { .mass = mass, .damping = share * mass * rate_hz, .delay = *rc::gen::inRange (0, 4) };
        sim.quantum = *between (1e-7, 5e-5);
        sim.coulomb = *between (1e-3, 0.1);
        sim.first_mode = *between (10.0, 400.0);
        const double stiffest = std::min (predicted (sim, rate_hz, "stiffness"), predicted (sim, rate_hz, "quantum"));
        const double left = swing (sim, stiffest, rate_hz);
        RC_LOG() << "stiffest " << stiffest << " N/m, swings by " << left << '\n';
        RC_ASSERT (left < 1e-3);
    });
}

TEST_CASE ("if the force is a little above the friction, the tool creeps to the next step of the sensor, as fast as the damping allows", "[check]")
{
    const double rate_hz = 3544.72;
    const Simulation sim { .mass = 0.486346, .damping = 40.8113, .quantum = 4.15763e-5, .coulomb = 4.80771e-3 };
    const double stiffest = 2.0 * sim.coulomb / sim.quantum, stiffness = 0.95 * stiffest;
    CHECK (predicted (sim, rate_hz, "quantum") == Approx (stiffest));
    const Run run (sim, stiffness, rate_hz, 60'000);
    const auto& late = run.halves[1];
    CHECK (late.swing() == 0.0);
    const double speed = late.range() * rate_hz / 29'999.0, felt = stiffness * sim.quantum * std::floor (late.lowest / sim.quantum + 0.5);
    CHECK (-pressing_n - felt - sim.coulomb == Approx (sim.damping * speed));

    const Simulation bends { .mass = 0.228, .damping = 116.5, .quantum = 9.295e-6, .delay = 2, .coulomb = 1.1455e-3, .first_mode = 31.95 };
    CHECK (swing (bends, 2.0 * bends.coulomb / bends.quantum, 3685.88) < 1e-9);
    CHECK (growth (bends, 2.0 * bends.coulomb / bends.quantum, 3685.88, 60'000) > 1e-3);
}
