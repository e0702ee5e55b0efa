// SPDX-License-Identifier: GPL-3.0-or-later
// Real devices on the command line, on a machine without any. ./test.sh --devices uses some.

#include "program.hpp"

#include <tactus/text/json.hpp>

#include <catch2/catch.hpp>

#include <algorithm>

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

TEST_CASE ("a graph that names a real device runs on any machine, opens nothing, and says which option does", "[cli][hid]")
{
    Scratch scratch;
    const auto graphWith = [&] (const std::string& file, const std::string& device, const std::string& more = "") {
        return scratch.write (file, R"({ "format": "tactus-graph", "version": 1, "rate_hz": 1000,
            "devices": { "tool": )" + device
                                        + R"( },
            "nodes": { )" + more + R"( "hand": { "type": "device.position", "role": "tool" }, "wall": { "type": "deform.plane" },
                "motor": { "type": "device.force", "role": "tool" } },
            "wires": ["hand.position -> wall.position", "wall.force -> motor.force"] })");
    };
    const auto hid = [] (const std::string& more) { return R"({ "driver": "hid", )" + more + " }"; };
    const auto rests = [] (const test::Ran& ran, const std::string& option) {
        INFO (ran.err);
        CHECK (ran.status == 0);
        CHECK (holds (ran.err, "device/not_by_graph"));
        CHECK (holds (ran.err, option));
        CHECK_FALSE (holds (ran.err, "hid/"));
        CHECK_FALSE (holds (ran.err, "pid/"));
    };
    const std::string calibrated = R"("profile": "pid", "calibration": { "full_force": "0.001 N" })";
    const std::pair<std::string, std::string> named[] {
        { hid (R"("profile": "tactus_board", "guard": { "max_force": "1 N" })"), "--device tool=hid:tactus_board " },
        { hid (R"("profile": "auto")"), "--device tool=hid:auto " },
        { hid (R"("profile": "tactus_bord", "serial": 3)"), "--device tool=hid:tactus_bord " },
        { hid (calibrated), "--device tool=hid:pid " },
        { hid (R"("guard": { "dead_man_button": "grip", "max_slew": "1 N/s" })"), "--device tool=hid:auto " },   // limits that fit the device only
    };
    for (const auto& [device, option] : named)
    {
        const auto graph = graphWith ("graph.json", device);
        rests (runTactus ({ "validate", graph }), option);
        rests (runTactus ({ "play", graph, "--osc", "off", "--duration", "0.1" }), option);
        rests (runTactus ({ "render", graph, "--duration", "0.1", "--out", scratch.path ("out.csv") }), option);
    }

    // A graph that includes it, and its guard.
    const auto inner = graphWith ("inner.json", hid (calibrated + R"(, "guard": { "max_force": "1 N" })"));
    const auto outer = graphWith ("outer.json", R"({ "driver": "sim" })", R"("part": { "type": "file:inner.json" },)");
    const auto included = runTactus ({ "play", outer, "--osc", "off", "--duration", "0.1" });
    CHECK (included.status == 0);
    CHECK_FALSE (holds (included.err, "hid/"));

    // It cannot become the clock of the run either.
    const auto clock = runTactus ({ "play", graphWith ("graph.json", hid (calibrated)), "--osc", "off", "--duration", "0.1", "--clock", "tool" });
    CHECK (clock.status == 1);
    CHECK (holds (clock.err, "run/no_clock"));

    // The option chooses a device, without what the graph says about it.
    const auto chosen = runTactus ({ "play", graphWith ("graph.json", hid (calibrated)), "--osc", "off", "--duration", "0.1", "--device", "tool=hid:pid" });
    CHECK (chosen.status == 1);
    CHECK (holds (chosen.err, "hid/not_connected"));
    CHECK_FALSE (holds (chosen.err, "device/not_by_graph"));

    const auto session = runTactus ({ "session", inner, "--file", scratch.write ("session.json", R"({"format": "tactus-session", "version": 1})") });
    CHECK (session.status == 0);
    CHECK (holds (session.out, "sim (default)"));
    CHECK (holds (session.out, "a graph cannot choose or calibrate a real device"));
}

TEST_CASE ("a device that is known only by its numbers is listed, simulated on request, and never opened", "[cli][hid]")
{
    const auto listed = runTactus ({ "devices" });
    CHECK (holds (listed.out, "phantom_1_0 (PHANTOM 1.0)"));
    CHECK (holds (listed.out, "simulate one, or check a graph with its numbers: --device ROLE=PROFILE"));
    const auto json = Json::parse (runTactus ({ "devices", "--json" }).out);
    const auto phantom = std::find_if (json.begin(), json.end(), [] (const Json& d) { return d.value ("profile", "") == "phantom_1_0"; });
    REQUIRE (phantom != json.end());
    CHECK (phantom->at ("physics").at ("first_mode").at ("value").get<double>() == 30.0);
    CHECK_FALSE (phantom->at ("physics").at ("first_mode").at ("guess").get<bool>());

    // The arms that labs own, which have drivers as well. Each number has a source, or is a guess and says what it is based on.
    for (const auto* id : { "omega_3", "delta_3", "sigma_7", "lambda_7", "touch", "touch_x", "phantom_premium_1_5", "novint_falcon" })
    {
        INFO (id);
        const auto arm = std::find_if (json.begin(), json.end(), [id] (const Json& d) { return d.value ("profile", "") == id; });
        REQUIRE (arm != json.end());
        for (const auto& [key, number] : arm->at ("physics").items())
            CHECK_FALSE (number.value ("source", "").empty());
        CHECK (arm->at ("physics").contains ("damping"));
        CHECK_FALSE (arm->at ("physics").at ("peak_force").at ("guess").get<bool>());
        const auto checked = runTactus ({ "check", wood, "--device", "stylus=" + std::string (id) });
        CHECK (holds (checked.out, "stylus on " + std::string (id)));
        CHECK (holds (checked.out, " N*s/m (guess)"));
    }

    Scratch scratch;
    const auto rendered = runTactus ({ "render", wood, "--duration", "0.05", "--device", "stylus=phantom_1_0", "--out", scratch.path ("out.csv") });
    CHECK (rendered.status == 0);
    CHECK (holds (rendered.err, "device/numbers_only"));
    CHECK (holds (rendered.err, "the profile of PHANTOM 1.0 has only numbers"));

    const auto opened = runTactus ({ "play", wood, "--osc", "off", "--duration", "1", "--device", "stylus=hid:phantom_1_0" });
    CHECK (opened.status == 1);
    CHECK (holds (opened.err, "hid/numbers_only"));
}
