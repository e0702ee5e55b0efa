// SPDX-License-Identifier: GPL-3.0-or-later
// What `tactus play` reports about its ticks.

#include "program.hpp"

#include <tactus/file/csv.hpp>
#include <tactus/text/json.hpp>

#include <catch2/catch.hpp>

#include <filesystem>

using namespace tactus;
using test::runTactus;
using test::Scratch;

TEST_CASE ("play ends with a report of late and missed ticks", "[cli]")
{
    const auto ran = runTactus ({ "play", TACTUS_SOURCE_DIR "/graphs/dry_wood.json", "--duration", "0.2", "--osc", "off", "--core", "0" });
    INFO (ran.err);
    CHECK (ran.status == 0);
    const auto line = ran.err.substr (ran.err.rfind ("late p50"));
    double p50 = -1, p99 = -1, longest = -1;
    unsigned long missed = 0, ticks = 0;
    REQUIRE (std::sscanf (line.c_str(), "late p50 %lf us, p99 %lf us, max %lf us, missed %lu of %lu ticks", &p50, &p99, &longest, &missed, &ticks) == 5);
    CHECK (p50 >= 0.0);
    CHECK (p99 >= p50);
    CHECK (longest >= p99 - 0.5);
    CHECK (missed <= ticks);
    CHECK (ticks > 0);   // how many depends on what else the computer does
}

TEST_CASE ("on request, play ends with the most expensive nodes", "[cli]")
{
    const auto ran = runTactus ({ "play", TACTUS_SOURCE_DIR "/graphs/dry_wood.json", "--duration", "1", "--osc", "off", "--costs" });
    INFO (ran.err);
    CHECK (ran.status == 0);
    const auto line = ran.err.find ("mean us   share   node\n");
    REQUIRE (line != std::string::npos);
    double mean = -1.0, share = -1.0;
    REQUIRE (std::sscanf (ran.err.c_str() + ran.err.find ('\n', line), "%lf %lf %%", &mean, &share) == 2);
    CHECK (mean > 0.0);
    CHECK (mean < 1000.0);
    CHECK (share > 5.0);
    CHECK (share <= 100.0);
    CHECK (ran.err.find ("(friction.elasto_plastic)", line) != std::string::npos);
}

TEST_CASE ("a graph that takes longer than a tick period is stopped, its most expensive node is named, and its recording is kept", "[cli]")
{
    const Scratch scratch;
    auto modes = Json::array();
    for (int i = 0; i < 20000; ++i)
        modes.push_back ({ { "frequency", 100.0 + i }, { "decay", 5.0 }, { "amplitude", 1.0 } });
    const auto graph = R"({ "format": "tactus-graph", "version": 1, "name": "Heavy", "rate_hz": 200000,
      "nodes": { "idle": { "type": "signal.abs" }, "bar": { "type": "vibration.modal", "settings": { "modes": )"
                       + modes.dump() + R"( } } },
      "wires": [ "idle.out -> bar.hit" ] })";
    const auto ran = runTactus ({ "play", scratch.write ("g.json", graph), "--duration", "60", "--osc", "off",
                                  "--record", "idle.out", "--out", scratch.path ("p.csv") });
    INFO (ran.err);
    CHECK (ran.status == 1);
    CHECK (ran.err.find ("[run/overrun]") != std::string::npos);
    CHECK (ran.err.find ("'bar' (vibration.modal)") != std::string::npos);
    const auto table = readTable (std::filesystem::path (scratch.path ("p.csv")));
    REQUIRE (table);
    CHECK (table->rows() < 12'000'000);
}
