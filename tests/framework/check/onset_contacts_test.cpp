// SPDX-License-Identifier: MIT
// The sampled loop of contacts other than a plain wall, with the response that measure() finds.
#include <support/property.hpp>
#include <tactus/check/hands.hpp>
#include <tactus/check/judge.hpp>
#include <tactus/check/judging/contact_changes.hpp>
#include <tactus/check/sampled_loop.hpp>

#include "onset.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

using namespace tactus;
using namespace tactus::test;

namespace
{
/// A kind of contact along z, of which one stiffness is varied.
struct Contact
{
    std::function<graph::Graph (double stiffness)> graph;
    std::function<double (double stiffness)> settled;   // N/m, of the whole contact
};

Sketch driven (const std::string& force)
{
    Sketch s;
    s.node ("hand", "device.position").node ("motor", "device.force");
    for (auto& node : s.graph.root.nodes)
        node.role = "tip";
    s.wire (force + " -> motor.force");
    return s;
}

graph::Graph predictive (double stiffness, double damping, double rate_hz)
{
    auto s = driven ("hold.out");
    s.node ("wall", "deform.plane", { { "stiffness", stiffness }, { "damping", damping } }).node ("hold", "hold.predictive", { { "limit", 1e6 } });
    s.wire ("hand.position -> wall.position").wire ("wall.force -> hold.in");
    s.graph.rate_hz = rate_hz;
    return s.graph;
}

graph::Graph damped (double stiffness, double damping, double rate_hz)
{
    auto s = driven ("wall.force");
    s.node ("wall", "deform.plane", { { "stiffness", stiffness }, { "damping", damping } }).wire ("hand.position -> wall.position");
    s.graph.rate_hz = rate_hz;
    return s.graph;
}

graph::Graph coupled (double stiffness, double damping, double wall, double rate_hz)
{
    auto s = driven ("wall.force");
    s.node ("wall", "coupling.virtual", { { "stiffness", stiffness }, { "damping", damping }, { "wall_stiffness", wall } });
    s.wire ("hand.position -> wall.position");
    s.graph.rate_hz = rate_hz;
    return s.graph;
}

/// Measures a contact where a tool is pressed into it, whether it would rest there or not.
check::Demand demandOf (const graph::Graph& graph, Simulation pressed)
{
    pressed.mass = 1e9;   // so that it stays there
    SimulatedDevice still { pressed };
    const std::vector<check::Hand> hands { { "tip", still } };
    const auto motion = check::recordMotion (compile (graph, catalogue()).plan, hands, 8);
    return check::measure ({ graph, catalogue() }, motion, { .places = 1, .at_s = 7.0 / graph.rate_hz });
}

/// The stiffness at which the measured loop begins to swing without a hand, in N/m.
double onset (const Contact& contact, const Simulation& sim, double rate_hz)
{
    double low = 1e-3 * sim.damping * rate_hz, high = 8.0 * sim.mass * rate_hz * rate_hz;
    for (int i = 0; i < 16; ++i)
    {
        const double middle = std::sqrt (low * high);
        const auto demand = demandOf (contact.graph (middle), resting (sim, contact.settled (middle)));
        const auto& slopes = demand.roles.at (0).slopes;
        REQUIRE (slopes.size() == 1);
        REQUIRE (slopes[0].responses.size() == 1);
        const auto radius = check::loopRadius (slopes[0].responses[0], numbersOf (sim), 1.0 / rate_hz, {});
        (radius.value() <= check::at_rest ? low : high) = middle;
    }
    return std::sqrt (low * high);
}

check::Condition stiffnessOf (const graph::Graph& graph, const Simulation& pressed)
{
    const auto all = check::judge (demandOf (graph, pressed), std::vector<check::RoleDevice> { { "tip", numbersOf (pressed), "sim" } });
    return *std::ranges::find (all, "stiffness", &check::Condition::id);
}
}   // namespace

TEST_CASE ("damped walls, walls with the predictive hold and virtual couplings begin to swing where their measured loops do", "[check]")
{
    property ("kinds, rates, delays", [] {
        const double rate_hz = *between (500.0, 20e3), mass = *between (0.03, 0.5), share = *between (0.01, 0.3);
        const int kind = *rc::gen::inRange (0, 4), delay = *rc::gen::inRange (0, 6);
        const Simulation sim { .mass = mass, .damping = share * mass * rate_hz, .delay = delay };
        const double b = *between (0.1, 2.0) * std::min (sim.damping, 0.05 * mass * rate_hz), wall = *between (0.1, 1e3) * mass * rate_hz * rate_hz;
        const auto itself = [] (double k) { return k; };
        const Contact kinds[] {
            { [=] (double k) { return damped (k, b, rate_hz); }, itself },
            { [=] (double k) { return predictive (k, 0.0, rate_hz); }, itself },
            { [=] (double k) { return predictive (k, b, rate_hz); }, itself },
            { [=] (double k) { return coupled (k, b, wall, rate_hz); }, [=] (double k) { return k * wall / (k + wall); } },
        };
        const auto& contact = kinds[kind];
        const double limit = onset (contact, sim, rate_hz);
        RC_PRE (limit < 4.0 * mass * rate_hz * rate_hz);   // else a soft wall behind the coupling never swings
        const auto at = [&] (double part) { return lateRanges (contact.graph (part * limit), resting (sim, contact.settled (part * limit))); };
        const auto below = at (0.98), above = at (1.02);
        RC_LOG() << "kind " << kind << ", rate " << rate_hz << ", delay " << delay << ", limit " << limit << " N/m, at 0.98: " << below[0] << " to " << below[1]
                 << " m, at 1.02: " << above[0] << " to " << above[1] << " m\n";
        constexpr double rounding = 1e-12;   // m
        RC_ASSERT (below[1] < std::max (rounding, 0.999 * below[0]));
        const double bounce = 0.5 * pressing_n / contact.settled (limit);   // m; a swing as large as this soon leaves the wall, and grows no more
        RC_ASSERT (above[1] > std::max (rounding, std::min (0.999 * above[0], bounce)));
    });
}

TEST_CASE ("a wall of 20 kN/m rests with the predictive hold and bounces without it, and the check says so", "[check]")
{
    const auto pressed = resting ({ .mass = 0.1, .damping = 2.0 }, 20e3);
    const auto held = predictive (20e3, 0.0, 1000.0), plain = damped (20e3, 0.0, 1000.0);
    CHECK (lateRanges (held, pressed)[1] < 1e-12);
    CHECK (stiffnessOf (held, pressed).verdict == check::Verdict::stable);
    CHECK (lateRanges (plain, pressed)[1] > 0.5 / 20e3);
    CHECK (stiffnessOf (plain, pressed).verdict == check::Verdict::unstable);
}

TEST_CASE ("a pure damper that is not passive, but does not swing, is stable", "[check]")
{
    // A wall of no stiffness: only its damping is felt. Footnote 2 of the chapter: up to 2M/T + 4B/3, 202.7 N s/m here.
    const Simulation arm { .mass = 0.1, .damping = 2.0, .position = { 0, 0, -0.01 } };
    const auto demand = demandOf (damped (0.0, 50.0, 1000.0), arm);
    const auto& slope = demand.roles.at (0).slopes.at (0);
    CHECK (slope.stiffness == 0.0);
    CHECK (slope.damping == Approx (50.0));
    REQUIRE (slope.responses.size() == 1);
    CHECK (slope.responses[0][0] == Approx (50e3));
    CHECK (slope.responses[0][1] == Approx (0.0).margin (1.0));
    CHECK (stiffnessOf (damped (0.0, 1.9, 1000.0), arm).verdict == check::Verdict::passive);
    const auto stable = stiffnessOf (damped (0.0, 50.0, 1000.0), arm);
    CHECK (stable.verdict == check::Verdict::stable);
    CHECK (stable.margin() == Approx (202.68 / 50.0).epsilon (0.01));

    const Simulation late { .mass = 0.1, .damping = 2.0, .delay = 3, .position = { 0, 0, -0.01 } };   // so late that it swings far below 2M/T
    CHECK (stiffnessOf (damped (0.0, 50.0, 1000.0), late).verdict == check::Verdict::unstable);
}

TEST_CASE ("a wall that is damped along another axis than it is stiff is judged along both", "[check]")
{
    auto graph = damped (3e3, 0.0, 1000.0);
    Sketch s;
    s.graph = std::move (graph);
    s.node ("drag", "deform.plane", { { "stiffness", 0.0 }, { "damping", 250.0 }, { "normal", Json::array ({ 1.0, 0.0, 0.0 }) }, { "offset", 1.0 } });
    s.wire ("hand.position -> drag.position").wire ("drag.force -> motor.force");
    const auto pressed = resting ({ .mass = 0.1, .damping = 2.0 }, 3e3);
    const auto demand = demandOf (s.graph, pressed);
    CHECK (demand.roles.at (0).slopes.at (0).responses.size() == 2);
    s = Sketch {};
    s.graph = damped (3e3, 0.0, 1000.0);
    CHECK (demandOf (s.graph, pressed).roles.at (0).slopes.at (0).responses.size() == 1);
}

TEST_CASE ("a wall that rests at the corners of the range of fingertips rests with every fingertip between them", "[check]")
{
    property ("walls, devices, fingertips", [] {
        const double rate_hz = *between (500.0, 20e3), mass = *between (0.01, 1.0), b = *rc::gen::element (0.0, 1.0) * *between (1e-3, 1.5) * mass * rate_hz;
        Simulation sim { .mass = mass, .damping = *between (1e-3, 0.5) * mass * rate_hz, .delay = *rc::gen::inRange (0, 6) };
        if (*rc::gen::arbitrary<bool>()) sim.first_mode = *between (0.005, 0.1) * rate_hz;
        const double k = *between (1e-3, 1.0) * mass * rate_hz * rate_hz;
        const auto response = [&] (double factor) { return std::vector { factor * (k + b * rate_hz), factor * k }; };
        const double limit = check::roomToGrow ([&] (double factor) { return check::comesToRest (response (factor), numbersOf (sim), 1.0 / rate_hz); });
        const check::HeldHand hand { 6e-3, *between (2.0, 4.0), *between (200.0, 800.0) };
        RC_ASSERT (limit == 0.0 || check::loopRadius (response (0.98 * limit), numbersOf (sim), 1.0 / rate_hz, hand).value() <= check::at_rest);
    });
}

TEST_CASE ("the change with the largest effect on a wall does what is said of it", "[check]")
{
    const Simulation arm { .mass = 0.1, .damping = 2.0 };
    const auto roomOf = [&] (const graph::Graph& graph, double stiffness) {
        const auto demand = demandOf (graph, resting (arm, stiffness));
        const auto& response = demand.roles.at (0).slopes.at (0).responses.at (0);
        return check::roomToGrow ([&] (double factor) {
            auto larger = response;
            for (double& v : larger)
                v *= factor;
            return check::comesToRest (larger, numbersOf (arm), 1.0 / graph.rate_hz);
        });
    };
    const auto best = [&] (double stiffness, double damping) {
        const std::vector response { stiffness + 1e3 * damping, stiffness };
        return check::strongestChange (response, numbersOf (arm), 1e-3).value();
    };
    const auto predicts = best (7e3, 1.0), faster = best (20e3, 20.0);
    CHECK (predicts.what == "a hold.predictive");
    CHECK (predicts.room == Approx (roomOf (predictive (7e3, 1.0, 1e3), 7e3)).epsilon (0.01));
    CHECK (faster.what == "twice the rate");
    CHECK (faster.room == Approx (roomOf (damped (20e3, 20.0, 2e3), 20e3)).epsilon (0.01));
    CHECK (stiffnessOf (damped (7e3, 1.0, 1e3), resting (arm, 7e3)).remedy.find ("largest effect on the loop: a hold.predictive") == 0);

    // A contact that is far too stiff is not helped by half of its stiffness.
    const auto far = stiffnessOf (damped (7e5, 1.0, 1e3), resting (arm, 7e5));
    CHECK (far.verdict == check::Verdict::unstable);
    CHECK (far.remedy.find ("at most 0.0") == 0);
    CHECK (far.remedy.find ("times this stiffness and virtual damping") != std::string::npos);

    auto late = numbersOf (arm);
    late.delay.emplace();
    late.delay->value = 5.0;
    const std::vector soft { 500.0 };
    CHECK (check::strongestChange (soft, late, 1e-3).value().what.size() > 0);
    CHECK_FALSE (check::strongestChange (soft, {}, 1e-3));
}
