// SPDX-License-Identifier: GPL-3.0-or-later

#include "program.hpp"

#include <catch2/catch.hpp>

using namespace tactus::test;

TEST_CASE ("every command that takes a graph file takes the name of a preset", "[cli]")
{
    const std::string file = TACTUS_SOURCE_DIR "/graphs/dry_wood.json";
    const auto validated = runTactus ({ "validate", "dry_wood", "steel_bar" });
    CHECK (validated.status == 0);
    CHECK (withSlashes (validated.out).find ("graphs/steel_bar.json: ok") != std::string::npos);

    const auto by_file = runTactus ({ "render", file, "--duration", "0.01" }), by_name = runTactus ({ "render", "dry_wood", "--duration", "0.01" });
    CHECK (by_file.out.size() > 100);
    CHECK (by_name.out == by_file.out);

    CHECK (runTactus ({ "session", "dry_wood", "--file", "/dev/null/none.json" }).out == runTactus ({ "session", file, "--file", "/dev/null/none.json" }).out);
}

TEST_CASE ("what looks like a file is never taken for a preset", "[cli]")
{
    for (const auto* name : { "dry_wood.json", "./dry_wood", "no_such_preset" })
    {
        const auto ran = runTactus ({ "validate", name });
        CHECK (ran.status == 1);
        CHECK (ran.err.starts_with (name));
        CHECK (ran.err.find ("[file/unreadable]") != std::string::npos);
    }
}

TEST_CASE ("what is written in the wrong unit, or in the wrong place, is answered with what to write", "[cli]")
{
    const auto says = [] (const std::vector<std::string>& words) { return runTactus (words).err; };
    CHECK (says ({ "render", "dry_wood", "--set", "drag.mu=0.4N" }).find ("has no unit, but \"0.4N\" is in N") != std::string::npos);
    CHECK (says ({ "render", "dry_wood", "--duration", "4s" }).find ("write it without a unit") != std::string::npos);
    CHECK (says ({ "fit", "friktion", "x.csv" }).starts_with ("There is no command 'fit friktion' (did you mean 'friction'?)"));
    CHECK (says ({ "validate", TACTUS_SOURCE_DIR "/graphs" }).find ("name a file in it, such as") != std::string::npos);
}

TEST_CASE ("a folder in place of a serial line is told to be one", "[cli]")
{
    const auto ran = runTactus ({ "play", "dry_wood", "--device", "stylus=serial:tactus_board@" TACTUS_SOURCE_DIR, "--duration", "0.01", "--session", "off" });
    CHECK (ran.err.find ("it is a folder, not a serial line") != std::string::npos);
}

TEST_CASE ("a mistyped preset or file gets a suggestion", "[cli]")
{
    for (const auto* command : { "validate", "render", "session" })
    {
        const auto ran = runTactus ({ command, "dry_wod" });
        CHECK (ran.status == 1);
        CHECK (ran.err.find ("did you mean 'dry_wood'?") != std::string::npos);
    }
    const auto file = runTactus ({ "validate", TACTUS_SOURCE_DIR "/graphs/dry_wod.json" });
    CHECK (file.err.find ("did you mean 'dry_wood.json'?") != std::string::npos);
    CHECK (runTactus ({ "validate", "qqqqqq" }).err.find ("did you mean") == std::string::npos);

    const auto several = runTactus ({ "validate", "dry_wod", "steel_bar" });   // one mistake does not hide the other files
    CHECK (several.status == 1);
    CHECK (withSlashes (several.out).find ("graphs/steel_bar.json: ok") != std::string::npos);
}

TEST_CASE ("the version names the program and the C API", "[cli]")
{
    const auto version = runTactus ({ "--version" }).out;
    CHECK (version.starts_with ("tactus "));
    CHECK (version.ends_with (" (C API 1)\n"));
}
