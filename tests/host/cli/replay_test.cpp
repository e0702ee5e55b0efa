// SPDX-License-Identifier: GPL-3.0-or-later
// `tactus play --log` records the inputs of a run, and `tactus render --replay` repeats the run bit for bit.

#include "running.hpp"

#include <tactus/text/json.hpp>

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>

using namespace tactus;
using test::Ran;
using test::Running;
using test::runTactus;
using test::Scratch;
using test::textOf;

namespace
{
std::string portOf (Running& play)
{
    REQUIRE (play.says ("Ctrl-C stops"));
    const auto text = play.err();
    const std::string before = "OSC on 127.0.0.1:";
    return std::to_string (std::stoi (text.substr (text.find (before) + before.size())));
}

/// A stroke over a board, with a part from another file and adjustable noise.
std::string board (const std::string& more_nodes = "", const std::string& more_wires = "", double mu = 0.4)
{
    return R"({ "format": "tactus-graph", "version": 1, "name": "Board", "rate_hz": 2000,
      "devices": { "stylus": { "driver": "sim", "mass": "50 g", "damping": 2.0,
          "hand": { "stiffness": 100.0, "damping": 2.0, "path": "stroke" }, "guard": { "max_force": 3.0, "ramp": 0.05 } } },
      "nodes": { )"
           + more_nodes + R"("hand": { "type": "device.position", "role": "stylus" },
        "board": { "type": "deform.plane", "params": { "stiffness": "2 N/mm" } },
        "drag": { "type": "friction.elasto_plastic", "params": { "mu": )"
           + std::to_string (mu) + R"(, "d_max": "0.4 mm" } },
        "grain": { "type": "file:grain.json" },
        "motor": { "type": "device.force", "role": "stylus" } },
      "wires": [ )"
           + more_wires + R"("hand.position -> board.position", "hand.position -> drag.position", "board.resistance -> drag.normal_force",
        "hand.position -> grain.position", "board.force -> motor.force", "drag.force -> motor.force", "grain.force -> motor.force" ],
      "controls": { "rough": { "value": 0.5, "to": { "grain.amplitude": [0, "0.12 N"], "drag.mu": [0.2, 0.6] } } } })";
}

std::string grain (double frequency)
{
    return R"({ "format": "tactus-graph", "version": 1,
      "nodes": { "wave": { "type": "texture.grating", "params": { "spatial_frequency": )"
           + std::to_string (frequency) + R"( } } }, "wires": [],
      "expose": { "inputs": { "position": "wave.position" }, "outputs": { "force": "wave.force" }, "params": { "amplitude": "wave.amplitude" } } })";
}

const std::string recorded = "hand.position,drag.force,drag.state,motor.force,motor.applied,grain.force";

std::size_t linesWith (const std::string& file, const std::string& what)
{
    std::ifstream in (file);
    std::size_t n = 0;
    for (std::string line; std::getline (in, line);)
        n += line.find (what) != std::string::npos;
    return n;
}

/// True if the replay of a run has repeated this file of it, see sameRows().
bool isRepeated (const Scratch& scratch, const std::string& kind, const std::string& said)
{
    const auto live = scratch.path ("live." + kind);
    return textOf (live).size() > 1000 && test::sameRows (live, scratch.path ("again." + kind), said);
}
}   // namespace

TEST_CASE ("a run with edits, parameter changes and probes is repeated byte for byte", "[cli][replay]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", board());
    scratch.write ("grain.json", grain (800.0));
    Running play { { "play", file, "--watch", "--osc", "0", "--set", "drag.break_away=0.6", "--record", recorded,
                     "--out", scratch.path ("live.csv"), "--out", scratch.path ("live.wav"), "--log", scratch.path ("run.jsonl") } };
    const auto port = portOf (play);
    CHECK (runTactus ({ "set", "rough=0.9", "--osc", port }).status == 0);
    CHECK (runTactus ({ "probe", "drag.deflection", "--osc", port, "--duration", "0.1" }).status == 0);
    const auto nodes = R"("trill": { "type": "signal.lfo", "params": { "frequency": 40, "amplitude": 0.1 } }, "join": { "type": "vector.join" },
        "lift": { "type": "device.force", "role": "thumb" }, "there": { "type": "device.position", "role": "thumb" },
        "far": { "type": "texture.grating" },)";
    const auto wires = R"("trill.out -> join.x", "join.out -> motor.force", "join.out -> lift.force",
        "there.position -> far.position", "far.force -> motor.force",)";
    scratch.write ("g.json", board (nodes, wires));
    CHECK (play.says (": reloaded"));
    CHECK (runTactus ({ "set", "drag.mu=0.3", "trill.frequency=60", "board.normal=[0.05,0,1]", "drag.adhesion=dahl", "--osc", port }).status == 0);
    scratch.write ("grain.json", grain (900.0));
    CHECK (play.says (": reloaded", 2));
    scratch.write ("g.json", board ("", "", 0.5));
    CHECK (play.says (": reloaded", 3));
    CHECK (runTactus ({ "set", "drag.mu=0.1", "--osc", port }).status == 0);
    const auto ran = play.stop();
    INFO (ran.err);
    REQUIRE (ran.status == 0);
    CHECK (linesWith (scratch.path ("run.jsonl"), "\"graph\"") == 4);
    CHECK (linesWith (scratch.path ("run.jsonl"), "\"guards\":{\"thumb\"") == 1);
    CHECK (linesWith (scratch.path ("run.jsonl"), "\"turn\"") >= 3);
    CHECK (linesWith (scratch.path ("run.jsonl"), "\"halt\"") == 1);

    std::filesystem::remove (file);   // the log contains the edited graph
    std::filesystem::remove (scratch.path ("grain.json"));
    const auto again = runTactus ({ "render", "--replay", scratch.path ("run.jsonl"), "--record", recorded,
                                    "--out", scratch.path ("again.csv"), "--out", scratch.path ("again.wav") });
    INFO (again.err);
    CHECK (again.status == 0);
    CHECK (again.err.empty());
    CHECK (isRepeated (scratch, "csv", ran.err));
    CHECK (isRepeated (scratch, "wav", ran.err));
}

TEST_CASE ("a run with late answers of async queries is repeated byte for byte", "[cli][replay]")
{
    const Scratch scratch;
    std::filesystem::copy (TACTUS_SOURCE_DIR "/graphs/assets/liver.obj", scratch.path ("liver.obj"));
    auto text = textOf (TACTUS_SOURCE_DIR "/graphs/liver.json");
    auto graph = Json::parse (text);
    bool found = false;
    for (auto& [name, node] : graph["nodes"].asObject())
        if (node["type"] == "deform.surface")
        {
            node["settings"]["surface"]["mesh"] = "liver.obj";
            node["settings"]["search_ticks"] = 1;
            found = true;
        }
    REQUIRE (found);
    graph["rate_hz"] = 8000;
    const auto file = scratch.write ("g.json", graph.dump());
    const auto live = runTactus ({ "play", file, "--osc", "off", "--ticks", "8000", "--out", scratch.path ("live.csv"), "--log", scratch.path ("run.jsonl") });
    INFO (live.err);
    REQUIRE (live.status == 0);
    CHECK (linesWith (scratch.path ("run.jsonl"), "\"late\"") > 0);
    const std::vector<std::string> replay { "render", "--replay", scratch.path ("run.jsonl"), "--out", scratch.path ("again.csv") };
    const auto again = runTactus (replay);
    INFO (again.err);
    CHECK (again.status == 0);
    CHECK (isRepeated (scratch, "csv", live.err));

    std::ofstream (scratch.path ("liver.obj"), std::ios::app) << "# edited\n";
    const auto changed = runTactus (replay);
    CHECK (changed.status == 1);
    CHECK (test::withSlashes (changed.err).find ("run.jsonl:2: error: '" + scratch.path ("liver.obj") + "'") != std::string::npos);
    CHECK (changed.err.find ("[log/asset_changed]") != std::string::npos);
    std::filesystem::remove (scratch.path ("liver.obj"));
    CHECK (runTactus (replay).err.find ("[log/asset_missing]") != std::string::npos);
}

TEST_CASE ("a run with a feed is repeated byte for byte", "[cli][replay]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", R"({ "format": "tactus-graph", "version": 1, "rate_hz": 500,
      "nodes": { "a": { "type": "signal.gain" }, "b": { "type": "filter.one_pole" } },
      "wires": [ "a.out -> b.in" ] })");
    std::string rows = "a.in,a.gain\n";
    for (int i = 0; i < 300; ++i)
        rows += (i % 50 == 7 ? "nan" : std::to_string (0.01 * i)) + "," + std::to_string (1 + i % 3) + "\n";
    const auto feed = scratch.write ("feed.csv", rows);
    const auto live = runTactus ({ "play", file, "--osc", "off", "--feed", feed, "--record", "a.in,b.out",
                                   "--out", scratch.path ("live.csv"), "--log", scratch.path ("run.jsonl") });
    INFO (live.err);
    REQUIRE (live.status == 0);
    CHECK (runTactus ({ "render", "--replay", scratch.path ("run.jsonl"), "--record", "a.in,b.out", "--out", scratch.path ("again.csv") }).status == 0);
    CHECK (isRepeated (scratch, "csv", live.err));
}

// Long because it is a series of logs, all derived from the log of one run.
TEST_CASE ("a damaged log is replayed as far as possible, even with another graph, or refused with a reason", "[cli][replay]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", board());
    scratch.write ("grain.json", grain (800.0));
    Running play { { "play", file, "--osc", "0", "--log", scratch.path ("run.jsonl"), "--ticks", "1000" } };
    CHECK (runTactus ({ "set", "drag.mu=0.3", "--osc", portOf (play) }).status == 0);
    REQUIRE (play.finish().status == 0);
    const auto log = textOf (scratch.path ("run.jsonl"));
    const auto replay = [&] (const std::string& text, std::vector<std::string> more = {}) {
        std::vector<std::string> arguments { "render" };
        arguments.insert (arguments.end(), more.begin(), more.end());
        arguments.insert (arguments.end(), { "--replay", scratch.write ("other.jsonl", text), "--record", "motor.force" });
        return runTactus (arguments);
    };
    const auto rows = [] (const Ran& ran) { return std::ranges::count (ran.out, '\n') - 1; };

    const auto whole = replay (log);
    CHECK (whole.err.empty());
    CHECK (rows (whole) == 1000);
    CHECK (rows (replay (log, { "--duration", "0.1" })) == 200);

    const auto cut = replay (log.substr (0, log.size() / 2));
    CHECK (cut.status == 0);
    CHECK (cut.err.find ("[log/cut_off]") != std::string::npos);
    CHECK (rows (cut) > 100);
    CHECK (whole.out.starts_with (cut.out));

    const auto at = log.find ("\n{\"tick\":700,");
    REQUIRE (at != std::string::npos);
    const auto broken = replay (log.substr (0, at) + "\n{\"tick\":700,\"broken\":true}\n");
    CHECK (broken.err.find ("ends at tick 700") != std::string::npos);
    CHECK (broken.err.find ("[log/broken]") != std::string::npos);
    CHECK (rows (broken) == 700);

    for (const char* library : { "libtactus 0", "libtactus_live 0" })   // of the same version: the same code
    {
        auto by_library = log;
        by_library.replace (by_library.find ("tactus 0"), 8, library);
        CHECK (replay (by_library).err.empty());
    }

    auto other_program = log;
    other_program.replace (other_program.find ("tactus 0"), 8, "tactus 9");
    CHECK (replay (other_program).err.find ("[log/other_program]") != std::string::npos);

    other_program.replace (other_program.find ("tactus 9"), 8, "x\\nforged: error: \\u001b");
    CHECK (replay (other_program).err.find ("recorded by 'x\\x0Aforged: error: \\x1B") != std::string::npos);

    auto other_functions = log;   // as written before Tactus had its own functions
    const std::string key = "\"functions\":1,";
    REQUIRE (other_functions.find (key) != std::string::npos);
    other_functions.erase (other_functions.find (key), key.size());
    CHECK (replay (other_functions).err.find ("[log/other_functions]") != std::string::npos);

    // The logged inputs also drive another graph, which gives its own output.
    const auto wall = scratch.write ("wall.json", R"({ "format": "tactus-graph", "version": 1,
      "nodes": { "hand": { "type": "device.position", "role": "stylus" }, "wall": { "type": "deform.plane" },
        "motor": { "type": "device.force", "role": "stylus" }, "other": { "type": "device.force", "role": "thumb" } },
      "wires": [ "hand.position -> wall.position", "wall.force -> motor.force" ] })");
    const auto felt = replay (log, { wall });
    INFO (felt.err);
    CHECK (felt.status == 0);
    CHECK (rows (felt) == 1000);
    CHECK (felt.out != whole.out);
    CHECK (felt.err.find ("[log/no_role]") != std::string::npos);
    CHECK (felt.err.find ("[log/not_turned]") != std::string::npos);

    const auto refused = [&] (const Ran& ran, int status, const std::string& what) {
        INFO (ran.err);
        CHECK (ran.status == status);
        CHECK (ran.err.find (what) != std::string::npos);
    };
    refused (replay (log, { "--device", "stylus=sim" }), 2, "--device");
    refused (replay (log, { "--rate", "100" }), 2, "--rate");
    refused (replay ("t,x\n0,1\n"), 1, "[log/not_a_log]");
    refused (replay (log.substr (0, at) + "\n{\"tick\":700,\"turn\":{\"drag.nu\":1}}\n"), 1, "[param/unknown]");
    refused (runTactus ({ "render", "--replay", scratch.path ("none.jsonl") }), 1, "[file/unreadable]");
    refused (runTactus ({ "render" }), 2, "graph");
    refused (runTactus ({ "play", file, "--osc", "off", "--log", scratch.path ("no/such/folder.jsonl") }), 1, "[output/unwritable]");
}
