// SPDX-License-Identifier: GPL-3.0-or-later
// Axes, buttons and signals of devices, on the command line.

#include "running.hpp"

#include <catch2/catch.hpp>

#include <sstream>

using tactus::test::runTactus;
using tactus::test::Scratch;
using tactus::test::textOf;

namespace
{
/// A trigger that the hand pulls against a spring in the graph.
std::string lever (const std::string& device)
{
    return R"({ "format": "tactus-graph", "version": 1, "rate_hz": 1000, "devices": { "pad": )" + device + R"( },
      "nodes": { "lever": { "type": "device.axis", "role": "pad", "settings": { "axis": "trigger" } },
        "grip": { "type": "device.button", "role": "pad", "settings": { "button": "1" } },
        "spring": { "type": "signal.gain", "params": { "gain": -300 } },
        "brake": { "type": "device.effort", "role": "pad", "settings": { "axis": "trigger" } },
        "click": { "type": "device.signal_out", "role": "pad" } },
      "wires": [ { "wire": "lever.axis -> spring.in" }, "spring.out -> brake.effort", "grip.pressed -> click.in" ] })";
}

const std::string sim = R"({ "driver": "sim", "axes": { "trigger": { "mass": "20 g", "damping": 4.0, "hand_force": "1.5 N" } }, "signal_outputs": 1 })";

/// The number of lines that contain this text.
long lines (const std::string& all, const std::string& text)
{
    std::istringstream in (all);
    long found = 0;
    for (std::string line; std::getline (in, line);)
        found += line.find (text) != std::string::npos;
    return found;
}
}   // namespace

TEST_CASE ("an axis of a device is pulled by the hand and pushed by the graph", "[cli][devices]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", lever (sim));
    const auto ran = runTactus ({ "render", file, "--duration", "0.5", "--record", "lever.axis", "--out", scratch.path ("out.csv") });
    INFO (ran.err);
    CHECK (ran.status == 0);
    CHECK (lines (ran.err, "[device/missing_part]") == 1);
    CHECK (lines (ran.err, "'grip' (device.button): the device of the role 'pad'") == 1);
    const auto csv = textOf (scratch.path ("out.csv"));
    const auto last = std::stod (csv.substr (csv.rfind (',') + 1));
    CHECK (last == Approx (1.5 / 300.0).epsilon (1e-3));
}

TEST_CASE ("parts that a device lacks are reported together with the parts that it has, and the run continues", "[cli][devices]")
{
    const Scratch scratch;
    scratch.write ("pad.csv", "t,x,y,z,triger,button1\n0,0,0,0,0.5,1\n1,0,0,0,0.5,1\n");
    const auto file = scratch.write ("g.json", lever (R"({ "driver": "trace", "path": "pad.csv" })"));
    const auto ran = runTactus ({ "render", file, "--record", "lever.axis,grip.pressed", "--out", scratch.path ("out.csv") });
    INFO (ran.err);
    CHECK (ran.status == 0);
    CHECK (lines (ran.err, "[device/missing_part]") == 3);
    CHECK (lines (ran.err, "'lever' (device.axis): the device of the role 'pad' has no axis 'trigger' (did you mean 'triger'?)") == 1);
    CHECK (lines (ran.err, "'brake' (device.effort): the device of the role 'pad'") == 1);
    CHECK (lines (ran.err, "'click' (device.signal_out): the device of the role 'pad'") == 1);
    CHECK (textOf (scratch.path ("out.csv")).find ("\n0.5,0,1\n") != std::string::npos);
}

TEST_CASE ("a run with axes is repeated from its log, byte for byte", "[cli][devices][replay]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", lever (sim));
    const auto live = runTactus ({ "play", file, "--osc", "off", "--duration", "0.3", "--record", "lever.axis,spring.out",
                                   "--out", scratch.path ("live.csv"), "--log", scratch.path ("run.jsonl") });
    INFO (live.err);
    REQUIRE (live.status == 0);
    const auto again = runTactus ({ "render", "--replay", scratch.path ("run.jsonl"), "--record", "lever.axis,spring.out",
                                    "--out", scratch.path ("again.csv") });
    INFO (again.err);
    CHECK (again.status == 0);
    CHECK (textOf (scratch.path ("live.csv")).size() > 1000);
    CHECK (tactus::test::sameRows (scratch.path ("live.csv"), scratch.path ("again.csv"), live.err));
}
