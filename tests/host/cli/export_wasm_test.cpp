// SPDX-License-Identifier: GPL-3.0-or-later
// A graph as a WebAssembly module, in node and in a browser.

#include "program.hpp"

#include <tactus/text/json.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <sstream>

using namespace tactus;
using namespace tactus::test;

namespace
{
bool hasTools()
{
    if (std::system ("command -v clang++-22 wasm-ld-22 node > /dev/null && [ -d /usr/lib/wasm32-wasi ]") == 0) return true;
    WARN ("skipped: needs clang-22 lld-22 libc++-22-dev-wasm32 libclang-rt-22-dev-wasm32 wasi-libc nodejs");
    return false;
}

/// Into the object, sideways with a turn, and out again.
std::string motion (int ticks, double rate_hz)
{
    std::ostringstream trace;
    trace.precision (17);
    trace << "t,x,y,z\n";
    for (int k = 0; k < ticks; ++k)
    {
        const double t = k / rate_hz;
        trace << t << "," << 0.004 * std::sin (9.0 * t) << "," << 0.001 * std::sin (5.0 * t) << "," << 0.0006 - 0.0012 * std::sin (2.5 * t) << "\n";
    }
    return trace.str();
}

/// The numbers of a CSV, without its header.
std::vector<std::vector<double>> numbersOf (const std::string& csv)
{
    std::vector<std::vector<double>> rows;
    std::istringstream lines (csv);
    std::string line;
    std::getline (lines, line);
    while (std::getline (lines, line))
    {
        auto& row = rows.emplace_back();
        std::istringstream cells (line);
        for (std::string cell; std::getline (cells, cell, ',');)
            row.push_back (std::strtod (cell.c_str(), nullptr));
    }
    return rows;
}
}   // namespace

TEST_CASE ("a graph in WebAssembly gives the bits of render through its JavaScript, in Node.js and in a browser", "[cli][export][wasm]")
{
    if (! hasTools()) return;
    // It has a formula, which libc++ reads, and must import nothing all the same.
    const Scratch scratch;
    const auto folder = scratch.path ("web"), trace = scratch.write ("in.csv", motion (4000, 4000.0)), out = scratch.path ("out.csv");
    const auto exported = runTactus ({ "export", "canvas_weave", "-o", folder, "--to", "wasm" });
    INFO (exported.err);
    REQUIRE (exported.status == 0);
    REQUIRE (runProgram ("make", { "-s", "-C", folder, "wasm", "WASM_CXXFLAGS=-O1" }).status == 0);

    const auto here =
        runTactus ({ "render", "canvas_weave", "--device", "stylus=trace:" + trace, "--set", "drag.d_max=0.0005", "--set", "weave=0.8", "--out", out });
    INFO (here.err);
    REQUIRE (here.status == 0);
    const auto csv = textOf (out);
    const auto expected = numbersOf (csv);
    REQUIRE (expected.size() == 4000);
    double largest = 0.0;
    for (const auto& row : expected)
        largest = std::max (largest, std::abs (row[1]));
    CHECK (largest > 0.1);
    const auto isSame = [&] (const std::string& found) {
        return csv.substr (0, csv.find ('\n')) == found.substr (0, found.find ('\n')) && expected == numbersOf (found);
    };

    const std::string scripts = TACTUS_SOURCE_DIR "/tests/host/code/generate/wasm/";
    const std::vector<std::string> motions { trace, "drag.d_max=0.0005", "weave=0.8" };
    const auto with = [&] (std::vector<std::string> words) {
        words.insert (words.end(), motions.begin(), motions.end());
        return words;
    };
    for (const auto* node : { "node", "node18", "node20", "node22", "node24" })   // other versions, if they are in PATH under these names
    {
        INFO (node);
        if (std::system (("command -v " + std::string (node) + " > /dev/null").c_str()) != 0) continue;
        for (const std::string script : { "package_in_node.mjs", "worklet_in_node.mjs" })
        {
            const auto tried = runProgram (node, { scripts + script, folder, "-0.0003" });
            INFO (script << "\n"
                         << tried.err);
            CHECK (tried.out == "ok\n");
        }
        const auto there = runProgram (node, with ({ scripts + "render_in_node.mjs", folder + "/canvas_weave.js" }));
        INFO (there.err);
        CHECK (there.status == 0);
        CHECK (isSame (there.out));
    }
    const auto browser = runProgram ("python3", with ({ "-B", scripts + "package_in_browser.py", folder }));
    INFO (browser.err);
    if (browser.status == 77)
        WARN (browser.out);
    else
    {
        CHECK (browser.status == 0);
        CHECK (isSame (browser.out));
    }
}

TEST_CASE ("the AudioWorklet of a graph with two tools moves each of them by itself", "[cli][export][wasm]")
{
    if (! hasTools()) return;
    const Scratch scratch;
    const auto folder = scratch.path ("web");
    REQUIRE (runTactus ({ "export", "two_fingers", "-o", folder, "--to", "wasm" }).status == 0);
    REQUIRE (runProgram ("make", { "-s", "-C", folder, "wasm", "WASM_CXXFLAGS=-O1" }).status == 0);
    const auto tried = runProgram ("node", { TACTUS_SOURCE_DIR "/tests/host/code/generate/wasm/worklet_in_node.mjs", folder, "-0.001", "-0.001" });
    INFO (tried.err);
    CHECK (tried.out == "ok\n");
}

TEST_CASE ("a module for WebAssembly has doubles, types and a class with the names of its graph", "[cli][export][wasm]")
{
    const Scratch scratch;
    const auto folder = scratch.path ("web");
    checkRefused ({ "export", "two_fingers", "-o", folder, "--to", "wasm", "--float" }, 1, "export/float", folder);
    REQUIRE (runTactus ({ "export", "two_fingers", "-o", folder, "--to", "wasm" }).status == 0);
    const auto types = textOf (folder + "/two_fingers.d.ts");
    for (const auto* text : { "export class TwoFingers extends Graph<", "    readonly thumb: Effort;", "export type Control = \"firmness\" | ",
                              "export type Hit = \"creak.hit\";", "export type Role = \"index\" | \"thumb\";" })
        CHECK (types.find (text) != std::string::npos);
    for (const auto* file : { "two_fingers.js", "tactus_graph.js", "tactus_graph.d.ts", "two_fingers_wasm.cpp", "two_fingers.h", "two_fingers_worklet.d.ts",
                              "tactus_page.d.ts" })
        CHECK (std::filesystem::exists (folder + "/" + file));
    CHECK_FALSE (std::filesystem::exists (folder + "/two_fingers_example.c"));
}

TEST_CASE ("the page on exports shows the page of an export, whole, in about 20 lines", "[cli][export][wasm]")
{
    const Scratch scratch;
    const auto folder = scratch.path ("web");
    REQUIRE (runTactus ({ "export", "dry_wood", "-o", folder, "--to", "wasm" }).status == 0);
    const auto page = textOf (folder + "/index.html");
    CHECK (std::count (page.begin(), page.end(), '\n') <= 20);
    CHECK (textOf (TACTUS_SOURCE_DIR "/docs/export.md").find ("```html\n" + page + "```\n") != std::string::npos);
}

TEST_CASE ("only Node.js gets files of a module for WebAssembly that import modules of Node.js", "[cli][export][wasm]")
{
    const Scratch scratch;
    const auto folder = scratch.path ("web");
    REQUIRE (runTactus ({ "export", "dry_wood", "-o", folder, "--to", "wasm" }).status == 0);
    std::set<std::string> importers;
    for (const auto& file : std::filesystem::directory_iterator (folder))
        if (const auto name = file.path().filename().string(); name.ends_with (".js") || name.ends_with (".html"))
            if (const auto text = textOf (file.path().string()); text.find ("node:") != std::string::npos || text.find ("tactus_node.js'") != std::string::npos)
                importers.insert (name);
    CHECK (importers == std::set<std::string> { "dry_wood_node.js", "tactus_node.js" });
    const auto package = Json::parse (textOf (folder + "/package.json"));
    std::set<std::string> listed;
    for (const auto& file : package.at ("files").asArray())
        listed.insert ("./" + file.asString());
    for (const auto& [name, conditions] : package.at ("exports").asObject())
    {
        INFO (name);
        if (! conditions.is_object()) continue;
        CHECK (conditions.asObject().back().first == "default");
        for (const auto& [condition, file] : conditions.asObject())
        {
            CHECK (std::filesystem::exists (folder + "/" + file.asString()));
            CHECK (listed.contains (file.asString()));
            if (condition != "node") CHECK_FALSE (importers.contains (file.asString().substr (2)));
        }
    }
}
