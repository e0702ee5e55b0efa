// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/check/sampled_loop.hpp>

#include <catch2/catch.hpp>

#include "loops.hpp"

using namespace tactus;
using test::Loops;

namespace
{
constexpr double T = 1e-3;   // s

/// True if a condition about the whole loop is broken, as by a wire that is too stiff.
bool isJudgedUnstable (const std::vector<check::Condition>& all)
{
    return std::ranges::any_of (all, [] (const check::Condition& c) {
        return c.isBroken() && (c.id == "stiffness" || c.id == "coupling" || c.id == "curl" || c.id == "damping" || c.id == "jump");
    });
}
}   // namespace

TEST_CASE ("two hands that are stable alone but explode together break 'coupling'", "[check]")
{
    Loops loops { .tools = { { .mass = 0.1, .damping = 1.0 }, { .mass = 0.1, .damping = 1.0 } } };
    loops.spring ("h0.x", "h1.x", 1500.0);   // alone, a hand could have 2B/T = 2000 N/m
    REQUIRE (loops.growth (20'000) > 10.0);
    const auto all = loops.conditions();
    INFO (test::describe (all));
    CHECK (test::brokenIds (all).substr (2) == ":coupling");
}

TEST_CASE ("hands of unequal damping that pull each other with unequal forces are judged by their loop", "[check]")
{
    Loops loops { .tools = { { .mass = 0.23, .damping = 0.2 }, { .mass = 0.02, .damping = 1.0 } } };
    loops.ground ("h0.y", 1.0);
    loops.ground ("h1.y", 8.1);
    loops.wire ("h1_at.position.y", "h0_motor.force.y", "-1 N/m");   // the Jacobian has real eigenvalues, so it breaks no condition on a turning field
    const auto explodes = GENERATE (false, true);
    loops.wire ("h0_at.position.y", "h1_motor.force.y", explodes ? "17 N/m" : "2 N/m");
    const double growth = loops.growth (20'000);
    CHECK ((growth > 2.0) == explodes);
    CHECK ((growth < 1.0) == ! explodes);
    const auto all = loops.conditions();
    INFO (test::describe (all));
    CHECK (isJudgedUnstable (all) == explodes);
}

TEST_CASE ("such hands beside a slow section are unstable where a simulation swings, and else not judged", "[check]")
{
    Loops loops { .tools = { { .mass = 0.23, .damping = 0.2 }, { .mass = 0.02, .damping = 1.0 } } };
    loops.ground ("h0.y", 1.0);
    loops.ground ("h1.y", 8.1);
    loops.slowGround (1, 'x', 20.0, 2);
    for (const auto* place : { "h0.x", "h0.z", "h1.z" })   // nothing drifts
        loops.ground (place, 10.0);
    loops.wire ("h1_at.position.y", "h0_motor.force.y", "-1 N/m");
    const auto pull = GENERATE (2.0, 8.0, 12.0, 14.0, 15.0, 16.0, 17.0, 20.0, 40.0);
    loops.wire ("h0_at.position.y", "h1_motor.force.y", std::to_string (pull) + " N/m");
    const double growth = loops.growth (80'000);
    const auto all = loops.tried (5e-3, { .places = 2 });
    CAPTURE (pull, growth);
    INFO (test::describe (all));
    const auto coupling = std::ranges::find (all, "coupling", &check::Condition::id);
    REQUIRE (coupling != all.end());
    CHECK (coupling->verdict == (growth > 1.0 ? check::Verdict::unstable : check::Verdict::unknown));
}

TEST_CASE ("no remedy is to make a response 0 times as large", "[check]")
{
    Loops loops { .tools = { { .mass = 0.1, .damping = 1.0 } } };
    loops.ground ("h0.x", 1e8);
    bool has_no_factor = false;
    for (const auto& c : loops.conditions())
    {
        INFO (c.id << ": " << c.text << "; " << c.remedy);
        CHECK (c.text.find (" 0 times") == std::string::npos);
        CHECK (c.remedy.find (" 0 times") == std::string::npos);
        has_no_factor |= c.verdict == check::Verdict::unstable && c.may_grow == 0.0;
    }
    CHECK (has_no_factor);
}

TEST_CASE ("two hands on a spring begin to swing where the sampled loop of both does, within 2 %", "[check]")
{
    test::property ("masses, dampings, delays, rates", [] {
        const auto pick = [] (double low, double high) { return low * std::pow (high / low, 1e-6 * *rc::gen::inRange (0, 1'000'001)); };
        Loops loops { .rate_hz = pick (1e3, 10e3), .tools = {} };
        std::vector<DeviceNumbers> numbers;
        for (int i = 0; i < 2; ++i)
        {
            const double mass = pick (0.03, 0.5);
            loops.tools.push_back ({ .mass = mass, .damping = pick (0.01, 0.2) * mass * loops.rate_hz, .delay = *rc::gen::inRange (0, 3) });
            numbers.push_back (numbersOf (loops.tools.back()));
        }
        const double soft = 10.0;   // N/m; the spring is linear, so its loop can be scaled
        const int late = *rc::gen::inRange (0, 3);
        loops.spring ("h0.x", "h1.x", soft, late);
        const auto demand = loops.demand();
        const auto& response = demand.linked.at (0).responses;
        RC_ASSERT (response.size() == std::size_t (1 + late));
        const std::vector<const DeviceNumbers*> axes { &numbers[0], &numbers[0], &numbers[0], &numbers[1], &numbers[1], &numbers[1] };
        const double room = check::roomToGrow ([&] (double factor) {
            auto larger = response;
            for (auto& m : larger)
                m *= 1e3 * factor;
            return check::loopRadius (larger, axes, 1.0 / loops.rate_hz, {}).value() <= check::at_rest;
        });
        RC_PRE (room > 0.0 && room < 1e3);
        const auto growth = [&] (double part) {
            Loops real { .rate_hz = loops.rate_hz, .tools = loops.tools };
            real.spring ("h0.x", "h1.x", part * room * 1e3 * soft, late);
            return real.growth (60'000);
        };
        const double below = growth (0.98), above = growth (1.02);
        RC_LOG() << "limit " << room * 1e3 * soft << " N/m, at 0.98: " << below << ", at 1.02: " << above << '\n';
        RC_ASSERT (below < 1.0);
        RC_ASSERT (above > 1.0);
    });
}

TEST_CASE ("two hands that are not passive together are called stable if they rest, and unstable if they swing", "[check]")
{
    const auto verdictAt = [] (double stiffness) {
        Loops loops { .tools = { { .mass = 0.05, .damping = 5.0 }, { .mass = 0.3, .damping = 1.0, .delay = 1 } } };
        loops.spring ("h0.x", "h1.x", stiffness);
        const auto all = loops.conditions();
        const auto coupling = std::ranges::find (all, "coupling", &check::Condition::id);
        REQUIRE (coupling != all.end());
        INFO (test::describe (all));
        const double growth = loops.growth (60'000);
        CHECK ((growth < 1.0) == ! coupling->isBroken());
        if (! test::isPassive (coupling->verdict))
        {
            Loops at_limit { .tools = loops.tools };
            at_limit.spring ("h0.x", "h1.x", 0.98 * coupling->may_grow * stiffness);   // the usual hands make no difference here
            CHECK (at_limit.growth (60'000) < 1.0);
        }
        return coupling->verdict;
    };
    CHECK (verdictAt (400.0) == check::Verdict::passive_here);   // a wire from a position to a force claims nothing
    CHECK (verdictAt (800.0) == check::Verdict::stable);
    CHECK (verdictAt (10e3) == check::Verdict::unstable);
}

TEST_CASE ("a spring between two hands is judged as the condition on the whole Jacobian says", "[check]")
{
    const Simulation light { .mass = 0.05, .damping = 0.5 }, heavy { .mass = 0.3, .damping = 1.0 }, late { .mass = 0.2, .damping = 0.7, .delay = 2 };
    for (const auto& [a, b] : { std::pair (light, light), std::pair (light, heavy), std::pair (heavy, late), std::pair (late, late) })
    {
        // The symmetric stiffness (k -k; -k k) has the load T k sum (d + 1/2)/B, if the delays are equal. If not, the bound is on the safe side.
        const double unit = T * ((a.delay + 0.5) / a.damping + (b.delay + 0.5) / b.damping);
        for (const double factor : { 0.9, 1.1 })
        {
            Loops loops { .tools = { a, b } };
            loops.spring ("h0.y", "h1.y", factor / unit);
            const auto all = loops.conditions();
            INFO (factor << '\n'
                         << test::describe (all));
            const auto coupling = std::ranges::find (all, "coupling", &check::Condition::id);
            if (factor > 1.0 || a.delay == b.delay) CHECK (test::isPassive (coupling->verdict) == (factor < 1.0));
            if (factor < 1.0) CHECK (loops.growth (10'000) < 1.0);
            if (factor > 1.0 && a.mass == b.mass) CHECK (loops.growth (10'000) > 1.0);
            if (factor > 1.0 && a.mass == b.mass) CHECK (isJudgedUnstable (all));
        }
    }
}

TEST_CASE ("a field that turns breaks 'curl' where the tool alone spirals outwards, and not before", "[check]")
{
    const auto judge = [] (double mass, double damping, double stiffness) {
        for (const double factor : { 0.9, 1.1 })
        {
            Loops loops { .tools = { { .mass = mass, .damping = damping } } };
            const double left = damping - stiffness * T / 2, turn = factor * left * std::sqrt (stiffness / mass);
            loops.ground ("h0.x", stiffness);
            loops.ground ("h0.y", stiffness);
            loops.pull ("h0.x", "h0.y", turn);
            loops.pull ("h0.y", "h0.x", -turn);
            const auto all = loops.conditions();
            INFO (test::describe (all));
            CHECK ((loops.growth (15'000) > 1.0) == (factor > 1.0));
            CHECK (test::brokenIds (all) == (factor > 1.0 ? "h0:curl" : ""));
        }
    };
    judge (0.05, 0.5, 20.0);
    judge (0.1, 1.0, 60.0);
    judge (0.3, 2.0, 150.0);
    judge (0.05, 2.0, 150.0);
}

TEST_CASE ("a force computed on every k-th tick is judged by its own period", "[check]")
{
    for (const int k : { 2, 3, 4, 6, 7 })
    {
        Loops loops { .tools = { { .mass = 0.5, .damping = 1.0 } } };
        const double stiffest = 2.0 * 1.0 / (k * T);
        for (const double factor : { 0.97, 1.03 })
        {
            loops.nodes.clear();
            loops.graphs.clear();
            loops.wires.clear();
            loops.slowGround (0, 'x', factor * stiffest, k);
            INFO ("every " << k << ", factor " << factor << '\n'
                           << test::describe (loops.conditions()));
            CHECK ((loops.growth (40'000) > 1.0) == (factor > 1.0));
            CHECK (isJudgedUnstable (loops.conditions()) == (factor > 1.0));
        }
    }
}

TEST_CASE ("a virtual damper is judged by the mass at the motor if the structure bends", "[check]")
{
    const auto judged = [] (const Simulation& tool, double b) {
        Loops loops { .tools = { tool } };
        loops.pull ("h0.x", "h0.x", b / T);
        loops.pull ("h0.x", "h0.x", -b / T, 1);
        const auto all = loops.conditions();
        const auto damping = std::ranges::find (all, "damping", &check::Condition::id);
        REQUIRE (damping != all.end());
        return std::pair (loops.growth (4000) > 1.5, damping->verdict == check::Verdict::broken);
    };
    const Simulation rigid { .mass = 0.1, .damping = 0.1 };
    const Simulation bends { .mass = 0.1, .damping = 0.1, .first_mode = 30.0 }, light { .mass = 0.1, .damping = 0.1, .first_mode = 30.0, .end_mass = 0.08 };
    for (const auto& [tool, at_motor] : { std::pair (rigid, 0.1), std::pair (bends, 0.05), std::pair (light, 0.02) })
    {
        INFO ("motor mass " << at_motor << " kg");
        const double limit = 0.1 + 2.0 * at_motor / T;
        CHECK (judged (tool, 0.97 * limit) == std::pair (false, false));
        CHECK (judged (tool, 1.03 * limit) == std::pair (true, true));
    }
}
