// SPDX-License-Identifier: GPL-3.0-or-later
// `tactus play --watch`: the graph file is edited during a run.

#include "running.hpp"
#include "support/waiting.hpp"

#include <tactus/file/csv.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <filesystem>

using namespace tactus;
using test::Running;
using test::Scratch;

namespace
{
/// A graph that counts the ticks in a loop and pulls on a tool that no hand holds.
std::string counter (const std::string& more_nodes = "", const std::string& value = "1", const std::string& more_devices = "")
{
    return R"({ "format": "tactus-graph", "version": 1, "name": "Counter", "rate_hz": 500,
      "devices": { )"
           + more_devices + R"( "tip": { "driver": "sim" } },
      "nodes": { )"
           + more_nodes + R"( "one": { "type": "signal.constant", "params": { "value": )" + value
           + R"( } }, "count": { "type": "signal.add" }, "motor": { "type": "device.force", "role": "tip" } },
      "wires": [ "one.out -> count.in[0]", "count.out -> [1] -> count.in[1]" ] })";
}
}   // namespace

TEST_CASE ("an edited graph is swapped in live: no tick is lost, and a counter continues counting", "[cli][watch]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", counter());
    Running play { { "play", file, "--watch", "--record", "count.out", "--out", scratch.path ("p.csv") } };
    REQUIRE (play.says ("Ctrl-C stops"));
    scratch.write ("g.json", counter (R"("idle": { "type": "signal.abs" },)"));
    REQUIRE (play.says (": reloaded"));
    std::filesystem::rename (scratch.write ("new.json", counter()), file);   // many editors save in this way
    REQUIRE (play.says (": reloaded", 2));
    const auto ran = play.stop();
    INFO (ran.err);
    CHECK (ran.status == 0);

    const auto table = readTable (std::filesystem::path (scratch.path ("p.csv")));
    REQUIRE (table);
    REQUIRE (table->rows() > 100);
    std::size_t breaks = 0;
    for (std::size_t r = 0; r < table->rows(); ++r)
        breaks += table->at (r, 1) != static_cast<double> (r + 1);
    CHECK (breaks == 0);
}

TEST_CASE ("an edit that adds a role with a real device opens nothing", "[cli][watch]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", counter());
    Running play { { "play", file, "--watch", "--osc", "off" } };
    REQUIRE (play.says ("Ctrl-C stops"));
    scratch.write ("g.json", counter (R"("other": { "type": "device.position", "role": "stick" },)", "1",
                                      R"("stick": { "driver": "hid", "profile": "pid", "calibration": { "full_force": "1 mN" } },)"));
    REQUIRE (play.says (": reloaded"));
    const auto ran = play.stop();
    INFO (ran.err);
    CHECK (ran.status == 0);
    CHECK (ran.err.find ("--device stick=hid:pid ") != std::string::npos);
    CHECK (ran.err.find ("hid/") == std::string::npos);
}

TEST_CASE ("a value changed in the file is approached gradually", "[cli][watch]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", counter());
    Running play { { "play", file, "--watch", "--record", "one.out", "--out", scratch.path ("p.csv") } };
    REQUIRE (play.says ("Ctrl-C stops"));
    scratch.write ("g.json", counter ("", "5"));
    REQUIRE (play.says (": reloaded"));
    scratch.write ("g.json", counter (R"("idle": { "type": "signal.abs" },)", "5"));   // by then the value has arrived
    REQUIRE (play.says (": reloaded", 2));
    CHECK (play.stop().status == 0);
    const auto table = readTable (std::filesystem::path (scratch.path ("p.csv")));
    REQUIRE (table);
    double last = 1.0, step = 0.0;
    for (std::size_t r = 0; r < table->rows(); ++r)
    {
        step = std::max (step, std::abs (table->at (r, 1) - last));
        last = table->at (r, 1);
    }
    CHECK (last == 5.0);
    CHECK (step < 0.5);   // 4 in 20 ms, which are 10 ticks
}

TEST_CASE ("a file with errors is reported with its place, and the previous graph keeps running", "[cli][watch]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", counter());
    Running play { { "play", file, "--watch", "--record", "count.out", "--out", scratch.path ("p.csv") } };
    REQUIRE (play.says ("Ctrl-C stops"));
    auto refused = [&, n = 0] (const std::string& text, const std::string& id, const std::string& line) mutable {
        scratch.write ("g.json", text);
        INFO (id);
        CHECK (play.says ("not reloaded", ++n));
        INFO (play.err());
        CHECK (play.says (file + ":" + line));
        CHECK (play.says ("[" + id + "]"));
    };
    refused ("{ \"format\": \"tactus-graph\", ", "file/syntax", "1:");
    refused (counter (R"("idle": { "type": "signal.abss" },)"), "node/unknown_type", "3:");
    refused (counter (R"("idle": { "type": "device.force", "role": "thumb" },)", "1", R"("thumb": { "driver": "sim", "mass": -1 },)"),
             "device/out_of_range", "2:");
    auto misspelt = counter();
    refused (misspelt.replace (misspelt.find ("count.in[0]"), 11, "count.on[0]"), "port/unknown", "4:");

    scratch.write ("g.json", counter (R"("idle": { "type": "signal.abs" },)"));
    CHECK (play.says (": reloaded"));
    const auto ran = play.stop();
    CHECK (ran.status == 0);
    const auto table = readTable (std::filesystem::path (scratch.path ("p.csv")));
    REQUIRE (table);
    CHECK (table->at (table->rows() - 1, 1) == static_cast<double> (table->rows()));
}

TEST_CASE ("a role that is new in the edited file gets its device, and is felt", "[cli][watch]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", counter());
    Running play { { "play", file, "--watch", "--duration", "60", "--record", "count.out", "--out", scratch.path ("p.csv") } };
    REQUIRE (play.says ("Ctrl-C stops"));
    const std::string thumb = R"("thumb": { "type": "device.position", "role": "thumb" }, "wall": { "type": "deform.plane" },)"
                              R"("thimble": { "type": "device.force", "role": "thumb" },)";
    const auto edit = [&] (const std::string& more) {
        auto edited = counter (thumb + more, "1", R"("thumb": { "driver": "sim", "position": [0, 0, "-5 mm"], "mass": 1000 },)");
        edited.replace (edited.find (R"("wires": [)"), 10, R"("wires": [ "thumb.position -> wall.position", "wall.force -> thimble.force",)");
        scratch.write ("g.json", edited);
    };
    edit ({});
    REQUIRE (play.says (": reloaded"));
    CHECK (play.err().find ("device/undescribed") == std::string::npos);

    edit (R"("toe": { "type": "device.force", "role": "toe" },)");
    REQUIRE (play.says (": reloaded", 2));
    CHECK (play.says ("[device/undescribed]"));
    const auto ran = play.stop();
    INFO (ran.err);
    CHECK (ran.status == 0);
    const auto peak = ran.err.find ("peak ");
    REQUIRE (peak != std::string::npos);
    CHECK (std::stod (ran.err.substr (peak + 5)) > 0.1);   // of the 5 N of 5 mm in 1000 N/m, which take 100 ms to rise
    const auto table = readTable (std::filesystem::path (scratch.path ("p.csv")));
    REQUIRE (table);
    CHECK (table->at (table->rows() - 1, 1) == static_cast<double> (table->rows()));
}

TEST_CASE ("edits that cannot be applied live are reported: a different device, a different rate", "[cli][watch]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", counter());
    Running play { { "play", file, "--watch", "--duration", "60" } };
    REQUIRE (play.says ("Ctrl-C stops"));
    auto other = counter();
    other.replace (other.find ("500"), 3, "600");
    other.replace (other.find ("\"sim\""), 5, R"("sim", "mass": 0.2)");
    scratch.write ("g.json", other);
    CHECK (play.says (": reloaded"));
    CHECK (play.says ("[watch/rate]"));
    CHECK (play.says ("[watch/device]"));
    CHECK (play.stop().status == 0);
}

TEST_CASE ("a file included by the graph is watched too", "[cli][watch]")
{
    const Scratch scratch;
    const auto inner = [&] (const std::string& value) {
        const auto nodes = R"({ "one": { "type": "signal.constant", "params": { "value": )" + value + " } } }";
        scratch.write ("inner.json", R"({ "format": "tactus-graph", "version": 1, "nodes": )" + nodes
                                         + R"(, "wires": [], "expose": { "outputs": { "out": "one.out" } } })");
    };
    inner ("1");
    const auto file = scratch.write ("g.json", R"({ "format": "tactus-graph", "version": 1, "rate_hz": 500,
      "nodes": { "part": { "type": "file:inner.json" }, "last": { "type": "signal.abs" } },
      "wires": [ "part.out -> last.in" ] })");
    Running play { { "play", file, "--watch", "--duration", "60", "--record", "last.out", "--out", scratch.path ("p.csv") } };
    REQUIRE (play.says ("Ctrl-C stops"));
    inner ("3");
    INFO (play.err());
    CHECK (play.says (": reloaded"));
    inner ("3.0");
    CHECK (play.says (": reloaded", 2));
    CHECK (play.stop().status == 0);
    const auto table = readTable (std::filesystem::path (scratch.path ("p.csv")));
    REQUIRE (table);
    CHECK (table->at (table->rows() - 1, 1) == 3.0);
}

TEST_CASE ("with --watch, play outlasts the trace of its device", "[cli][watch]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", counter()), trace = scratch.write ("t.csv", "t,x,y,z\n0,0,0,0\n0.1,0.01,0,0\n");
    Running play { { "play", file, "--watch", "--device", "tip=trace:" + trace, "--record", "count.out", "--out", scratch.path ("p.csv") } };
    REQUIRE (play.says ("Ctrl-C stops"));
    scratch.write ("g.json", counter (R"("idle": { "type": "signal.abs" },)"));
    REQUIRE (play.says (": reloaded"));
    test::letPass (std::chrono::milliseconds (200));   // longer than the trace
    scratch.write ("g.json", counter());
    REQUIRE (play.says (": reloaded", 2));
    CHECK (play.stop().status == 0);
}
