// SPDX-License-Identifier: GPL-3.0-or-later
// A `tactus play` whose tick does not end.

#include "running.hpp"

#include <catch2/catch.hpp>

#include <string>

using namespace tactus;
using test::Running;
using test::Scratch;

TEST_CASE ("a play whose tick does not end can still be ended, and says why its files are not finished", "[cli]")
{
    // 2 x 10^10 node ticks in each tick of the graph: many seconds on any machine.
    const auto graph = R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1, "nodes": { "fast": { "type": "graph:section", "times": 1000000 } },
      "graphs": { "section": { "nodes": { "all": { "type": "graph:one", "count": 20000 } } },
                  "one": { "nodes": { "noise": { "type": "signal.noise" } } } } })";
    const Scratch scratch;
    Running play { { "play", scratch.write ("g.json", graph), "--osc", "off", "--limits", "runs=100G" } };
    REQUIRE (play.says ("Ctrl-C stops"));
    const auto ran = play.stop();
    INFO (ran.err);
    CHECK (ran.status == 1);
    CHECK (ran.err.find ("[run/stuck]") != std::string::npos);
}
