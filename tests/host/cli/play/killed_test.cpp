// SPDX-License-Identifier: GPL-3.0-or-later
// What `kill -9` leaves of a recording, a log and a temporary file, as docs/safety.md claims.

#include "host/cli/running.hpp"

#include <host/base/files/wav.hpp>
#include <tactus/file/csv.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <string>

using namespace tactus;
using test::Running;
using test::runTactus;
using test::Scratch;
using test::soon;
using test::textOf;

namespace
{
constexpr double rate_hz = 500.0;

/// A graph that counts its ticks. Its device moves, so that a log has something to write on each tick.
const std::string counter = R"({ "format": "tactus-graph", "version": 1, "rate_hz": 500,
  "devices": { "tip": { "driver": "gesture", "path": "circle" } },
  "nodes": { "one": { "type": "signal.constant", "params": { "value": 1 } }, "count": { "type": "signal.add" },
    "hand": { "type": "device.position", "role": "tip" }, "motor": { "type": "device.force", "role": "tip" } },
  "wires": [ "one.out -> count.in[0]", "count.out -> [1] -> count.in[1]" ] })";

std::size_t linesIn (const std::string& file) { return static_cast<std::size_t> (std::ranges::count (textOf (file), '\n')); }

std::size_t framesIn (const std::string& file)
{
    const auto wave = host::readWav (file);
    return wave ? wave->channels.at (0).size() : 0;
}

/// The number of rows, after a check that row k holds tick k.
std::size_t countedRows (const std::string& file)
{
    const auto table = readTable (std::filesystem::path (file));
    INFO ((table ? "" : describe (table.error())));
    REQUIRE (table.has_value());
    std::size_t wrong = 0;
    for (std::size_t k = 0; k < table->rows(); ++k)
        wrong += table->at (k, 0) != static_cast<double> (k) / rate_hz || table->at (k, 1) != static_cast<double> (k + 1);
    CHECK (wrong == 0);
    return table->rows();
}

/// The number of frames, after a check that frame k holds tick k.
std::size_t countedFrames (const std::string& file)
{
    const auto wave = host::readWav (file);
    INFO ((wave ? "" : describe (wave.error())));
    REQUIRE (wave.has_value());
    std::size_t wrong = 0, k = 0;
    for (const double value : wave->channels.at (0))
        wrong += value != static_cast<double> (++k);
    CHECK (wrong == 0);
    return k;
}
}   // namespace

TEST_CASE ("a recording and a log survive kill -9 up to their last second, and the next run neither overwrites nor hides them", "[cli][safety]")
{
    const Scratch scratch;
    const auto graph = scratch.write ("g.json", counter);
    const auto csv = scratch.path ("run.csv"), wav = scratch.path ("run.wav"), log = scratch.path ("run.jsonl");
    const auto left_csv = scratch.path ("run.partial.csv"), left_wav = scratch.path ("run.partial.wav");
    const std::vector<std::string> play { "play", graph, "--osc", "off", "--record", "count.out", "--out", csv, "--out", wav };
    {
        auto arguments = play;
        arguments.insert (arguments.end(), { "--log", log, "--duration", "600" });
        Running killed { arguments };
        REQUIRE (soon ([&] { return linesIn (left_csv) > 600 && framesIn (left_wav) > 600; }));
        killed.signal (SIGKILL);
        CHECK (killed.finish().status == -SIGKILL);
    }
    CHECK_FALSE (std::filesystem::exists (csv));
    CHECK_FALSE (std::filesystem::exists (wav));
    const auto rows = countedRows (left_csv), frames = countedFrames (left_wav);
    CHECK (rows >= 600);
    CHECK (frames > 600);

    const auto replayed = runTactus ({ "render", "--replay", log, "--record", "count.out", "--out", scratch.path ("again.csv") });
    INFO (replayed.err);
    CHECK (replayed.status == 0);
    CHECK (replayed.err.find ("[log/cut_off]") != std::string::npos);
    const auto logged = countedRows (scratch.path ("again.csv"));   // the log is written every 20 ms
    CAPTURE (rows, frames, logged);
    const auto most_lost = static_cast<std::size_t> (2.0 * rate_hz);   // a second, and another one because the machine may be busy
    CHECK (rows + most_lost >= logged);
    CHECK (frames + most_lost >= logged);

    const auto kept_csv = textOf (left_csv), kept_wav = textOf (left_wav);
    auto arguments = play;
    arguments.insert (arguments.end(), { "--ticks", "50" });
    const auto next = runTactus (arguments);
    INFO (next.err);
    CHECK (next.status == 0);
    for (const auto& left : { left_csv, left_wav })
        CHECK (test::withSlashes (next.err).find ("note: " + left + " is what an earlier run recorded") != std::string::npos);
    CHECK (textOf (left_csv) == kept_csv);
    CHECK ((textOf (left_wav) == kept_wav));
    CHECK (countedRows (csv) == 50);
    CHECK (countedFrames (wav) == 50);
    CHECK_FALSE (std::filesystem::exists (scratch.path ("run.partial-2.csv")));
}

TEST_CASE ("the recording of a run that is still going is not reported as left over, and a second run records next to it", "[cli][safety]")
{
    const Scratch scratch;
    const auto graph = scratch.write ("g.json", counter);
    const std::vector<std::string> play { "play", graph, "--osc", "off", "--record", "count.out", "--out", scratch.path ("run.csv") };
    auto longer = play, shorter = play;
    longer.insert (longer.end(), { "--duration", "600" });
    shorter.insert (shorter.end(), { "--ticks", "50" });
    Running first { longer };
    REQUIRE (first.says ("Ctrl-C stops"));
    const auto second = runTactus (shorter);
    INFO (second.err);
    CHECK (second.status == 0);
    CHECK (second.err.find ("is what an earlier run recorded") == std::string::npos);
    CHECK (countedRows (scratch.path ("run.csv")) == 50);
    CHECK (std::filesystem::exists (scratch.path ("run.partial.csv")));
    CHECK (first.stop().status == 0);
    CHECK (countedRows (scratch.path ("run.csv")) > 0);
    CHECK_FALSE (std::filesystem::exists (scratch.path ("run.partial.csv")));
}

TEST_CASE ("the temporary file of a killed render is removed by the next one", "[cli][safety]")
{
    const Scratch scratch;
    const auto graph = scratch.write ("g.json", counter);
    const std::string folder = std::filesystem::path (graph).parent_path();
    const auto temporary = [&] {
        return std::ranges::count_if (std::filesystem::directory_iterator (folder), [] (const auto& entry) { return entry.path().extension() == ".tmp"; });
    };
    {
        Running killed { { "render", graph, "--duration", "100000", "--record", "count.out", "--out", scratch.path ("killed.csv") } };
        REQUIRE (soon ([&] { return temporary() == 1; }));
        killed.signal (SIGKILL);
        CHECK (killed.finish().status == -SIGKILL);
    }
    CHECK (temporary() == 1);
    CHECK (runTactus ({ "render", graph, "--duration", "0.1", "--record", "count.out", "--out", scratch.path ("next.csv") }).status == 0);
    CHECK (temporary() == 0);
    CHECK (countedRows (scratch.path ("next.csv")) == 50);
    CHECK_FALSE (std::filesystem::exists (scratch.path ("killed.csv")));
}
