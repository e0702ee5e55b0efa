// SPDX-License-Identifier: GPL-3.0-or-later
// `tactus session`, and how a run uses the session.

#include "program.hpp"

#include <tactus/file/text_file.hpp>
#include <tactus/text/json.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

using namespace tactus;
using test::runTactus;
using test::Scratch;

namespace
{
const std::string wood = TACTUS_SOURCE_DIR "/graphs/dry_wood.json";

bool has (const std::string& text, const std::string& part) { return text.find (part) != std::string::npos; }

test::Ran play (const std::string& session, std::vector<std::string> more = {})
{
    std::vector<std::string> all { "play", wood, "--osc", "off", "--session", session };
    if (std::ranges::count (more, "--duration") == 0) all.insert (all.end(), { "--duration", "0.1" });
    all.insert (all.end(), more.begin(), more.end());
    return runTactus (all);
}
}   // namespace

TEST_CASE ("a role is bound, shown with what the graph needs from it, and unbound", "[sessions][cli]")
{
    const Scratch scratch;
    const auto file = scratch.path ("desk/session.json");
    auto ran = runTactus ({ "session", "--file", file, "--bind", "stylus=hid:tactus_board", "--bind", "thumb=gesture:tap", "--clock", "stylus" });
    CHECK (ran.err == "");
    REQUIRE (ran.status == 0);
    CHECK (has (ran.out, "clock: stylus"));
    CHECK (has (ran.out, "hid tactus_board  not connected"));

    ran = runTactus ({ "session", wood, "--file", file });
    CHECK (ran.status == 0);
    CHECK (has (ran.out, "position, force"));
    CHECK (has (ran.out, "hid tactus_board (session)"));
    CHECK (has (ran.out, "yes, once it is connected"));
    const auto none = scratch.write ("none.json", R"({"format": "tactus-session", "version": 1})");
    CHECK (has (runTactus ({ "session", wood, "--file", none }).out, "sim with a hand that follows stroke (graph)"));

    CHECK_FALSE (has (ran.out, "moves only"));
    ran = runTactus ({ "session", wood, "--file", file, "--bind", "stylus=serial:dualpanto@/dev/null" });
    CHECK (has (ran.out, "yes; it moves only along x and y"));
    const auto turned = scratch.write ("turned.json", R"({"format": "tactus-session", "version": 1, "roles": {"stylus":
        {"driver": "serial", "profile": "haply_2diy", "port": "/dev/null", "workspace": {"axes": ["x", "-z", "y"]}}}})");
    CHECK (has (runTactus ({ "session", wood, "--file", turned }).out, "yes; it moves only along x and z"));
    ran = runTactus ({ "session", wood, "--file", file, "--bind", "stylus=udp:tactus_board@10.99.99.99:9755" });
    CHECK (has (ran.out, "udp tactus_board 10.99.99.99:9755  not checked until a run opens it"));
    CHECK_FALSE (has (ran.out, "connected"));
    CHECK (has (runTactus ({ "session", "--file", file, "--bind", "stylus=serial:tactus_board@/dev/null" }).out, "not checked until a run opens it"));
    CHECK (has (runTactus ({ "session", "--file", file, "--bind", "stylus=serial:tactus_board@/dev/no_such_port" }).out, "not connected"));

    // A link in this folder, from whatever folder the session is used later.
    runTactus ({ "session", "--file", file, "--bind", "stylus=serial:tactus_board@a_link" });
    const auto port = Json::parse (*readTextFile (file))["roles"]["stylus"]["port"].get<std::string>();
    CHECK (std::filesystem::path (port).is_absolute());
    CHECK (port.ends_with ("/a_link"));
    ran = runTactus ({ "session", "--file", file, "--bind", "stylus=udp:tactus_board@10.99.99.99:65537" });
    CHECK (ran.status == 1);
    CHECK (has (ran.err, "from 1 to 65535"));

    ran = runTactus ({ "session", wood, "--file", file, "--bind", "stylus=hid:spacemouse", "--json" });
    REQUIRE (ran.status == 0);
    const auto json = Json::parse (ran.out);
    CHECK (json["roles"][0]["fits"] == false);
    CHECK (json["roles"][0]["lacking"] == Json::array ({ "no force" }));

    ran = runTactus ({ "session", "--file", file, "--unbind", "stylus", "--clock", "first" });
    CHECK (ran.status == 0);
    const auto left = R"({"format": "tactus-session", "version": 1, "roles": {"thumb": {"driver": "gesture", "path": "tap"}}})";
    CHECK (Json::parse (test::textOf (file)) == Json::parse (left));
}

TEST_CASE ("a bad binding is refused, and the session stays unchanged", "[sessions][cli]")
{
    const Scratch scratch;
    const std::string before = R"({"format": "tactus-session", "version": 1})";
    const auto file = scratch.write ("session.json", before);
    const auto refuses = [&] (std::vector<std::string> options, int status, const std::string& id) {
        options.insert (options.begin(), { "session", "--file", file });
        const auto ran = runTactus (options);
        INFO (ran.err);
        CHECK (ran.status == status);
        CHECK (has (ran.err, id));
        CHECK (test::textOf (file) == before);
    };
    refuses ({ "--bind", "stylus" }, 1, "device/option");
    refuses ({ "--bind", "Stylus=sim" }, 1, "device/option");
    refuses ({ "--bind", "stylus=hid:tactus_bord" }, 1, "did you mean");
    refuses ({ "--bind", "stylus=gesture:strok" }, 1, "device/unknown_gesture");
    refuses ({ "--bind", "stylus=trace:nowhere.csv" }, 1, "csv/");
    refuses ({ "--bind", "stylus=" + scratch.write ("device.json", R"({"driver": "sim", "workspace": {"scale": 0}})") }, 1, "device/out_of_range");
    refuses ({ "--unbind", "stylus" }, 1, "session/not_bound");
    refuses ({ "--clock", "The clock" }, 2, "is not a role name");
    CHECK (runTactus ({ "session", "--file", scratch.path ("nowhere.json") }).status == 1);
}

TEST_CASE ("a recording is found, wherever the session file is", "[sessions][cli]")
{
    const Scratch scratch;
    const auto trace = scratch.write ("pen.csv", "t,x,y,z\n0,0,0,0\n0.05,0.01,0,-0.001\n");
    const auto file = scratch.path ("desk/session.json");
    CHECK (runTactus ({ "session", "--file", file, "--bind", "stylus=trace:" + trace }).status == 0);
    const auto ran = runTactus ({ "play", wood, "--osc", "off", "--session", file, "--record", "hand.position", "--out", scratch.path ("out.csv") });
    CHECK (ran.err.find ("error") == std::string::npos);
    CHECK (has (test::textOf (scratch.path ("out.csv")), "\n0.05,0.01,0,-0.001\n"));
}

TEST_CASE ("a run uses the option, then the session, then the graph, and a render never uses a session", "[sessions][cli]")
{
    const Scratch scratch;
    const auto bound = scratch.write ("session.json", R"({"format": "tactus-session", "version": 1,
        "roles": {"stylus": {"driver": "gesture", "path": "tap", "workspace": {"scale": 2, "offset": [1, 0, 0]}}}})");
    const auto firstX = [&] (const std::string& session, std::vector<std::string> more) {
        const auto out = scratch.path ("out.csv");
        more.insert (more.end(), { "--record", "hand.position.x", "--out", out });
        const auto ran = play (session, more);
        INFO (ran.err);
        CHECK (ran.status == 0);
        const auto text = test::textOf (out);
        const auto row = text.find ("\n0,");
        return row == std::string::npos ? std::string() : text.substr (row + 3, text.find ('\n', row + 1) - row - 3);
    };
    const auto by_graph = firstX ("off", {}), by_session = firstX (bound, {}), by_option = firstX (bound, { "--device", "stylus=gesture:tap" });
    CHECK (std::stod (by_session) == 1.0 + 2.0 * std::stod (by_option));
    CHECK (by_graph != by_session);
    CHECK (runTactus ({ "render", wood, "--session", bound }).status == 2);
}

TEST_CASE ("an absent device of the session keeps its role at rest, or ends a strict run", "[sessions][cli]")
{
    const Scratch scratch;
    const auto desk = scratch.write ("session.json", R"({"format": "tactus-session", "version": 1,
"clock": "stylus",
"roles": {"stylus": {"driver": "hid", "profile": "tactus_board"}, "other": {"driver": "nonsense"}}})");
    auto ran = play (desk);
    INFO (ran.err);
    CHECK (ran.status == 0);
    CHECK (has (ran.err, desk + ":3:11: warning: no Tactus board is connected"));
    CHECK (has (ran.err, "at 1000 Hz, ticked by stylus"));
    CHECK (has (ran.err, "peak  0.000 N"));
    CHECK (has (ran.err, "stylus (tactus_board): the device was never available"));

    ran = play (desk, { "--strict" });
    CHECK (ran.status == 1);
    CHECK (has (ran.err, "error: no Tactus board is connected"));

    ran = play (desk, { "--rate", "4000" });
    CHECK (has (ran.err, "[session/clock]"));
    CHECK (has (ran.err, "at 4000 Hz;"));
    CHECK (play (desk, { "--clock", "timer" }).err.find ("ticked by") == std::string::npos);
    CHECK (has (play (desk, { "--clock", "stylus", "--rate", "4000" }).err, "run/two_rates"));

    ran = play (scratch.write ("wrong.json", R"({"format": "tactus-session", "version": 1,
"roles": {"stylus": {"driver": "sim", "mass": "1 N"}}})"));
    CHECK (ran.status == 1);
    CHECK (has (ran.err, "wrong.json:2:"));
    CHECK (has (ran.err, "device/unit"));
}

TEST_CASE ("an unreadable session prevents a run if it was named on the command line", "[sessions][cli]")
{
    const Scratch scratch;
    CHECK (has (play (scratch.path ("nowhere.json")).err, "session/unreadable"));
    CHECK (play (scratch.path ("nowhere.json")).status == 1);
    const auto half = scratch.write ("half.json", "{\"format\": ");
    const auto ran = play (half);
    CHECK (ran.status == 1);
    CHECK (has (ran.err, "half.json:1:"));
    CHECK (has (ran.err, "--session off"));
    CHECK (test::textOf (half) == "{\"format\": ");
}

TEST_CASE ("a user's damaged session file neither ends a run nor causes a force, is set aside, and is not mentioned by the next run", "[sessions][cli]")
{
    const Scratch home;
    const char* const given = std::getenv ("TACTUS_HOME");
    const std::string before = given != nullptr ? given : "";
    setenv ("TACTUS_HOME", home.path ("").c_str(), 1);
    home.write ("session.json", R"({"format": "tactus-session", "version": 1, "roles": {"stylus": {"driver": "hid", "profile": "tactus_board"})");
    const std::vector<std::string> arguments { "play", wood, "--osc", "off", "--duration", "0.1" };
    const auto first = runTactus (arguments), second = runTactus (arguments);
    setenv ("TACTUS_HOME", before.c_str(), 1);
    CHECK (first.status == 0);
    CHECK (has (first.err, "[session/set_aside]"));
    CHECK (has (first.err, home.path ("session.json.broken")));
    CHECK (has (test::textOf (home.path ("session.json.broken")), "tactus_board"));
    CHECK (second.status == 0);
    CHECK_FALSE (has (second.err, "session"));
}

TEST_CASE ("a run with a session is repeated from its log byte for byte, in its workspace and while its clock is absent", "[sessions][cli][replay]")
{
    const Scratch scratch;
    const auto binding = GENERATE (as<std::string> {},
                                   R"({"driver": "gesture", "path": "stroke", "workspace": {"scale": 0.5, "offset": [0, 0, "-1 mm"]},
                                       "guard": {"max_force": 1, "max_speed": "0.2 m/s"}})",
                                   R"({"driver": "hid", "profile": "tactus_board"})");
    const auto desk = scratch.write ("session.json", R"({"format": "tactus-session", "version": 1, "clock": "stylus", "roles": {"stylus": )" + binding + "}}");
    const std::string ports = "hand.position,hand.valid,motor.force,motor.applied";
    const auto live = play (desk, { "--duration", "0.4", "--log", scratch.path ("run.jsonl"), "--record", ports, "--out", scratch.path ("live.csv") });
    CHECK (live.status == 0);
    CHECK (runTactus ({ "render", "--replay", scratch.path ("run.jsonl"), "--record", ports, "--out", scratch.path ("again.csv") }).status == 0);
    CHECK (test::textOf (scratch.path ("live.csv")).size() > 1000);
    CHECK (test::sameRows (scratch.path ("live.csv"), scratch.path ("again.csv"), live.err));
}
