// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/cli/program.hpp"

#include <host/base/files/wav.hpp>
#include <tactus/file/csv.hpp>
#include <tactus/text/json.hpp>

#include <catch2/catch.hpp>

#include <filesystem>

using namespace tactus;
using tactus::test::runTactus;
using tactus::test::Scratch;

namespace
{
const std::string wood = TACTUS_SOURCE_DIR "/graphs/dry_wood.json";

/// A gain of 2 whose input is fed.
const std::string amplifier = R"({ "format": "tactus-graph", "version": 1, "name": "Amplifier", "rate_hz": 500,
  "nodes": { "amp": { "type": "signal.gain", "params": { "gain": 2 } } }, "wires": [] })";

Table render (const Scratch& scratch, std::vector<std::string> arguments)
{
    arguments.insert (arguments.begin(), "render");
    arguments.insert (arguments.end(), { "--out", scratch.path ("out.csv") });
    const auto ran = runTactus (arguments);
    INFO (ran.err);
    REQUIRE (ran.status == 0);
    auto table = readTable (std::filesystem::path (scratch.path ("out.csv")));
    REQUIRE (table);
    return *table;
}
}   // namespace

TEST_CASE ("a feed without times has one row per tick, at the graph's rate or the requested rate", "[cli]")
{
    const Scratch scratch;
    const auto graph = scratch.write ("g.json", amplifier), feed = scratch.write ("f.csv", "amp.in\n1\nnan\ninf\n4\n");

    const auto table = render (scratch, { graph, "--feed", feed, "--record", "amp.out,amp.in" });
    CHECK (table.columns == std::vector<std::string> { "t", "amp.out", "amp.in" });
    REQUIRE (table.rows() == 4);
    CHECK (table.at (3, 0) == 3.0 / 500);
    CHECK (table.at (0, 1) == 2.0);
    CHECK (table.at (1, 1) == 0.0);
    CHECK (std::isnan (table.at (1, 2)));
    CHECK (table.at (3, 1) == 8.0);

    CHECK (render (scratch, { graph, "--feed", feed, "--record", "amp.out", "--rate", "100" }).at (3, 0) == 0.03);
}

TEST_CASE ("a feed with times sets the rate, or is resampled by holding at the requested rate", "[cli]")
{
    const Scratch scratch;
    const auto graph = scratch.write ("g.json", amplifier), feed = scratch.write ("f.csv", "t,amp.in\n5,1\n5.01,2\n5.02,3\n");

    const auto own = render (scratch, { graph, "--feed", feed, "--record", "amp.out" });
    REQUIRE (own.rows() == 3);
    CHECK (own.at (1, 0) == 0.01);

    const auto held = render (scratch, { graph, "--feed", feed, "--record", "amp.in", "--rate", "400" });
    REQUIRE (held.rows() == 9);
    const double expected[] { 1, 1, 1, 1, 2, 2, 2, 2, 3 };
    for (std::size_t k = 0; k < 9; ++k)
        CHECK (held.at (k, 1) == expected[k]);
}

TEST_CASE ("a feed takes precedence over wires, parameters and --set, and --duration ends it early", "[cli]")
{
    const Scratch scratch;
    const auto graph = scratch.write ("g.json", amplifier), feed = scratch.write ("f.csv", "amp.in,amp.gain\n1,5\n1,6\n1,7\n");
    const auto table = render (scratch, { graph, "--feed", feed, "--record", "amp.out", "--set", "amp.gain=9", "--duration", "0.004" });
    REQUIRE (table.rows() == 2);
    CHECK (table.at (1, 1) == 6.0);
}

TEST_CASE ("the same run gives the same bytes", "[cli]")
{
    const Scratch scratch;
    const auto a = runTactus ({ "render", wood, "--duration", "0.8" }), b = runTactus ({ "render", wood, "--duration", "0.8" });
    CHECK (a.status == 0);
    CHECK (a.out.size() > 10000);
    CHECK (a.out == b.out);
}

TEST_CASE ("a run may write a table, a WAV and a plot together, with one channel per component", "[cli]")
{
    const Scratch scratch;
    const auto ran = runTactus ({ "render", wood, "--record", "drag.force,drag.state", "--duration", "0.8",
                                  "--out", scratch.path ("w.csv"), "--out", scratch.path ("w.wav"), "--plot", scratch.path ("w.png") });
    INFO (ran.err);
    REQUIRE (ran.status == 0);
    CHECK (ran.out.empty());
    const auto table = readTable (std::filesystem::path (scratch.path ("w.csv")));
    const auto wave = host::readWav (scratch.path ("w.wav"));
    REQUIRE (table);
    REQUIRE (wave);
    CHECK (wave->rate_hz == 4000.0);
    REQUIRE (wave->channels.size() == 4);
    REQUIRE (wave->channels[0].size() == table->rows());
    for (std::size_t r = 0; r < table->rows(); ++r)
        REQUIRE (wave->channels[0][r] == static_cast<double> (static_cast<float> (table->at (r, 1))));
    CHECK (std::filesystem::file_size (scratch.path ("w.png")) > 5000);
}

TEST_CASE ("devices come from the graph, a gesture, a trace or a file", "[cli]")
{
    const Scratch scratch;
    const auto trace = scratch.write ("t.csv", "t,x,y,z,pressure\n0,0,0,0.001,0\n0.5,0.01,0,-0.001,1\n1,0.02,0,0.001,0\n");
    const auto device = scratch.write ("d.json", R"({ "driver": "trace", "path": "t.csv" })");
    const auto rows = [&] (const std::string& choice) { return render (scratch, { wood, "--device", choice, "--record", "hand.position" }); };

    CHECK (rows ("stylus=trace:" + trace).at (2500, 1) == 0.01);
    CHECK (rows ("stylus=" + device).at (2500, 3) == -0.001);
    CHECK (rows ("stylus=gesture:circle").rows() > 4000);
    CHECK (rows ("stylus=sim").rows() == render (scratch, { wood }).rows());
}

TEST_CASE ("the option --set takes numbers, units, choices, vectors and controls", "[cli]")
{
    const Scratch scratch;
    const auto plain = runTactus ({ "render", wood, "--duration", "0.8" }).out;
    for (const auto* set : { "drag.mu=0.1", "drag.d_max=1 mm", "drag.adhesion=dahl", "board.normal=[0.1,0,1]", "roughness=1" })
    {
        const auto ran = runTactus ({ "render", wood, "--duration", "0.8", "--set", set });
        INFO (set);
        INFO (ran.err);
        CHECK (ran.status == 0);
        CHECK (ran.out != plain);
    }
}

TEST_CASE ("play runs in real time and brings the force to zero at the end", "[cli]")
{
    const Scratch scratch;
    const auto ran = runTactus ({ "play", wood, "--duration", "1", "--record", "drag.force", "--out", scratch.path ("p.csv") });
    INFO (ran.err);
    CHECK (ran.status == 0);
    CHECK (ran.err.find ("force  0.000 N") != std::string::npos);
    const auto table = readTable (std::filesystem::path (scratch.path ("p.csv")));
    REQUIRE (table);
    CHECK (table->rows() > 0);
    CHECK (table->rows() < 4400);   // a busy computer loses ticks, or gets several at once, but the run still lasts a second
}

TEST_CASE ("play records the same bits as render", "[cli]")
{
    const Scratch scratch;
    CHECK (runTactus ({ "play", wood, "--ticks", "3200", "--out", scratch.path ("p.csv") }).status == 0);
    CHECK (runTactus ({ "render", wood, "--duration", "0.8", "--out", scratch.path ("r.csv") }).status == 0);
    CHECK (test::textOf (scratch.path ("p.csv")) == test::textOf (scratch.path ("r.csv")));
}

TEST_CASE ("the catalogue is printed as text and as JSON", "[cli]")
{
    CHECK (runTactus ({ "nodes" }).out.find ("friction.elasto_plastic") != std::string::npos);
    CHECK (runTactus ({ "nodes", "friction.elasto_plastic" }).out.find ("d_max") != std::string::npos);
    CHECK (runTactus ({ "nodes", "friction.elastoplastic" }).err.find ("did you mean 'friction.elasto_plastic'") != std::string::npos);

    const auto all = Json::parse (runTactus ({ "nodes", "--json" }).out);
    CHECK (all.size() > 30);
    for (const auto& node : all)
        for (const auto* key : { "id", "name", "summary", "source", "inputs", "params", "settings", "outputs" })
            CHECK (node.contains (key));
}

TEST_CASE ("an interrupted render leaves no file, not even a hidden one, and reports this", "[cli]")
{
    const Scratch scratch;
    const auto ran = test::runProgram ("timeout", { "-s", "INT", "0.5", TACTUS_PROGRAM, "render", wood, "--duration", "100000",
                                                    "--out", scratch.path ("w.csv") });
    INFO (ran.err);
    CHECK (ran.err.find ("[run/interrupted]") != std::string::npos);
    CHECK (std::filesystem::is_empty (std::filesystem::path (scratch.path ("w.csv")).parent_path()));
}

TEST_CASE ("an interrupted play brings the force to zero and keeps its recording, even if its terminal is closed", "[cli]")
{
    const auto signal = GENERATE (std::string ("INT"), std::string ("TERM"), std::string ("HUP"));
    const Scratch scratch;
    const auto ran = test::runProgram ("timeout", { "-s", signal, "0.9", TACTUS_PROGRAM, "play", wood, "--duration", "60", "--out", scratch.path ("p.csv") });
    INFO (ran.err);
    CHECK (ran.err.find ("force  0.000 N") != std::string::npos);
    const auto table = readTable (std::filesystem::path (scratch.path ("p.csv")));
    REQUIRE (table);
    CHECK (table->rows() > 1000);
}

TEST_CASE ("the guard withholds a force that is not a number, and the run reports it", "[cli]")
{
    const Scratch scratch;
    const auto graph = scratch.write ("g.json", R"({ "format": "tactus-graph", "version": 1, "name": "Nan", "rate_hz": 1000,
        "devices": { "tip": { "driver": "sim" } },
        "nodes": { "motor": { "type": "device.force", "role": "tip" } }, "wires": [] })");
    const auto feed = scratch.write ("f.csv", "motor.force.x\n1\nnan\n1\n");
    const auto ran = runTactus ({ "render", graph, "--feed", feed });
    CHECK (ran.status == 0);
    CHECK (ran.err.find ("the guard withheld the force") != std::string::npos);
}

TEST_CASE ("a failed write to standard output is an error", "[cli]")
{
    if (! std::filesystem::exists ("/dev/full")) return;
    CHECK (test::runProgram ("sh", { "-c", "exec \"$0\" nodes > /dev/full", TACTUS_PROGRAM }).status == 1);
}

TEST_CASE ("a WAV has the rate of a faster section if all its ports are in that section, else the rate of the graph", "[cli][rates]")
{
    const Scratch scratch;
    const auto graph = scratch.write ("g.json", R"({ "format": "tactus-graph", "version": 1, "name": "Fast", "rate_hz": 1000,
      "nodes": { "sec": { "type": "graph:part", "times": 4 }, "amp": { "type": "signal.gain" } },
      "wires": [],
      "graphs": { "part": { "nodes": { "twice": { "type": "signal.gain", "params": { "gain": 2 } } }, "wires": [],
                            "expose": { "inputs": { "in": "twice.in" }, "outputs": { "out": "twice.out" } } } } })"),
               feed = scratch.write ("f.csv", "sec.in,amp.in\n0,1\n4,2\n0,3\n");

    const auto column = [] (const Table& table, std::size_t c) {
        std::vector<double> values;
        for (std::size_t r = 0; r < table.rows(); ++r)
            values.push_back (table.at (r, c));
        return values;
    };
    const auto recorded = [&] (const std::string& ports) {
        const auto ran = runTactus ({ "render", graph, "--feed", feed, "--record", ports, "--out", scratch.path ("out.csv"),
                                      "--out", scratch.path ("out.wav") });
        INFO (ran.err);
        REQUIRE (ran.status == 0);
        const auto table = readTable (std::filesystem::path (scratch.path ("out.csv")));
        REQUIRE (table);
        const auto wave = host::readWav (scratch.path ("out.wav"));
        REQUIRE (wave);
        return std::pair { *table, *wave };
    };

    const auto [rows, fast] = recorded ("sec.out,sec/twice.in");
    CHECK (column (rows, 1) == std::vector { 0.0, 8.0, 0.0 });
    CHECK (fast.rate_hz == 4000.0);
    REQUIRE (fast.channels.size() == 2);
    CHECK (fast.channels[0] == std::vector { 0.0, 0.0, 0.0, 0.0, 2.0, 4.0, 6.0, 8.0, 6.0, 4.0, 2.0, 0.0 });
    CHECK (fast.channels[1] == std::vector { 0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 3.0, 2.0, 1.0, 0.0 });

    const auto [both, slow] = recorded ("sec.out,amp.out");
    CHECK (column (both, 2) == std::vector { 1.0, 2.0, 3.0 });
    CHECK (slow.rate_hz == 1000.0);
    CHECK (slow.channels[0] == std::vector { 0.0, 8.0, 0.0 });
}

TEST_CASE ("a plot has the kind, the size and the time window that were asked for", "[cli]")
{
    const Scratch scratch;
    const auto plot = [&] (const std::string& file, std::vector<std::string> more) {
        std::vector<std::string> arguments { "render", wood, "--duration", "0.8", "--record", "drag.force", "--plot", scratch.path (file) };
        arguments.insert (arguments.end(), more.begin(), more.end());
        return runTactus (arguments);
    };
    REQUIRE (plot ("p.svg", { "--size", "120x80", "--from", "0.2", "--until", "0.6" }).status == 0);
    CHECK (test::textOf (scratch.path ("p.svg")).find (R"(width="119.99mm" height="80.04mm")") != std::string::npos);   // rounded to whole pixels at 192 dpi
    REQUIRE (plot ("p.pdf", { "--size", "85" }).status == 0);
    CHECK (test::textOf (scratch.path ("p.pdf")).starts_with ("%PDF-"));
    REQUIRE (plot ("p.png", { "--size", "101.6x76.2", "--dpi", "300" }).status == 0);
    const auto png = test::textOf (scratch.path ("p.png"));
    CHECK (png.substr (16, 8) == std::string ("\0\0\x04\xb0\0\0\x03\x84", 8));   // 1200 by 900 pixels

    CHECK (plot ("p.gif", {}).err.find (".png, .svg or .pdf") != std::string::npos);
    CHECK (plot ("p.png", { "--size", "10by20" }).err.find ("'10by20' is not a size in mm") != std::string::npos);
    CHECK (plot ("p.png", { "--size", "0x5" }).status != 0);
    CHECK (plot ("p.png", { "--from", "0.5", "--until", "0.5" }).err.find ("must be after --from") != std::string::npos);
    CHECK (plot ("p.png", { "--from", "3" }).err.find ("plot/no_ticks") != std::string::npos);
}

TEST_CASE ("a mistyped command, option or node type gets a suggestion", "[cli]")
{
    CHECK (runTactus ({ "rendr", wood }).err.find ("There is no command 'rendr' (did you mean 'render'?)") != std::string::npos);
    CHECK (runTactus ({ "render", wood, "--durration", "1" }).err.find ("did you mean '--duration'?") != std::string::npos);
    CHECK (runTactus ({ "render", wood, "--durration=1" }).err.find ("did you mean '--duration'?") != std::string::npos);
    CHECK (runTactus ({ "nodes", "fricton" }).err.find ("did you mean 'friction'?") != std::string::npos);
    CHECK (runTactus ({ "nodes", "mouze" }).err.find ("did you mean 'mouse'?") != std::string::npos);
    CHECK (runTactus ({ "xyzzy" }).err.find ("There is no command 'xyzzy'") != std::string::npos);
}

TEST_CASE ("the node types of a family are listed by its name", "[cli]")
{
    const auto listed = runTactus ({ "nodes", "texture" });
    CHECK (listed.status == 0);
    CHECK (listed.out.find ("texture.grating") != std::string::npos);
    CHECK (listed.out.find ("friction.") == std::string::npos);
    const auto json = runTactus ({ "nodes", "texture", "--json" });
    CHECK (json.status == 0);
    CHECK (json.out.find ("\"id\": \"texture.grating\"") != std::string::npos);
    CHECK (json.out.find ("\"id\": \"friction.elasto_plastic\"") == std::string::npos);
}
