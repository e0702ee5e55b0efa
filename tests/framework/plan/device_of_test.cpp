// SPDX-License-Identifier: MIT
// Which device a node learns of, and when.

#include <tactus/run/device/sim.hpp>
#include <tactus/run/engine.hpp>

#include "support/sketch.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

using namespace tactus;
using test::has;
using test::Sketch;

namespace
{
/// Two tools, and a shock node that takes its mass from the device. The tool `hand` triggers the shock through several nodes.
Sketch struck (const std::string& hand)
{
    Sketch s;
    for (const auto* role : { "left", "right" })
    {
        s.node (role, "device.position").node (std::string (role) + "_motor", "device.force");
        for (auto& n : s.graph.root.nodes)
            if (n.name == role || n.name == std::string (role) + "_motor") n.role = role;
    }
    s.node ("wall", "deform.plane").node ("pulse", "signal.trigger", { { "threshold", 0.5 }, { "speed", 0.3 } });
    s.node ("blow", "shock.hunt_crossley", { { "mass", 0 } });
    s.wire (hand + ".position -> wall.position").wire ("wall.state -> pulse.in").wire ("pulse.hit -> blow.hit");
    return s;
}

/// A tool that moves into the wall at the same speed, whatever its mass.
SimulatedDevice tool (double mass)
{
    return SimulatedDevice ({ .mass = mass, .damping = 0.0, .position = { 0.0, 0.0, 1e-5 }, .velocity = { 0.0, 0.0, -0.1 } });
}

/// The forces of the shock with tools of these masses. If `own_mass` is not 0, the node uses it instead.
std::vector<double> blow (const Sketch& sketch, double left, double right, double own_mass = 0.0)
{
    auto s = sketch;
    for (auto& n : s.graph.root.nodes)
        if (n.name == "blow") n.params["mass"] = own_mass;
    const auto compiled = s.compile ({ .records = { "blow.resistance" } });
    INFO (test::text (compiled.messages));
    REQUIRE (compiled.plan);
    Engine engine { compiled.plan };
    auto a = tool (left), b = tool (right);
    engine.attach ("left", a, {});
    engine.attach ("right", b, {});
    std::vector<double> forces;
    for (int k = 0; k < 30; ++k)
    {
        engine.tick();
        forces.push_back (*engine.plan().taps()[0].value);
    }
    REQUIRE (*std::max_element (forces.begin(), forces.end()) > 0.0);
    return forces;
}
}   // namespace

TEST_CASE ("a node learns the numbers of the device from which its inputs come, through other nodes", "[plan][devices]")
{
    CHECK (blow (struck ("left"), 0.02, 0.2) == blow (struck ("left"), 0.5, 0.5, 0.02));
    CHECK (blow (struck ("right"), 0.02, 0.2) == blow (struck ("right"), 0.5, 0.5, 0.2));
    CHECK (blow (struck ("right"), 0.02, 0.2) != blow (struck ("left"), 0.02, 0.2));
}

TEST_CASE ("a node without inputs from a device learns the numbers of the device to which its outputs go", "[plan][devices]")
{
    Sketch s;
    s.node ("beat", "signal.lfo", { { "frequency", 200 } }).node ("pulse", "signal.trigger", { { "threshold", 0.5 }, { "speed", 0.3 } });
    s.node ("blow", "shock.hunt_crossley", { { "mass", 0 } }).node ("left_motor", "device.force").node ("right_motor", "device.force");
    for (auto& n : s.graph.root.nodes)
        if (n.name.ends_with ("_motor")) n.role = n.name.substr (0, n.name.find ('_'));
    s.wire ("beat.out -> pulse.in").wire ("pulse.hit -> blow.hit").wire ("blow.resistance -> right_motor.force.z").wire ("beat.out -> left_motor.force.x");
    CHECK (blow (s, 0.02, 0.2) == blow (s, 0.5, 0.5, 0.2));
}

TEST_CASE ("a node learns the numbers of the new device when an edit rewires it", "[plan][devices][edit]")
{
    const CompileOptions options { .records = { "blow.resistance" } };
    auto before = struck ("left");
    const auto first = before.compile (options);
    REQUIRE (first.plan);
    Engine engine { first.plan };
    auto a = tool (0.02), b = tool (0.2);
    engine.attach ("left", a, {});
    engine.attach ("right", b, {});

    auto after = before;
    for (auto& w : after.graph.root.wires)
        if (graph::toText (w).starts_with ("left.position")) w = *graph::parseWire ("right.position -> wall.position");
    auto next = options;
    next.before = &engine.newest();
    const auto second = after.compile (next);
    REQUIRE (second.plan);
    engine.submit (second.plan);
    std::vector<double> forces;
    for (int k = 0; k < 30; ++k)
    {
        engine.tick();
        forces.push_back (*engine.plan().taps()[0].value);
    }
    CHECK (forces == blow (struck ("right"), 0.5, 0.2));
}

TEST_CASE ("the wall's warning of a rate too low uses the mass that the graph describes", "[plan][devices]")
{
    auto s = struck ("left");
    for (auto& n : s.graph.root.nodes)
    {
        if (n.name == "blow") n.params["mass"] = 0.05;
        if (n.name == "wall")
        {
            n.params["dissipation"] = 1.0;
            n.settings["law"] = { { "power", { 5e5, 1.5 } } };
        }
    }
    s.graph.rate_hz = 1000.0;
    CHECK_FALSE (has (s.compile().messages, "node/warning"));
    s.graph.devices = { { "right", { { "driver", "sim" }, { "mass", "50 g" } } } };
    CHECK_FALSE (has (s.compile().messages, "node/warning"));   // this describes only the other tool
    s.graph.devices.push_back ({ "left", { { "driver", "sim" }, { "mass", "50 g" } } });
    const auto messages = s.compile().messages;
    REQUIRE (has (messages, "node/warning"));
    CHECK (messages[0].where == "/nodes/wall");
    CHECK (messages[0].text.find ("3800 Hz") != std::string::npos);
    s.graph.rate_hz = 4000.0;
    CHECK_FALSE (has (s.compile().messages, "node/warning"));
    s.graph.devices[1].second["mass"] = "no mass";   // the error is reported only when the device is made
    CHECK_FALSE (has (s.compile().messages, "node/warning"));
}

TEST_CASE ("a node that compensates less than the delay of its device is named in a warning", "[plan]")
{
    const auto warned = [] (int of_device, int of_node) {
        Sketch s;
        s.node ("hand", "device.position").node ("wall", "hold.deadbeat", Json::object(), { { "delay", of_node } }).node ("motor", "device.force");
        for (auto& n : s.graph.root.nodes)
            if (n.name != "wall") n.role = "stylus";
        s.graph.devices.emplace_back ("stylus", Json { { "driver", "sim" }, { "delay", of_device } });
        return has (s.wire ("hand.position -> wall.position").wire ("wall.force -> motor.force").compile().messages, "rate/device_delay");
    };
    CHECK (warned (2, 0));
    CHECK (warned (2, 1));
    CHECK_FALSE (warned (2, 2));
    CHECK_FALSE (warned (2, 3));
    CHECK_FALSE (warned (0, 0));
}
