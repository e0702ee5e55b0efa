// SPDX-License-Identifier: GPL-3.0-or-later
// Files from strangers: attacks on `tactus`, generated here. Each ends with a refusal that says what was too much.

#include "program.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>

using namespace tactus::test;
using Catch::Matchers::Contains;

namespace
{
std::string graph (const std::string& nodes, const std::string& rest = "")
{
    return R"({ "format": "tactus-graph", "version": 1, "nodes": { )" + nodes + " }" + rest + " }";
}

std::string nested()
{
    std::string graphs;
    for (int i = 0; i < 64; ++i)
        graphs += "\"g" + std::to_string (i) + R"(": { "nodes": { "a": { "type": "graph:g)" + std::to_string (i + 1) + R"(", "count": 2 } } }, )";
    return graph (R"("a": { "type": "graph:g0", "count": 2 })", R"(, "graphs": { )" + graphs + R"("g64": { "nodes": { "a": { "type": "signal.add" } } } })");
}

/// A relief of one column.
std::string profile (int rows)
{
    std::string text;
    for (int i = 0; i < rows; ++i)
        text += i % 2 == 0 ? "0.5\n" : "0.25\n";
    return text;
}

const std::string relief = graph (R"("m": { "type": "texture.height_map", "settings": { "map": { "csv": "map.csv" } } })");

const std::string hand = R"("hand": { "type": "device.position", "role": "pen" })";
}   // namespace

TEST_CASE ("attack: a file of 5 KB cannot ask for 2^64 nodes", "[cli][budget]")
{
    const Scratch scratch;
    const auto text = nested();
    CHECK (text.size() < 6000);
    const auto ran = runTactus ({ "validate", scratch.write ("nested.json", text) });
    CHECK (ran.status == 1);
    CHECK_THAT (ran.err, Contains ("[graph/too_large]") && Contains ("--limits "));
}

TEST_CASE ("attack: a file of 300 bytes cannot ask for a tick that takes minutes", "[cli][budget]")
{
    const Scratch scratch;
    const auto sections = [] (int instances) {
        return R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1, "nodes": { "fast": { "type": "graph:section", "times": 1000000 } },
          "graphs": { "section": { "nodes": { "all": { "type": "graph:one", "count": )"
               + std::to_string (instances) + R"( } } }, "one": { "nodes": { "noise": { "type": "signal.noise" } } } } })";
    };
    const auto file = scratch.write ("minutes.json", sections (20'000));
    const auto ran = runTactus ({ "render", file, "--duration", "1" });
    CHECK (ran.status == 1);
    CHECK_THAT (ran.err, Contains ("[graph/too_large]") && Contains ("--limits runs="));
    CHECK (runTactus ({ "validate", file, "--limits", "runs=100G" }).status == 0);
    CHECK (runTactus ({ "validate", scratch.write ("fine.json", sections (5)) }).status == 0);
}

TEST_CASE ("attack: brackets nested 5000 deep are refused", "[cli][budget]")
{
    const Scratch scratch;
    const auto ran = runTactus ({ "validate", scratch.write ("deep.json", std::string (5000, '[') + std::string (5000, ']')) });
    CHECK (ran.status == 1);
    CHECK_THAT (ran.err, Contains ("[file/too_deep]"));
}

TEST_CASE ("attack: a relief of 10^6 points in a row is refused, and a lower budget refuses a shorter one", "[cli][budget]")
{
    const Scratch scratch;
    const auto file = scratch.write ("relief.json", relief);
    scratch.write ("map.csv", profile (1'000'000));
    const auto ran = runTactus ({ "validate", file });
    CHECK (ran.status == 1);
    CHECK_THAT (ran.err, Contains ("the budget `time` allows") && Contains ("--limits time="));

    scratch.write ("map.csv", profile (100));
    CHECK (runTactus ({ "validate", file }).status == 0);
    const auto lowered = runTactus ({ "validate", file, "--limits", "numbers=99" });
    CHECK (lowered.status == 1);
    CHECK_THAT (lowered.err, Contains ("--limits numbers="));
}

TEST_CASE ("attack: 10^4 modes of 10^6 samples are refused", "[cli][budget]")
{
    const Scratch scratch;
    std::string modes;
    for (int i = 0; i < 10'000; ++i)
        modes += (i == 0 ? "" : ",") + std::string (R"({"frequency":100,"decay":1,"amplitude":1})");
    const auto text = graph (R"("m": { "type": "vibration.wavetable", "settings": { "table": { "length": 1000000, "modes": [)" + modes + "] } } }");
    const auto ran = runTactus ({ "validate", scratch.write ("modes.json", text) });
    CHECK (ran.status == 1);
    CHECK_THAT (ran.err, Contains ("--limits time="));
}

TEST_CASE ("attack: many small devices cannot read one large trace again and again", "[cli][budget]")
{
    const Scratch scratch;
    std::string trace = "t,x,y,z\n", devices;
    for (int i = 0; i < 1000; ++i)
        trace += std::to_string (0.001 * i) + ",0,0,0\n";
    scratch.write ("trace.csv", trace);
    for (int i = 0; i < 20; ++i)
        devices += (i == 0 ? "" : ", ") + ("\"r" + std::to_string (i)) + R"(": { "driver": "trace", "path": "trace.csv" })";
    const auto file = scratch.write ("traces.json", graph ("", R"(, "devices": { )" + devices + " }"));
    CHECK (runTactus ({ "validate", file }).status == 0);
    const auto ran = runTactus ({ "validate", file, "--limits", "reading=300kB" });
    CHECK (ran.status == 1);
    CHECK_THAT (ran.err, Contains ("--limits reading="));
}

TEST_CASE ("limits that do not exist, or are not amounts, are wrong usage", "[cli][budget]")
{
    const Scratch scratch;
    const auto file = scratch.write ("fine.json", graph (R"("a": { "type": "signal.add" })"));
    for (const auto* command : { "validate", "render", "play" })
    {
        const auto unknown = runTactus ({ command, file, "--limits", "noodles=3" });
        CHECK (unknown.status == 2);
        CHECK_THAT (unknown.err, Contains ("did you mean") && Contains ("nodes"));
    }
    CHECK (runTactus ({ "validate", file, "--limits", "nodes=many" }).status == 2);
    CHECK (runTactus ({ "validate", file, "--limits", "nodes=1k,memory=1GB,time=0.05s" }).status == 0);
    CHECK (runTactus ({ "validate", file, "--limits", "nodes=1" }).status == 1);
}

#if ! defined(_WIN32)
TEST_CASE ("attack: a named pipe in place of a file is refused, not waited for", "[cli][budget]")
{
    const Scratch scratch;
    const auto pipe = scratch.path ("pipe");
    REQUIRE (std::system (("mkfifo '" + pipe + "'").c_str()) == 0);
    const auto including = scratch.write ("including.json", graph (R"("a": { "type": "file:pipe" })"));
    const auto traced = scratch.write ("traced.json", graph (hand, R"(, "devices": { "pen": { "driver": "trace", "path": "pipe" } })"));
    const auto plain = scratch.write ("plain.json", graph (hand));
    for (const auto& arguments : std::vector<std::vector<std::string>> { { "validate", pipe },
                                                                         { "validate", including },
                                                                         { "validate", traced },
                                                                         { "render", plain, "--feed", pipe },
                                                                         { "render", plain, "--device", "pen=trace:" + pipe },
                                                                         { "render", "--replay", pipe },
                                                                         { "play", plain, "--session", pipe, "--osc", "off" } })
    {
        INFO (arguments.back());
        const auto ran = runTactus (arguments);
        INFO (ran.err);
        CHECK (ran.status == 1);
    }
    CHECK_THAT (runTactus ({ "validate", pipe }).err, Contains ("named pipe"));
}
#endif

TEST_CASE ("attack: the name of a graph cannot write to the terminal", "[cli]")
{
    const Scratch scratch;
    const auto name = R"(\u001b]0;title\u0007\u009b31m\u202ereversed\nline)" + std::string (300, 'x');
    const auto file = scratch.write ("name.json", graph (hand, R"(, "name": ")" + name + R"(", "devices": { "pen": { "driver": "sim" } })"));
    const auto ran = runTactus ({ "play", file, "--duration", "0.05", "--osc", "off", "--session", "off" });
    INFO (ran.err);
    CHECK (ran.status == 0);
    CHECK (ran.err.find ('\x1b') == std::string::npos);
    CHECK (ran.err.find ('\x07') == std::string::npos);
    CHECK (ran.err.find ("\xc2\x9b") == std::string::npos);
    CHECK (ran.err.find ("\xe2\x80\xae") == std::string::npos);
    CHECK_THAT (ran.err, Contains ("\\x1B]0;title\\x07") && Contains ("reversed\\x0Aline") && Contains ("x… at "));
    CHECK (ran.err.find (std::string (200, 'x')) == std::string::npos);
}

TEST_CASE ("attack: a trace, a feed or a log of a few bytes cannot ask for 10^9 ticks", "[cli][budget]")
{
    const Scratch scratch;
    const auto g = scratch.write ("g.json", graph (hand, R"(, "rate_hz": 1000)"));
    const auto trace = scratch.write ("trace.csv", "t,x,y,z\n0,0,0,0\n1e6,0,0,1\n");
    const auto out = scratch.path ("out.csv");
    const auto long_trace = runTactus ({ "render", g, "--device", "pen=trace:" + trace, "--out", out });
    CHECK (long_trace.status == 1);
    CHECK_THAT (long_trace.err, Contains ("2e+09 ticks") && Contains ("--duration") && Contains ("[run/too_long]"));
    CHECK (runTactus ({ "render", g, "--device", "pen=trace:" + trace, "--duration", "0.1", "--record", "hand.position", "--out", out }).status == 0);

    const auto parameter = scratch.write ("p.json", graph (R"("a": { "type": "signal.gain" })", R"(, "rate_hz": 1000)"));
    const auto fed = scratch.write ("fed.csv", "t,a.in\n0,0\n1e6,1\n");
    const auto long_feed = runTactus ({ "render", parameter, "--feed", fed, "--rate", "1000", "--record", "a.out", "--out", out });
    CHECK (long_feed.status == 1);
    CHECK_THAT (long_feed.err, Contains ("[run/too_long]"));

    const auto log = scratch.path ("run.jsonl");
    REQUIRE (runTactus ({ "play", g, "--device", "pen=sim", "--duration", "0.1", "--osc", "off", "--log", log }).status == 0);
    auto text = textOf (log);
    text.resize (text.rfind ("{\"tick\""));
    const auto longer = scratch.write ("longer.jsonl", text + "{\"tick\":1000000000,\"end\":true}\n");
    const auto long_log = runTactus ({ "render", "--replay", longer, "--record", "hand.position", "--out", out });
    CHECK (long_log.status == 1);
    CHECK_THAT (long_log.err, Contains ("1000000000 ticks") && Contains ("[log/too_long]"));
    CHECK (runTactus ({ "render", "--replay", longer, "--duration", "0.05", "--record", "hand.position", "--out", out }).status == 0);
}

TEST_CASE ("attack: a line end in a name cannot forge a message", "[cli][budget]")
{
    const Scratch scratch;
    const auto g = scratch.write ("g.json", graph (hand, R"(, "devices": { "pen": { "driver": "trace", "path": "no\nwarning: forged.csv" } })"));
    const auto ran = runTactus ({ "render", g });
    CHECK (ran.status == 1);
    CHECK_THAT (ran.err, Contains ("forged"));
    CHECK_THAT (ran.err, ! Contains ("\nwarning: forged"));
    const auto option = runTactus ({ "render", g, "--device", "pen=trace:no\nwarning: forged.csv" });
    CHECK (option.status == 1);
    CHECK_THAT (option.err, Contains ("forged") && ! Contains ("\nwarning: forged"));
}
