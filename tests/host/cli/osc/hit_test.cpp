// SPDX-License-Identifier: GPL-3.0-or-later
// `tactus hit` triggers hits in a running play, and a replay triggers them again.

#include "host/cli/running.hpp"

#include <tactus/file/csv.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>

using namespace tactus;
using test::Running;
using test::runTactus;
using test::Scratch;

TEST_CASE ("a hit lasts one tick, is logged, and is repeated byte for byte", "[cli][osc][hit]")
{
    const Scratch scratch;
    const auto graph = scratch.write ("g.json", R"({ "format": "tactus-graph", "version": 1, "name": "Bell", "rate_hz": 1000,
      "devices": { "stylus": { "driver": "sim" } },
      "nodes": { "ring": { "type": "vibration.modal", "settings": { "modes": [ { "frequency": 100, "decay": 10, "amplitude": 0.5 } ] } },
          "motor": { "type": "device.force", "role": "stylus" } },
      "wires": [ "ring.value -> motor.force.z" ] })");
    Running play { { "play", graph, "--osc", "0", "--watch", "--duration", "600", "--record", "ring.hit,ring.value,motor.applied",
                     "--out", scratch.path ("live.csv"), "--log", scratch.path ("run.jsonl") } };
    REQUIRE (play.says ("Ctrl-C stops"));
    const auto text = play.err();
    const std::string before = "OSC on 127.0.0.1:";
    const auto port = std::to_string (std::stoi (text.substr (text.find (before) + before.size())));

    const auto hit = [&] (const std::string& what) { return runTactus ({ "hit", what, "--osc", port }); };
    CHECK (hit ("ring.hit").status == 0);
    CHECK (hit ("ring.hit=0.5").status == 0);
    for (const auto* wrong : { "ring", "ring.hit=", "ring.hit=fast", "=1" })
        CHECK (hit (wrong).status == 2);
    const auto refused = [&] (const char* what, const char* id) {
        const auto ran = hit (what);
        CHECK (ran.status == 1);
        CHECK (ran.err.find (id) != std::string::npos);
    };
    refused ("rings.hit=1", "[port/unknown_node]");
    refused ("ring.gain", "[hit/unknown]");
    refused ("ring.hit=nan", "[hit/value]");
    refused ("ring.hit=-1", "[hit/value]");
    refused ("ring.hit=1e30", "[hit/value]");

    scratch.write ("g.json", test::textOf (graph) + "\n");
    REQUIRE (play.says (": reloaded"));
    CHECK (hit ("ring.hit=0.25").status == 0);
    const auto live = play.stop();
    CHECK (live.status == 0);

    const auto again = runTactus ({ "render", "--replay", scratch.path ("run.jsonl"), "--record", "ring.hit,ring.value,motor.applied",
                                    "--out", scratch.path ("again.csv") });
    INFO (again.err);
    CHECK (again.status == 0);
    const auto all = readTable (std::filesystem::path (scratch.path ("again.csv")));
    REQUIRE (all);
    std::vector<double> hits;
    double loudest = 0.0;
    for (std::size_t r = 0; r < all->rows(); ++r)
    {
        if (all->at (r, 1) != 0.0) hits.push_back (all->at (r, 1));
        loudest = std::max (loudest, all->at (r, 2));
    }
    CHECK (hits == std::vector<double> { 1.0, 0.5, 0.25 });
    CHECK (loudest > 0.1);

    CHECK (test::sameRows (scratch.path ("live.csv"), scratch.path ("again.csv"), live.err));
}
