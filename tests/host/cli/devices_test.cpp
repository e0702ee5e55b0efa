// SPDX-License-Identifier: MIT
// Real devices on the command line, on a machine without any. ./test.sh --devices uses some.

#include "program.hpp"

#include <tactus/text/json.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using test::runTactus;
using test::Scratch;

namespace
{
const std::string wood = TACTUS_SOURCE_DIR "/graphs/dry_wood.json";

bool holds (const std::string& text, const std::string& part) { return text.find (part) != std::string::npos; }
}   // namespace

TEST_CASE ("the list of devices is never empty, and is JSON on request", "[cli][hid]")
{
    const auto plain = runTactus ({ "devices" });
    CHECK (plain.status == 0);
    CHECK (plain.err.empty());   // all profiles that come with Tactus are readable
    CHECK_FALSE (plain.out.empty());
    const auto json = runTactus ({ "devices", "--json" });
    CHECK (json.status == 0);
    CHECK (Json::parse (json.out).is_array());
}

TEST_CASE ("a run with an absent device reports it, and lists the devices that are present", "[cli][hid]")
{
    Scratch scratch;
    const auto device = scratch.write ("device.json", R"({"driver": "hid", "profile": "tactus_board", "serial": "no such device"})");
    const auto absent = runTactus ({ "play", wood, "--osc", "off", "--duration", "1", "--device", "stylus=" + device });
    CHECK (absent.status == 1);
    CHECK (holds (absent.err, "hid/not_connected"));
    CHECK (holds (absent.err, "with serial number no such device"));

    const auto misspelt = runTactus ({ "play", wood, "--osc", "off", "--duration", "1", "--device", "stylus=hid:tactus_bord" });
    CHECK (misspelt.status == 1);
    CHECK (holds (misspelt.err, "hid/unknown_profile"));
    CHECK (holds (misspelt.err, "did you mean 'tactus_board'?"));

    const auto no_clock = runTactus ({ "play", wood, "--osc", "off", "--duration", "1", "--clock", "stylus" });
    CHECK (no_clock.status == 1);
    CHECK (holds (no_clock.err, "run/no_clock"));
}

TEST_CASE ("a render refuses a real device, and says what to do instead", "[cli][hid]")
{
    const auto refused = runTactus ({ "render", wood, "--duration", "1", "--device", "stylus=hid:auto" });
    CHECK (refused.status == 1);
    CHECK (holds (refused.err, "device/real"));
    CHECK (holds (refused.err, "sim"));
}

TEST_CASE ("a graph that names a real device is valid on any machine", "[cli][hid]")
{
    Scratch scratch;
    const auto graphWith = [&] (const std::string& profile) {
        return scratch.write ("graph.json", R"({ "format": "tactus-graph", "version": 1, "rate_hz": 1000,
            "devices": { "tool": { "driver": "hid", "profile": ")"
                                                + profile + R"(", "guard": { "max_force": "1 N" } } },
            "nodes": { "hand": { "type": "device.position", "role": "tool" }, "wall": { "type": "deform.plane" },
                "motor": { "type": "device.force", "role": "tool" } },
            "wires": ["hand.position -> wall.position", "wall.force -> motor.force"] })");
    };
    CHECK (runTactus ({ "validate", graphWith ("tactus_board") }).status == 0);
    CHECK (runTactus ({ "validate", graphWith ("auto") }).status == 0);
    const auto unknown = runTactus ({ "validate", graphWith ("tactus_bord") });
    CHECK (unknown.status == 1);
    CHECK (holds (unknown.err, "hid/unknown_profile"));
}
