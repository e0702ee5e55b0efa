// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>

using namespace tactus::test;
namespace fs = std::filesystem;

namespace
{
const std::string good_preset = R"({ "format": "tactus-graph", "version": 2, "name": "Soft wall",
    "about": "A wall of foam. Press into it, and let it push you out.",
    "tags": ["press"], "rate_hz": 4000,
    "devices": { "stylus": { "driver": "sim", "mass": "50 g", "damping": "1 N*s/m",
        "hand": { "stiffness": "300 N/m", "damping": "6 N*s/m", "path": "press" },
        "guard": { "max_force": "6 N", "max_speed": "2 m/s", "max_impulse": "30 N*s", "impulse_window": "10 s", "max_energy": "120 mJ",
                   "energy_window": "1 s" } } },
    "nodes": { "hand": { "type": "device.position", "role": "stylus" },
        "foam": { "type": "deform.plane", "params": { "stiffness": "300 N/m", "damping": "0.2 N*s/m" }, "settings": { "window": "1 ms" } },
        "motor": { "type": "device.force", "role": "stylus" } },
    "wires": ["hand.position -> foam.position", "foam.force -> motor.force"],
    "controls": { "firmness": { "name": "Firmness", "value": 0.5, "to": { "foam.stiffness": ["100 N/m", "500 N/m"] } } },
    "ui": { "license": "CC0-1.0", "sources": { "foam.stiffness": "guess", "foam.damping": "guess" } } })";

std::string with (const std::string& old, const std::string& now)
{
    auto text = good_preset;
    const auto at = text.find (old);
    REQUIRE (at != std::string::npos);
    return text.replace (at, old.size(), now);
}

std::size_t errorsIn (const std::string& text)
{
    std::size_t count = 0;
    for (auto at = text.find (": error: "); at != std::string::npos; at = text.find (": error: ", at + 1))
        ++count;
    return count;
}
}   // namespace

TEST_CASE ("`tactus check-preset` passes a good preset, and says how its forces compare with the gentlest device", "[check_preset][cli]")
{
    const Scratch scratch;
    const auto file = scratch.write ("foam.json", good_preset);
    const auto unformatted = runTactus ({ "check-preset", file });
    INFO (unformatted.err);
    CHECK (unformatted.status == 1);
    CHECK (unformatted.err.find ("[preset/format]") != std::string::npos);
    CHECK (errorsIn (unformatted.err) == 1);
    CHECK (textOf (file) == good_preset);

    const auto formatted = runTactus ({ "check-preset", "--format", file });
    INFO (formatted.out << formatted.err);
    CHECK (formatted.status == 0);
    CHECK (textOf (file) != good_preset);
    const auto ran = runTactus ({ "check-preset", file });
    CHECK (ran.status == 0);
    CHECK (ran.err.empty());
    CHECK (ran.out == formatted.out);
    CHECK (ran.out.find ("foam.json: ok\n") != std::string::npos);
    CHECK (ran.out.find ("4 runs of ") != std::string::npos);
    CHECK (ran.out.find ("dualpanto, the gentlest device that comes with Tactus, allows 2 N and 0.5 N: ") != std::string::npos);
}

TEST_CASE ("`tactus check-preset` passes a preset in the current folder, whose built-in gesture is no file beside it", "[check_preset][cli]")
{
    const Scratch scratch;
    const auto folder = fs::path (scratch.write ("good.json", good_preset)).parent_path().string();
    REQUIRE (runTactus ({ "check-preset", "--format", scratch.path ("good.json") }).status == 0);
    const auto ran = runProgram ("/bin/sh", { "-c", "cd \"$0\" && exec \"$1\" check-preset good.json", folder, TACTUS_PROGRAM });
    INFO (ran.out + ran.err);
    CHECK (ran.status == 0);
}

TEST_CASE ("`tactus check-preset` says what a preset lacks, what is wrong in it, and where", "[check_preset][cli]")
{
    struct Bad
    {
        const char *old, *now, *id;
    };
    const Bad all[] {
        { R"("name": "Soft wall")", R"("name": "S")", "preset/name" },
        { R"("about": "A wall of foam. Press into it, and let it push you out.")", R"("about": "A wall.")", "preset/about" },
        { R"("tags": ["press"])", R"("tags": [])", "preset/tags" },
        { R"("rate_hz": 4000)", R"("rate_hz": 50)", "preset/rate" },
        { R"("controls": { "firmness": { "name": "Firmness", "value": 0.5, "to": { "foam.stiffness": ["100 N/m", "500 N/m"] } } })", R"("controls": {})",
          "preset/controls" },
        { R"("license": "CC0-1.0", )", "", "preset/licence" },
        { R"("license": "CC0-1.0")", R"("license": "All rights reserved")", "preset/licence" },
        { R"("license": "CC0-1.0")", R"("license": ["MIT"])", "preset/licence" },
        { R"("sources": { "foam.stiffness": "guess", "foam.damping": "guess" })", R"("sources": {})", "preset/source" },
        { R"("foam.damping": "guess")", R"("form.damping": "guess")", "preset/source" },
        { R"("foam.damping": "guess")", R"("foam.damping": "?")", "preset/source" },
        { R"("driver": "sim", "mass": "50 g", "damping": "1 N*s/m",
        "hand": { "stiffness": "300 N/m", "damping": "6 N*s/m", "path": "press" },)",
          R"("driver": "gesture", "path": "press",)", "preset/device" },
        { R"("max_speed": "2 m/s", )", "", "preset/guard" },
        { R"("max_force": "6 N")", R"("max_force": "60 N")", "preset/guard" },
        { R"("impulse_window": "10 s")", R"("impulse_window": "1 s")", "preset/guard" },
        { R"("stiffness": "300 N/m", "damping": "0.2 N*s/m")", R"("stiffness": "300 N", "damping": "0.2 N*s/m")", "param/unit" },
        { R"("tags": ["press"])", R"("tags": ["press"], "tgas": [])", "file/unknown_key" },
        { R"("foam.force -> motor.force")", R"("foam.force -> [1] -> motor.force")", "preset/late" },
        { R"("path": "press" })", R"("path": "../press.csv" })", "preset/outside" },
        { R"("path": "press" })", R"("path": "press", "offset": [0, 0, "5 cm"] })", "preset/weak" },
        { R"("path": "press" })", R"("path": "long.csv" })", "preset/gesture" },
        { R"("max_force": "6 N")", R"("max_force": "0.3 N")", "preset/guard" },
        { R"("to": { "foam.stiffness": ["100 N/m", "500 N/m"] })", R"("to": { "foam.offset": [0, 0] })", "preset/knob" },
        { R"("to": { "foam.stiffness": ["100 N/m", "500 N/m"] })", R"("to": { "foam.offset": [0, "20 cm"] })", "preset/stopped" },
        { R"("max_force": "6 N", "max_speed": "2 m/s", "max_impulse": "30 N*s", "impulse_window": "10 s", "max_energy": "120 mJ",)",
          R"("max_force": "0.4 N", "max_speed": "2 m/s", "max_impulse": "2 N*s", "impulse_window": "10 s", "max_energy": "8 mJ",)", "preset/strong" },
        { R"("max_speed": "2 m/s")", R"("max_speed": "1 mm/s")", "preset/stopped" },
        { R"("value": 0.5, "to": { "foam.stiffness": ["100 N/m", "500 N/m"] })", R"("value": 0.5, "to": { "foam.offset": [0, "1 cm"] })", "preset/lasting" },
    };
    for (const auto& bad : all)
    {
        DYNAMIC_SECTION (bad.id << ": " << bad.now)
        {
            const Scratch scratch;
            scratch.write ("press.csv", "t,x,y,z\n0,0,0,0.01\n1,0,0,-0.01\n2,0,0,0.01\n");
            const auto folder = scratch.path ("mine");
            fs::create_directory (folder);
            scratch.write ("mine/long.csv", "t,x,y,z\n0,0,0,0.01\n40,0,0,-0.01\n");
            const auto file = scratch.write ("mine/bad.json", with (bad.old, bad.now));
            const auto ran = runTactus ({ "check-preset", "--format", file });
            INFO (ran.out << ran.err);
            CHECK (ran.status == 1);
            CHECK (ran.out.empty());
            CHECK (ran.err.find ("[" + std::string (bad.id) + "]") != std::string::npos);
            CHECK (ran.err.starts_with (file + ":"));
        }
    }
}

TEST_CASE ("`tactus check-preset` checks each of its files, and refuses what is no graph", "[check_preset][cli]")
{
    const Scratch scratch;
    const auto good = scratch.write ("good.json", good_preset), empty = scratch.write ("empty.json", ""), missing = scratch.path ("missing.json");
    const auto ran = runTactus ({ "check-preset", "--format", empty, missing, good });
    INFO (ran.out << ran.err);
    CHECK (ran.status == 1);
    CHECK (ran.err.find ("[file/syntax]") != std::string::npos);
    CHECK (ran.err.find ("[file/unreadable]") != std::string::npos);
    CHECK (ran.out.find ("good.json: ok") != std::string::npos);
    CHECK (textOf (empty).empty());
    CHECK (runTactus ({ "check-preset" }).status == 2);
}
