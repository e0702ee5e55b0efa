// SPDX-License-Identifier: GPL-3.0-or-later

#include "program.hpp"

#include <catch2/catch.hpp>

#include <filesystem>

using namespace tactus::test;

namespace
{
constexpr auto part = R"({ "format": "tactus-graph", "version": 1, "nodes": { "one": { "type": "signal.constant" } }, "wires": [] })";
constexpr auto whole = R"({ "format": "tactus-graph", "version": 1, "rate_hz": 1000,
  "devices": { "stylus": { "driver": "trace", "path": "pen.csv" } },
  "nodes": { "part": { "type": "file:part.json" }, "hand": { "type": "device.position", "role": "stylus" },
      "wall": { "type": "deform.plane" }, "motor": { "type": "device.force", "role": "stylus" } },
  "wires": ["hand.position -> wall.position", "wall.force -> motor.force"] })";
}   // namespace

TEST_CASE ("a file that a run reads is never overwritten under any name, and no file is written twice", "[cli]")
{
    const Scratch scratch;
    const auto graph = scratch.write ("g.json", whole), inside = scratch.write ("part.json", part),
               pen = scratch.write ("pen.csv", "t,x,y,z\n0,0,0,0\n0.1,0.01,0,-0.001\n"), feed = scratch.write ("feed.csv", "wall.stiffness\n1000\n900\n");
    const auto link = scratch.path ("link.csv");
    std::filesystem::create_symlink (pen, link);

    const auto refused = [&] (const std::vector<std::string>& arguments, const std::string& id, const std::string& kept) {
        const auto before = textOf (kept);
        const auto ran = runTactus (arguments);
        INFO (ran.err);
        CHECK (ran.status == 1);
        CHECK (ran.err.find ("[" + id + "]") != std::string::npos);
        CHECK (textOf (kept) == before);
    };
    refused ({ "play", graph, "--osc", "off", "--log", graph }, "output/is_input", graph);
    refused ({ "play", graph, "--osc", "off", "--log", inside }, "output/is_input", inside);
    refused ({ "render", graph, "--out", pen }, "output/is_input", pen);
    refused ({ "render", graph, "--out", link }, "output/is_input", pen);
    refused ({ "render", graph, "--device", "stylus=trace:" + pen, "--out", scratch.path ("./pen.csv") }, "output/is_input", pen);
    refused ({ "render", graph, "--feed", feed, "--out", feed }, "output/is_input", feed);
    refused ({ "render", graph, "--out", scratch.path ("a.csv"), "--out", scratch.path ("a.csv") }, "output/twice", graph);
    refused ({ "play", graph, "--osc", "off", "--out", scratch.path ("a.csv"), "--log", scratch.path ("a.csv") }, "output/twice", graph);
    CHECK_FALSE (std::filesystem::exists (scratch.path ("a.csv")));

    const auto log = scratch.path ("run.jsonl");
    REQUIRE (runTactus ({ "play", graph, "--osc", "off", "--log", log }).status == 0);
    std::filesystem::copy_file (log, scratch.path ("run.csv"));
    refused ({ "render", "--replay", scratch.path ("run.csv"), "--out", scratch.path ("run.csv") }, "output/is_input", scratch.path ("run.csv"));
}
