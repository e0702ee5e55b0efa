// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include "loops.hpp"

using namespace tactus;
using test::Loops;

namespace
{
/// A table of force over x.
Loops table (const char* x, const char* force, const Simulation& tool)
{
    Loops loops { .tools = { tool } };
    loops.nodes.push_back (std::string (R"("table": { "type": "signal.map", "settings": { "curve": [)") + x + ", " + force + "] } }");
    loops.wire ("h0_at.position.x", "table.in", "1 1/m");
    loops.wire ("table.out", "h0_motor.force.x", "1 N");
    return loops;
}

/// A relay: a force that steps at x = 0.
Loops relay (double force, const Simulation& tool)
{
    Loops loops { .tools = { tool } };
    loops.nodes.push_back (R"("relay": { "type": "signal.trigger" })");
    loops.wire ("h0_at.position.x", "relay.in", "1 1/m");
    loops.wire ("relay.gate", "h0_motor.force.x", std::to_string (force) + " N");
    return loops;
}

const check::Condition* find (const std::vector<check::Condition>& all, std::string_view id)
{
    const auto at = std::ranges::find (all, id, &check::Condition::id);
    return at == all.end() ? nullptr : &*at;
}

double valueOf (const std::vector<check::Condition>& all, std::string_view id)
{
    const auto* c = find (all, id);
    INFO (id << '\n'
             << test::describe (all));
    REQUIRE (c != nullptr);
    return c->value;
}
}   // namespace

TEST_CASE ("a narrow stiff place between the points of the path is found", "[check]")
{
    // 0.5 N over 20 um: 25 kN/m, at a place that the hand passes in a fraction of a tick
    const auto loops = table ("[-1, 0.00123, 0.00125, 1]", "[0, 0, -0.5, -0.5]", { .mass = 0.1, .damping = 1.0 });
    const auto all = loops.conditions();
    INFO (test::describe (all));
    CHECK (valueOf (all, "stiffness") == Approx (25e3 * 0.5e-3).epsilon (1e-3));
    CHECK (test::brokenIds (all).find ("h0:stiffness") != std::string::npos);
}

TEST_CASE ("a force that steps with the position counts as its step over the quantum of the sensor", "[check]")
{
    const auto all = relay (-0.3, { .mass = 0.1, .damping = 1.0, .quantum = 1e-5 }).conditions();
    INFO (test::describe (all));
    CHECK (valueOf (all, "jump") == Approx (0.3 / 1e-5 * 0.5e-3).epsilon (1e-3));
    CHECK (find (all, "jump")->node.empty());   // no node computes a force here: the wire does
    CHECK (find (all, "jump")->verdict == check::Verdict::broken);
    CHECK (find (all, "jump")->remedy.find ("rises over at least 0.15 mm") != std::string::npos);

    // The same step over the width that the remedy gives is within the condition.
    CHECK (find (table ("[-1, 0, 0.00016, 1]", "[0, 0, -0.3, -0.3]", { .mass = 0.1, .damping = 1.0, .quantum = 1e-5 }).conditions(), "jump") == nullptr);
    CHECK (find (relay (0.3, { .mass = 0.1, .damping = 1.0, .quantum = 1e-5 }).conditions(), "jump") == nullptr);   // pushes along the motion
}

TEST_CASE ("'d_max' is judged at the stretch at which the load lets the contact slide", "[check]")
{
    const auto drag = [] (const char* load, const char* params) {
        Loops loops { .tools = { { .mass = 0.1, .damping = 50.0, .quantum = 2e-5, .coulomb = 1.0 } } };
        loops.nodes.push_back (std::string (R"("drag": { "type": "friction.elasto_plastic", "params": { "mu": 0.5, "d_max": 1e-4, )") + params + " } }");
        loops.nodes.push_back (std::string (R"("load": { "type": "signal.constant", "params": { "value": ")") + load + R"(" } })");
        loops.wire ("load.out", "drag.normal_force");
        loops.wire ("h0_at.position", "drag.position");
        loops.wire ("drag.force", "h0_motor.force");
        return loops.conditions();
    };
    CHECK (find (drag ("1 N", R"("load": "bound")"), "d_max")->verdict == check::Verdict::close);
    CHECK (find (drag ("1 N", R"("load": "bound")"), "d_max")->limit == Approx (1e-4).epsilon (1e-6));
    CHECK (find (drag ("0.1 N", R"("load": "bound")"), "d_max")->limit == Approx (1e-5).epsilon (1e-6));
    CHECK (find (drag ("0.1 N", R"("load": "bound")"), "d_max")->verdict == check::Verdict::broken);
    CHECK (find (drag ("0.1 N", R"("load": "scale")"), "d_max")->limit == Approx (1e-4).epsilon (1e-6));
    CHECK (find (drag ("1 N", R"("load": "bound", "static_ratio": 1.1)"), "d_max")->limit == Approx (1e-5).epsilon (1e-6));   // teeth
}

TEST_CASE ("a surface that drags its contact along is judged like a friction", "[check]")
{
    Loops loops { .tools = { { .mass = 0.1, .damping = 50.0, .quantum = 1e-5, .coulomb = 1.0 } } };
    loops.nodes.push_back (R"("pad": { "type": "deform.surface" })");
    loops.wire ("h0_at.position", "pad.position");
    loops.wire ("pad.force", "h0_motor.force");
    const auto all = loops.conditions();
    INFO (test::describe (all));
    REQUIRE (find (all, "d_max") != nullptr);
    CHECK (find (all, "d_max")->node == "pad");
    CHECK (find (all, "d_max")->limit > 1e-5);
    CHECK (find (all, "d_max")->limit < 0.5 * 0.011);   // mu_c is 0.5, and the tool goes no deeper than its path
}

TEST_CASE ("a deadbeat wall is not judged by its slope but by mass, delay and quantum", "[check]")
{
    const auto wall = [] (const Simulation& tool, const char* mass) {
        Loops loops { .tools = { tool } };
        loops.nodes.push_back (std::string (R"("wall": { "type": "hold.deadbeat", "params": { "stiffness": "40 N/mm", "mass": )") + mass + " } }");
        loops.wire ("h0_at.position", "wall.position");
        loops.wire ("wall.force", "h0_motor.force");
        return loops.conditions();
    };
    const Simulation good { .mass = 0.1, .damping = 2.0, .coulomb = 0.6 };
    CHECK (test::brokenIds (wall (good, "0.1")).empty());
    CHECK (test::brokenIds (wall (good, "0")).empty());
    CHECK (test::brokenIds (wall (good, "0.15")) == "h0:deadbeat");
    CHECK (test::brokenIds (wall ({ .mass = 0.1, .damping = 2.0, .delay = 1, .coulomb = 0.6 }, "0.1")) == "h0:deadbeat");
    CHECK (test::brokenIds (wall ({ .mass = 0.1, .damping = 2.0, .quantum = 1e-5, .coulomb = 0.6 }, "0.1")).empty());
    CHECK (test::brokenIds (wall ({ .mass = 0.1, .damping = 2.0, .quantum = 2e-5, .coulomb = 0.6 }, "0.1")) == "h0:deadbeat");
}

TEST_CASE ("a deadbeat wall must know the whole delay, that of the device and that of the wires", "[check]")
{
    const auto wall = [] (int of_device, int of_wire, int known) {
        Loops loops { .tools = { { .mass = 0.1, .damping = 2.0, .delay = of_device, .coulomb = 0.6 } } };
        const auto delay = R"("settings": { "delay": )" + std::to_string (known) + " }";
        loops.nodes.push_back (R"("wall": { "type": "hold.deadbeat", "params": { "stiffness": "4 N/mm" }, )" + delay + " }");
        loops.wire ("h0_at.position", "wall.position", "1", of_wire);
        loops.wire ("wall.force", "h0_motor.force");
        return test::brokenIds (loops.conditions());
    };
    CHECK (wall (0, 0, 0).empty());
    CHECK (wall (1, 0, 1).empty());
    CHECK (wall (1, 1, 2).empty());
    CHECK (wall (1, 0, 0) == "h0:deadbeat");
    CHECK (wall (0, 0, 1) == "h0:deadbeat");
    CHECK (wall (1, 1, 1) == "h0:deadbeat");
}

TEST_CASE ("a motion that ran away is refused, with the reason", "[check]")
{
    Loops loops { .tools = { { .mass = 0.1, .damping = 1.0 } } };
    loops.ground ("h0.x", 1e5);
    auto graph = loops.graph();
    const Json hand { { "stiffness", 100.0 }, { "path", "stroke" } };
    graph.devices.emplace_back ("h0", Json { { "driver", "sim" }, { "mass", 0.1 }, { "damping", 1.0 }, { "hand", hand } });
    const auto recorded = check::recordMotion ({ graph, catalogue() }, {}, ".");
    INFO (test::text (recorded.messages));
    CHECK (test::has (recorded.messages, "check/diverged"));
    CHECK (recorded.motion.ticks == 0);

    check::HandMotion calm { .rate_hz = 1000.0, .ticks = 2, .roles = { { .role = "h0", .readings = { Reading {}, Reading {} } } } };
    CHECK (check::divergence (calm).empty());
    calm.roles[0].readings[1].position.x() = 0.5;
    CHECK (check::divergence (calm).empty());
    const std::vector<check::Reach> reach { { "h0", Vec3 (Vec3::Constant (-0.1)), Vec3 (Vec3::Constant (0.1)) } };
    CHECK (test::has (check::divergence (calm, reach), "check/diverged"));
    calm.roles[0].readings[1].position.x() = std::nan ("");
    CHECK (test::has (check::divergence (calm), "check/diverged"));
}
