// SPDX-License-Identifier: MIT
// The condition `deadbeat` covers what a wall of hold.deadbeat does in a simulation, if the mass of the tool is not what it assumes.
#include <support/property.hpp>
#include <tactus/check/deadbeat_loop.hpp>
#include <tactus/check/judge.hpp>
#include <tactus/check/sampled_loop.hpp>
#include <tactus/nodes/hold/deadbeat.hpp>
#include <tactus/run/device/sim.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <tuple>
#include <utility>

using namespace tactus;

namespace
{
double spread (double low, double high) { return low * std::pow (high / low, 1e-6 * *rc::gen::inRange (0, 1'000'001)); }

/// A wall, and the device that it pushes. `turn` is K T^2/M, `loss` B T/M, both with the true mass.
/// How far a tool swings in the third and in the fourth quarter of the time, in units of the depth. A wall cannot pull: a swing that takes its
/// force to zero, however small it is, may be smaller later, but does not end.
struct Swings
{
    static constexpr double rounding = 1e-9;

    double third, fourth;
    bool lets_go;   // the force of the wall has been zero

    bool shrinks() const { return fourth < std::max (rounding, 0.999 * third); }
    bool lasts() const { return fourth > std::max (rounding, lets_go ? 0.0 : 0.999 * third); }

    friend std::ostream& operator<< (std::ostream& out, const Swings& s)
    {
        return out << s.third << " to " << s.fourth << (s.lets_go ? ", lets go" : "");
    }
};

struct Trial
{
    double rate_hz = 1000.0, mass = 0.1, turn = 0.12, loss = 0.02;
    double believed = 1.0;   // mass given to the node, divided by the true mass
    int delay = 0;           // of the device, and known to the node, in ticks
    double quantum = 0.0, coulomb = 0.0;

    double stiffness() const { return turn * mass * rate_hz * rate_hz; }

    Simulation device() const
    {
        return { .mass = mass, .damping = loss * mass * rate_hz, .quantum = quantum, .delay = delay, .coulomb = coulomb };
    }

    check::Condition judged() const
    {
        check::Demand demand { .rate_hz = rate_hz };
        demand.roles.push_back ({ .role = "h0" });
        demand.nodes.push_back ({ "wall", "hold.deadbeat" });
        demand.deadbeats.push_back ({ .role = "h0", .mass = believed * mass, .stiffness = stiffness(), .delay = static_cast<double> (delay) });
        const check::RoleDevice known { "h0", numbersOf (device()), "sim" };
        for (const auto& c : check::judge (demand, { &known, 1 }))
            if (c.id == "deadbeat") return c;
        return {};
    }

    /// Lets a hand of 1 N press on the wall. `start`: how high the tool is let go, in units of the depth at which it comes to rest. Returns the
    /// largest distance from this depth in the last quarter of a long time, in the same unit.
    double unrest (double start) const
    {
        const double rest = 1.0 / stiffness();
        auto sim = device();
        sim.hand_force = { 0.0, 0.0, -1.0 };
        sim.position = { 0.0, 0.0, start * rest };
        SimulatedDevice tool { sim };
        nodes::DeadbeatHold wall;
        wall.params = { .stiffness = stiffness(), .mass = believed * mass, .damping = sim.damping };
        wall.settings.delay = delay;
        tool.prepare (1.0 / rate_hz);
        wall.prepare ({ .rate_hz = rate_hz });
        wall.update();
        // The slowest loop that `deadbeat` allows keeps a third of the damping, B T/(2M) per tick, and of the rate at which the wall learns
        // the hand, 1/(10 ms).
        const int ticks = 3000 + static_cast<int> (60.0 / loss + 40.0 * loss / turn);
        double most = 0.0;
        for (int k = 0; k < ticks; ++k)
        {
            const auto now = tool.read();
            const double off = std::abs (-now.true_position.z() / rest - 1.0);
            if (! (off < 1e4)) return off;
            if (k >= ticks - ticks / 4) most = std::max (most, off);
            tool.write ({ .force = wall.tick ({ .position = now.position }).force });
        }
        return most;
    }

    check::DeadbeatPlan plan (double off) const
    {
        return { .mass = (1.0 + off) * mass, .damping = device().damping, .stiffness = stiffness(), .delay = static_cast<std::size_t> (delay) };
    }

    double radius (double off) const
    {
        return check::deadbeatRadius (plan (off), numbersOf (device()), static_cast<std::size_t> (delay), 1.0 / rate_hz).value();
    }

    /// Lets a tool rest in the wall with the right mass. Then the wall moves by a thousandth of the depth, and the mass is wrong by a fraction.
    Swings swings (double off) const
    {
        const double rest = 1.0 / stiffness();
        auto sim = device();
        sim.hand_force = { 0.0, 0.0, -1.0 };
        sim.position = { 0.0, 0.0, -rest };
        SimulatedDevice tool { sim };
        nodes::DeadbeatHold wall;
        wall.params = { .stiffness = stiffness(), .mass = mass, .damping = sim.damping };
        wall.settings.delay = delay;
        tool.prepare (1.0 / rate_hz);
        wall.prepare ({ .rate_hz = rate_hz });
        wall.update();
        constexpr int waits = 20'000, ticks = 60'000;
        double low[2] { 1e9, 1e9 }, high[2] { -1e9, -1e9 };
        bool lets_go = false;
        for (int k = -waits; k < ticks; ++k)
        {
            const auto now = tool.read();
            const double depth = -now.true_position.z() / rest;
            if (! (std::abs (depth) < 1e4)) return { 0.0, 1e9, false };
            if (k == 0)
            {
                wall.params.mass *= 1.0 + off;
                wall.params.offset = 1e-3 * rest;
            }
            if (2 * k >= ticks)
            {
                const bool late = 4 * k >= 3 * ticks;
                low[late] = std::min (low[late], depth);
                high[late] = std::max (high[late], depth);
            }
            const auto force = wall.tick ({ .position = now.position }).force;
            lets_go |= k >= 0 && force.z() <= 0.0;
            tool.write ({ .force = force });
        }
        return { high[0] - low[0], high[1] - low[1], lets_go };
    }

    friend std::ostream& operator<< (std::ostream& out, const Trial& t)
    {
        out << "M " << t.mass << " kg, BT/M " << t.loss << ", KT2/M " << t.turn << ", " << t.rate_hz << " Hz, believed " << t.believed;
        return out << ", d " << t.delay << ", delta " << t.quantum << " m, f_f " << t.coulomb << " N";
    }
};
}   // namespace

TEST_CASE ("a deadbeat wall whose mass is off by no more than 'deadbeat' allows comes to rest", "[check]")
{
    test::property ("any mass, damping, stiffness, rate, delay and mistake", [] {
        Trial t { .rate_hz = spread (500.0, 10e3), .mass = spread (0.02, 1.0), .loss = spread (3e-3, 0.1) };
        t.delay = *rc::gen::element (0, 0, 1, 2, 5, 16);
        t.turn = spread (0.003, 2.0) / (1.0 + t.delay);
        t.believed = spread (0.8, 1.2);
        const auto row = t.judged();
        RC_TAG (std::string (check::nameOf (row.verdict)));
        if (row.verdict != check::Verdict::holds && row.verdict != check::Verdict::close) return;
        for (const double start : { -0.7, 0.5, 5.0 })
        {
            const double off = t.unrest (start);
            RC_LOG() << t << ": " << off << '\n';
            RC_ASSERT (off < 0.01);
        }
    });
}

TEST_CASE ("a tool that is pressed into a deadbeat wall begins to swing where its loop does, within 2 % of the error of the mass", "[check]")
{
    test::property ("any mass, damping, stiffness, rate and delay", [] {
        Trial t { .rate_hz = spread (1e3, 20e3), .mass = spread (0.02, 1.0), .loss = spread (3e-3, 0.1), .delay = *rc::gen::inRange (0, 6) };
        t.turn = spread (0.05, 1.0) / (1.0 + t.delay);
        const double sign = *rc::gen::element (1.0, -1.0);
        double rests = 0.0, swings = 0.0;   // errors of the mass
        for (int i = 0; i < 60 && swings == 0.0; ++i)
        {
            const double off = sign * 0.01 * std::pow (1.08, i);
            if (off <= -0.9) break;
            (t.radius (off) <= check::at_rest ? rests : swings) = off;
        }
        RC_PRE (std::abs (swings) > 0.02);
        for (int i = 0; i < 12; ++i)
            (t.radius (0.5 * (rests + swings)) <= check::at_rest ? rests : swings) = 0.5 * (rests + swings);
        RC_PRE (t.radius (1.02 * rests) > check::at_rest);
        const auto below = t.swings (0.98 * rests), above = t.swings (1.02 * rests);
        RC_LOG() << t << ", limit " << rests << ", at 0.98: " << below << ", at 1.02: " << above << '\n';
        RC_ASSERT (below.shrinks());
        RC_ASSERT (above.lasts());
    });
}

TEST_CASE ("a swing in a deadbeat wall grows and shrinks as its loop says", "[check]")
{
    const Trial heavy { .rate_hz = 7896.15, .mass = 0.354825, .turn = 0.0224565, .loss = 0.00334528, .delay = 3 };
    const Trial late { .rate_hz = 5469.52, .mass = 0.271037, .turn = 0.11424, .loss = 0.0236659, .delay = 4 };
    for (const auto& [t, off] : { std::pair { heavy, 0.305 }, { heavy, 0.332 }, { heavy, 0.345 }, { late, 0.0497 }, { late, 0.0501 } })
    {
        INFO (t << ", mass off by " << off);
        const auto [third, fourth, lets_go] = t.swings (off);
        CHECK_FALSE (lets_go);
        constexpr double ticks = 15'000.0;
        CHECK (std::log (fourth / third) / ticks == Approx (std::log (t.radius (off))).margin (1e-6));
    }
}

TEST_CASE ("a swing of a tenth of the depth can take the force of a deadbeat wall to zero, and then grows no more", "[check]")
{
    const Trial t { .rate_hz = 2266.01, .mass = 0.02, .turn = 0.0835743, .loss = 0.0133708, .delay = 1 };
    const auto swings = t.swings (1.02 * -0.858618);
    INFO (swings);
    CHECK (swings.third < 0.15);
    CHECK (swings.fourth < 0.999 * swings.third);
    CHECK (swings.lets_go);
    CHECK (swings.lasts());
    CHECK (t.swings (0.98 * -0.858618).shrinks());
}

TEST_CASE ("with a delay, a low rate and little damping, a deadbeat wall whose mass is larger than assumed never comes to rest", "[check]")
{
    for (const auto& [delay, turn, rests] : { std::tuple { 5, 0.022, false }, { 2, 0.0441, false }, { 5, 0.0107937, true }, { 5, 0.00915, true } })
    {
        Trial t { .rate_hz = 500.0, .mass = 0.02, .turn = turn, .loss = 0.003, .believed = 0.8, .delay = delay };
        INFO (t);
        CHECK (t.judged().verdict == (rests ? check::Verdict::stable : check::Verdict::unstable));
        CHECK ((t.unrest (0.5) < 0.01) == rests);
        t.believed = 0.97;
        CHECK (t.judged().verdict == check::Verdict::close);
        CHECK (t.unrest (0.5) < 0.01);
    }
    const Trial slow { .rate_hz = 500.0, .mass = 0.02, .turn = 0.0028758, .loss = 0.003, .believed = 0.8, .delay = 16 };
    CHECK (slow.judged().verdict == check::Verdict::close);
    CHECK (slow.unrest (0.5) < 0.01);
}

TEST_CASE ("a deadbeat wall whose mass is assumed 4 times as wrong as 'deadbeat' allows never comes to rest", "[check]")
{
    for (const double rate : { 1000.0, 10'000.0 })
        for (const auto& [turn, loss] : { std::pair { 0.2, 2e-3 }, { 0.4, 8e-3 }, { 0.6, 15e-3 } })
        {
            Trial t { .rate_hz = rate, .turn = turn, .loss = loss };
            const double allowed = loss / (2.0 * turn * turn);
            REQUIRE (4.0 * allowed < 0.2);
            t.believed = 1.0 + 0.99 * allowed;
            CHECK (t.judged().verdict == check::Verdict::close);
            t.believed = 1.0 + 4.0 * allowed;
            INFO (rate << " Hz, KT2/M " << turn);
            CHECK (t.judged().verdict == check::Verdict::unstable);
            CHECK (t.unrest (5.0) > 0.01);
        }
}

TEST_CASE ("on the wall of 3 times 2B/T on which the test of the node stays bounded, the mass may be off by 20 %", "[check]")
{
    for (const double believed : { 0.801, 1.199 })
    {
        const Trial t { .turn = 6.0 * 0.02, .loss = 0.02, .believed = believed };
        CHECK (t.judged().verdict == check::Verdict::holds);
        CHECK (t.unrest (5.0) < 0.01);
    }
    CHECK (Trial { .turn = 6.0 * 0.02, .loss = 0.02, .believed = 0.78 }.judged().verdict == check::Verdict::stable);
    CHECK (Trial { .turn = 6.0 * 0.02, .loss = 0.02, .believed = 1.22 }.judged().verdict == check::Verdict::stable);
}

TEST_CASE ("a deadbeat wall within 'deadbeat' comes to rest in spite of the steps of the sensor", "[check]")
{
    test::property ("any mass, damping, stiffness, rate, delay, mistake, quantum and friction", [] {
        Trial t { .rate_hz = spread (500.0, 10e3), .mass = spread (0.02, 1.0), .loss = spread (5e-3, 0.3) };
        t.delay = *rc::gen::element (0, 0, 1, 2, 5);
        t.turn = spread (0.003, 1.0) / std::pow (1.0 + t.delay, 2.0);
        t.believed = spread (0.8, 1.2);
        const double needed = spread (0.01, 0.4);   // N; less than half of the hand's force
        t.quantum = 2.0 * needed / (t.believed * t.mass * t.rate_hz * t.rate_hz);
        t.coulomb = needed * spread (1.0, 2.0);
        const auto row = t.judged();
        RC_TAG (std::string (check::nameOf (row.verdict)));
        if (row.verdict == check::Verdict::broken) return;
        // It stays within what the dry friction and a step of the sensor hide.
        const double hidden = t.coulomb + t.quantum * t.stiffness();
        RC_LOG() << t << ": " << t.unrest (0.5) << '\n';
        RC_ASSERT (t.unrest (0.5) < hidden + 0.02);
    });
}
