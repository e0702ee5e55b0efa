// SPDX-License-Identifier: GPL-3.0-or-later
// `tactus set` and `tactus probe` on a running `tactus play`.

#include "host/cli/running.hpp"

#include <tactus/file/csv.hpp>

#include <catch2/catch.hpp>

#include <filesystem>

using namespace tactus;
using test::Running;
using test::runTactus;
using test::Scratch;

namespace
{
const std::string wood = TACTUS_SOURCE_DIR "/graphs/dry_wood.json";

/// The port that a `play` reports.
std::string portOf (Running& play)
{
    REQUIRE (play.says ("Ctrl-C stops"));
    const auto text = play.err();
    const std::string before = "OSC on 127.0.0.1:";
    const auto at = text.find (before);
    REQUIRE (at != std::string::npos);
    return std::to_string (std::stoi (text.substr (at + before.size())));
}

Table recorded (const Scratch& scratch, const std::string& name)
{
    auto table = readTable (std::filesystem::path (scratch.path (name)));
    REQUIRE (table);
    return *table;
}
}   // namespace

TEST_CASE ("another program can set parameters of a running graph and watch its ports", "[cli][osc]")
{
    const Scratch scratch;
    const auto graph = scratch.write ("g.json", R"({ "format": "tactus-graph", "version": 1, "name": "Knobs", "rate_hz": 500,
      "nodes": { "one": { "type": "signal.constant", "params": { "value": 1 } }, "count": { "type": "signal.add" }, "turn": { "type": "signal.constant" } },
      "wires": [ "one.out -> count.in[0]", "count.out -> [1] -> count.in[1]" ],
      "controls": { "level": { "value": 0, "to": { "turn.value": [0, 10] } } } })");
    Running play { { "play", graph, "--osc", "0", "--record", "count.out,turn.out", "--out", scratch.path ("p.csv") } };
    const auto port = portOf (play);

    const auto set = runTactus ({ "set", "level=0.5", "--osc", port });
    INFO (set.err);
    CHECK (set.status == 0);
    CHECK (test::soon ([&] { return runTactus ({ "probe", "turn.out", "--osc", port, "--duration", "0.01" }).out.find (",5\n") != std::string::npos; }));
    CHECK (runTactus ({ "set", "turn.value=0.1", "--osc", port }).status == 0);

    const auto probe = runTactus ({ "probe", "count.out", "--osc", port, "--rate", "100", "--duration", "0.2" });
    INFO (probe.out + probe.err);
    CHECK (probe.status == 0);
    const auto seen = readTable (scratch.write ("seen.csv", probe.out));
    REQUIRE (seen);
    CHECK (seen->columns == std::vector<std::string> { "t", "count.out" });
    REQUIRE (seen->rows() > 5);
    for (std::size_t r = 0; r < seen->rows(); ++r)
        CHECK (seen->at (r, 1) == Approx (seen->at (r, 0) * 500.0 + 1.0));

    CHECK (play.stop().status == 0);
    const auto table = recorded (scratch, "p.csv");
    CHECK (table.at (table.rows() - 1, 2) == 0.1);
    std::size_t breaks = 0;
    for (std::size_t r = 0; r < table.rows(); ++r)
        breaks += table.at (r, 1) != static_cast<double> (r + 1);
    CHECK (breaks == 0);   // probing disturbs nothing
}

TEST_CASE ("set and probe report the errors of the running program", "[cli][osc]")
{
    Running play { { "play", wood, "--osc", "0", "--duration", "600" } };
    const auto port = portOf (play);
    const auto refused = [&] (std::vector<std::string> arguments, const std::string& id) {
        arguments.insert (arguments.end(), { "--osc", port });
        const auto ran = runTactus (arguments);
        INFO (ran.err);
        CHECK (ran.status == 1);
        CHECK (ran.err.find ("[" + id + "]") != std::string::npos);
    };
    refused ({ "set", "drag.nu=1" }, "param/unknown");
    refused ({ "set", "drag.mu=1 kg", "drag.mu=0.2" }, "param/unit");
    refused ({ "set", "drag.adhesion=dahll" }, "param/unknown_choice");
    refused ({ "set", "roughness=2" }, "control/value");
    refused ({ "probe", "drag.forces" }, "port/unknown");
    CHECK (runTactus ({ "set", "drag.mu", "--osc", port }).status == 2);
    CHECK (runTactus ({ "set", "drag.d_max=20 um", "drag.adhesion=dahl", "board.normal=[0.1,0,1]", "roughness=1", "--osc", port }).status == 0);

    const auto second = runTactus ({ "play", wood, "--osc", port });
    CHECK (second.status == 1);
    CHECK (second.err.find ("[osc/port_taken]") != std::string::npos);
    CHECK (play.stop().status == 0);

    refused ({ "set", "drag.mu=1" }, "osc/nothing_runs");
    refused ({ "probe", "drag.force" }, "osc/nothing_runs");
}

TEST_CASE ("probing does not change a single bit of the recording", "[cli][osc]")
{
    const Scratch scratch;
    CHECK (runTactus ({ "render", wood, "--duration", "1", "--out", scratch.path ("r.csv") }).status == 0);
    Running play { { "play", wood, "--osc", "0", "--ticks", "4000", "--out", scratch.path ("p.csv") } };
    const auto port = portOf (play);
    runTactus ({ "probe", "drag.deflection", "--osc", port, "--duration", "0.1" });
    runTactus ({ "probe", "board.depth", "--osc", port, "--duration", "0.1" });
    CHECK (play.finish().status == 0);
    CHECK (test::textOf (scratch.path ("p.csv")) == test::textOf (scratch.path ("r.csv")));
}

TEST_CASE ("a probe continues when the graph is edited, and ends when its port is removed", "[cli][osc][watch]")
{
    const Scratch scratch;
    const auto text = [] (const std::string& more) {
        const auto nodes = more + R"( "last": { "type": "signal.constant" } })";
        return R"({ "format": "tactus-graph", "version": 1, "name": "G", "rate_hz": 500, "nodes": { )" + nodes + R"(, "wires": [] })";
    };
    const auto graph = scratch.write ("g.json", text (R"("one": { "type": "signal.constant" },)"));
    Running play { { "play", graph, "--osc", "0", "--watch", "--duration", "600" } };
    const auto port = portOf (play);
    Running stays { { "probe", "last.out", "--osc", port } }, goes { { "probe", "one.out", "--osc", port } };
    REQUIRE (test::soon ([&] { return stays.out().size() > 50 && goes.out().size() > 50; }));
    scratch.write ("g.json", text (""));
    REQUIRE (play.says (": reloaded"));
    const auto gone = goes.finish();
    CHECK (gone.status == 1);
    CHECK (gone.err.find ("[port/unknown") != std::string::npos);
    const auto before = stays.out().size();
    CHECK (test::soon ([&] { return stays.out().size() > before + 50; }));
    CHECK (stays.stop().status == 0);
    CHECK (play.stop().status == 0);
}

TEST_CASE ("a window around an edge contains every tick", "[cli][osc]")
{
    const Scratch scratch;
    const auto graph = scratch.write ("g.json", R"({ "format": "tactus-graph", "version": 1, "name": "Saw", "rate_hz": 500,
      "nodes": { "one": { "type": "signal.constant", "params": { "value": 1 } }, "count": { "type": "signal.add" },
          "saw": { "type": "signal.lfo", "params": { "frequency": 5, "shape": "saw" } }, "turn": { "type": "signal.constant" } },
      "wires": [ "one.out -> count.in[0]", "count.out -> [1] -> count.in[1]" ] })");
    Running play { { "play", graph, "--osc", "0", "--duration", "600" } };
    const auto port = portOf (play);
    const auto capture = [&] (std::vector<std::string> more) {
        std::vector<std::string> arguments { "probe", "count.out", "--osc", port, "--trigger", "saw.out" };
        arguments.insert (arguments.end(), more.begin(), more.end());
        return runTactus (arguments);
    };

    const auto ran = capture ({ "--level", "0.5", "--before", "30", "--after", "600" });
    INFO (ran.err);
    REQUIRE (ran.status == 0);
    CHECK (ran.err.starts_with ("triggered at "));
    const auto window = readTable (scratch.write ("window.csv", ran.out));
    REQUIRE (window);
    CHECK (window->columns == std::vector<std::string> { "t", "count.out" });
    REQUIRE (window->rows() == 631);
    const double edge = std::stod (ran.err.substr (13)) * 500.0;   // the tick of the edge; count.out is one more
    int wrong = 0;
    for (std::size_t r = 0; r < window->rows(); ++r)
    {
        wrong += std::abs (window->at (r, 0) * 500.0 - (static_cast<double> (r) - 30.0)) > 1e-9;
        wrong += std::abs (window->at (r, 1) - (edge + 1.0 + static_cast<double> (r) - 30.0)) > 1e-3;
    }
    CHECK (wrong == 0);

    CHECK (capture ({ "--level", "-0.5", "--edge", "falling", "--before", "0", "--after", "0" }).out.find ("\n0,") != std::string::npos);
    const auto never = capture ({ "--level", "7", "--duration", "0.3" });
    CHECK (never.status == 1);
    CHECK (never.err.find ("[probe/no_edge]") != std::string::npos);
    play.stop();

    CHECK (capture ({}).status == 2);
    CHECK (capture ({ "--level", "1", "--rate", "5" }).status == 2);
    CHECK (capture ({ "--level", "1", "--edge", "sideways" }).status == 2);
    CHECK (runTactus ({ "probe", "count.out", "--before", "5" }).status == 2);
}
