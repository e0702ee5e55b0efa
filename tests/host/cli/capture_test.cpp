// SPDX-License-Identifier: GPL-3.0-or-later
// `tactus capture` makes a clip, a gesture or a test from a stretch of a logged run, and `tactus test` plays tests.

#include "program.hpp"

#include <tactus/file/clips/clip_file.hpp>
#include <tactus/file/csv.hpp>
#include <tactus/file/text_file.hpp>

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>

using namespace tactus;
using test::checkRefused;
using test::runTactus;
using test::Scratch;
using test::textOf;

namespace
{
bool says (const std::string& text, const std::string& words) { return text.find (words) != std::string::npos; }

/// Logs a second of a stroke over a board. Returns the log.
std::string loggedBoard (const Scratch& scratch, const std::string& preset = "dry_wood", const std::string& ticks = "4000")
{
    const auto log = scratch.path ("run.jsonl");
    const auto played = runTactus ({ "play", std::string (TACTUS_SOURCE_DIR) + "/graphs/" + preset + ".json", "--session", "off", "--osc", "off", "--ticks",
                                     ticks, "--log", log });
    INFO (played.err);
    REQUIRE (played.status == 0);
    return log;
}

test::Ran captured (std::vector<std::string> arguments)
{
    arguments.insert (arguments.begin(), "capture");
    auto ran = runTactus (arguments);
    INFO (ran.out << ran.err);
    CHECK (ran.status == 0);
    return ran;
}

/// Replaces one occurrence of a text in a file.
void replaceIn (const std::string& file, const std::string& from, const std::string& to)
{
    auto text = textOf (file);
    const auto at = text.find (from);
    REQUIRE (at != std::string::npos);
    std::ofstream (file, std::ios::binary) << text.replace (at, from.size(), to);
}

/// The line of a file, from 1.
std::string lineOf (const std::string& file, int number)
{
    std::ifstream in (file);
    std::string line;
    for (int i = 0; i < number; ++i)
        std::getline (in, line);
    return line;
}
}   // namespace

TEST_CASE ("capture: a test of a run passes in any folder, and fails if a value differs", "[cli][capture]")
{
    const Scratch scratch;
    const auto log = loggedBoard (scratch);
    std::filesystem::create_directories (scratch.path ("deep/er"));
    const auto file = scratch.path ("deep/er/wood.jsonl");
    CHECK (says (captured ({ log, "--from", "0.5", "--until", "0.9", "--test", file }).out, "compares from 0.5 s on"));
    const auto same = runTactus ({ "test", file });
    CHECK (same.status == 0);
    CHECK (says (same.out, "wood.jsonl: same, 1600 ticks of 6 values, Dry wood"));
    std::filesystem::remove (log);

    const auto line = lineOf (file, 12);   // tick 2010
    replaceIn (file, "\n" + line + "\n", "\n[1234.5" + line.substr (line.find (',')) + "\n");
    const auto differs = runTactus ({ "test", file, file });
    CHECK (differs.status == 1);
    CHECK (says (differs.out, "DIFFERENT"));
    CHECK (says (differs.out, "motor.force.x: first at tick 2010 (0.5025 s): expected 1234.5, found "));
    CHECK (says (differs.out, "; 1 of 1600 ticks differ"));
    CHECK (says (differs.out, "0 of 2 tests pass"));
}

TEST_CASE ("capture: a test shows what an edit of the graph changes", "[cli][capture]")
{
    const Scratch scratch;
    const auto file = scratch.path ("wood.jsonl");
    captured ({ loggedBoard (scratch), "--record", "motor.force,drag.state", "--test", file });
    const auto graph = scratch.write ("edited.json", textOf (TACTUS_SOURCE_DIR "/graphs/dry_wood.json"));
    CHECK (runTactus ({ "test", file, "--graph", graph }).status == 0);
    replaceIn (graph, "2 N/mm", "3 N/mm");
    const auto ran = runTactus ({ "test", file, "--graph", graph });
    CHECK (ran.status == 1);
    CHECK (says (ran.out, "motor.force.z: first at tick "));
}

TEST_CASE ("capture: a gesture moves the hand as in the run, and a clip holds the port", "[cli][capture]")
{
    const Scratch scratch;
    const auto log = loggedBoard (scratch);
    const auto pen = scratch.path ("pen.csv"), clip = scratch.path ("force.json");
    const auto ran = captured ({ log, "--from", "0.25", "--until", "0.75", "--record", "motor.force.x", "--clip", clip, "--gesture", pen });
    CHECK (says (ran.out, "a clip of 1 channel"));
    CHECK (says (ran.out, "--device stylus=trace:"));

    const auto whole = scratch.path ("whole.csv"), again = scratch.path ("again.csv");
    REQUIRE (runTactus ({ "render", "--replay", log, "--record", "hand.position,motor.force.x", "--out", whole }).status == 0);
    const std::string device = "stylus=trace:" + pen;
    const auto rendered = runTactus ({ "render", TACTUS_SOURCE_DIR "/graphs/dry_wood.json", "--device", device, "--record", "hand.position", "--out", again });
    INFO (rendered.err);
    REQUIRE (rendered.status == 0);
    const auto was = *readTable (std::filesystem::path (whole)), is = *readTable (std::filesystem::path (again));
    REQUIRE (is.rows() == 2000);
    const auto read = readers::readClip (textOf (clip), clip);
    REQUIRE (read);
    const auto& points = read->clip.tracks.at (0).amplitude;
    REQUIRE (points.size() == 2001);
    double most = 1.0;
    for (std::size_t k = 0; k < 2000; ++k)
        most = std::max (most, std::abs (was.at (k + 1000, 4)));
    for (std::size_t k = 0; k < 2000; ++k)
    {
        for (std::size_t i = 1; i <= 3; ++i)
            REQUIRE (is.at (k, i) == was.at (k + 1000, i));
        REQUIRE (points[k].value * most == Approx (was.at (k + 1000, 4)).margin (1e-12));
    }
}

TEST_CASE ("capture: a test of a graph with files finds them from its own folder, and notices that they have changed", "[cli][capture]")
{
    const Scratch scratch;
    std::filesystem::create_directories (scratch.path ("assets"));
    std::filesystem::copy (TACTUS_SOURCE_DIR "/graphs/assets/heartbeat.haptic", scratch.path ("assets/heartbeat.haptic"));
    std::filesystem::create_directories (scratch.path ("logs"));
    const auto graph = scratch.write ("heart.json", textOf (TACTUS_SOURCE_DIR "/graphs/heartbeat.json")), log = scratch.path ("logs/run.jsonl");
    REQUIRE (runTactus ({ "play", graph, "--session", "off", "--osc", "off", "--duration", "0.5", "--log", log }).status == 0);
    const auto file = scratch.path ("heart_test.jsonl");
    captured ({ log, "--test", file });
    CHECK (runTactus ({ "test", file }).status == 0);
    replaceIn (scratch.path ("assets/heartbeat.haptic"), "0.9", "0.8");
    const auto changed = runTactus ({ "test", file });
    CHECK (changed.status == 1);
    CHECK (says (changed.err, "log/asset_changed"));
}

TEST_CASE ("capture: wrong options and files are refused", "[cli][capture]")
{
    const Scratch scratch;
    const auto log = loggedBoard (scratch, "dry_wood", "800"), out = scratch.path ("o.jsonl"), clip = scratch.path ("o.json");
    checkRefused ({ "capture", log }, 2, "--clip, --gesture or --test is required", out);
    checkRefused ({ "capture", log, "--clip", clip }, 2, "--record PORT", clip);
    checkRefused ({ "capture", log, "--from", "0.1", "--until", "0.1", "--test", out }, 2, "--until", out);
    checkRefused ({ "capture", log, "--from", "5", "--test", out }, 1, "take/empty", out);
    checkRefused ({ "capture", log, "--gesture", clip, "--role", "thumb" }, 1, "take/role", clip);
    checkRefused ({ "capture", log, "--record", "none.out", "--test", out }, 1, "none", out);
    checkRefused ({ "capture", TACTUS_SOURCE_DIR "/README.md", "--test", out }, 1, "log/not_a_log", out);
    checkRefused ({ "capture", log, "--test", log }, 1, "output/is_input", out);
    checkRefused ({ "test", log }, 1, "test/not_a_test", out);

    captured ({ log, "--test", out });
    const auto good = textOf (out);
    replaceIn (out, "Dry wood", "Wet wood");
    CHECK (says (runTactus ({ "test", out }).err, "test/graph_changed"));
    const auto newer = scratch.write ("newer.jsonl", good);
    replaceIn (newer, "\"version\":1", "\"version\":2");
    CHECK (says (runTactus ({ "test", newer }).err, "test/newer_version"));
    const auto cut = scratch.write ("cut.jsonl", good.substr (0, good.size() / 3));
    CHECK (runTactus ({ "test", cut }).status == 1);
}
