// SPDX-License-Identifier: GPL-3.0-or-later
// A `tactus play` whose tick does not end.

#include "running.hpp"

#include <catch2/catch.hpp>

#include <sstream>
#include <string>

#include <unistd.h>

using namespace tactus;
using test::Running;
using test::Scratch;
using test::soon;

namespace
{
/// The CPU time that all threads of a process have used.
double cpuSeconds (long process)
{
    const auto line = test::textOf ("/proc/" + std::to_string (process) + "/stat");
    std::istringstream fields (line.substr (line.rfind (')') + 2));
    std::string skipped;
    for (int i = 0; i < 11; ++i)   // up to the 13th field of proc(5)
        fields >> skipped;
    double user = 0.0, system = 0.0;
    fields >> user >> system;
    return (user + system) / static_cast<double> (sysconf (_SC_CLK_TCK));
}
}   // namespace

TEST_CASE ("a play whose tick does not end can still be ended, and says why its files are not finished", "[cli]")
{
    // 2 x 10^10 node ticks in each tick of the graph: many seconds on any machine.
    const auto graph = R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1, "nodes": { "fast": { "type": "graph:section", "times": 1000000 } },
      "graphs": { "section": { "nodes": { "all": { "type": "graph:one", "count": 20000 } } },
                  "one": { "nodes": { "noise": { "type": "signal.noise" } } } } })";
    const Scratch scratch;
    Running play { { "play", scratch.write ("g.json", graph), "--osc", "off", "--limits", "runs=100G" } };
    REQUIRE (play.says ("Ctrl-C stops"));
    REQUIRE (soon ([&] { return cpuSeconds (play.id()) > 2.0; }));   // only the tick takes that much
    const auto ran = play.stop();
    INFO (ran.err);
    CHECK (ran.status == 1);
    CHECK (ran.err.find ("[run/stuck]") != std::string::npos);
}
