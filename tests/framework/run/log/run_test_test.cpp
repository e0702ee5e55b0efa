// SPDX-License-Identifier: MIT
// A test of a run passes with the same graph, and finds every bit that differs.
#include "support/corpus.hpp"
#include "support/temporary_folder.hpp"

#include <fuzz/run_test_target.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/log/run_test.hpp>
#include <tactus/run/run.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>

using namespace tactus;
namespace fs = std::filesystem;

namespace
{
constexpr int logged_ticks = 300;

/// Logs a run of a preset, without a clock.
std::string logOf (const fs::path& folder)
{
    const auto graph = loadGraph (TACTUS_SOURCE_DIR "/graphs/dry_wood.json").graph;
    Run run { catalogue(), {}, [] (const std::string& role, const graph::Graph& g, const Plan&, Messages&) {
                 auto made = makeDevice (*g.device (role), g.folder);
                 return Run::RoleDevice { std::move (made.device), made.limits };
             } };
    REQUIRE (! hasErrors (run.load (graph)));
    Messages messages;
    run.openDevices (graph, messages);
    const auto log = (folder / "run.jsonl").string();
    REQUIRE (run.startLog (log, "test", {}, graph));
    for (int k = 0; k < logged_ticks; ++k)
    {
        run.tick();
        if (k % 50 == 0) run.poll();
    }
    REQUIRE (run.finish());
    return log;
}

std::vector<std::string> linesIn (const fs::path& file)
{
    std::ifstream in (file, std::ios::binary);
    std::vector<std::string> lines;
    for (std::string line; std::getline (in, line);)
        lines.push_back (line);
    return lines;
}

void writeLines (const fs::path& file, const std::vector<std::string>& lines)
{
    std::ofstream out (file, std::ios::binary);
    for (const auto& line : lines)
        out << line << '\n';
}
}   // namespace

TEST_CASE ("a test of any stretch of a run passes, and one changed bit is found at its tick and port", "[runlog][run_test]")
{
    const TemporaryFolder folder;
    const auto log = logOf (folder.path());
    CHECK (rc::check ([&] {
        const auto from = *rc::gen::inRange (0, logged_ticks - 1);
        const auto until = *rc::gen::inRange (from + 1, logged_ticks + 1);
        Messages warnings;
        const auto stretch = readStretch (log, { .from_s = from / 4000.0, .until_s = until / 4000.0, .program = "test" }, warnings);
        RC_ASSERT (stretch.has_value());
        RC_ASSERT (warnings.empty());
        RC_ASSERT (stretch->from == static_cast<std::uint64_t> (from));
        RC_ASSERT (stretch->until == static_cast<std::uint64_t> (until));
        const auto file = folder / "test.jsonl";
        RC_ASSERT (writeRunTest (log, file, *stretch, {}, "test").has_value());
        const auto same = playRunTest (file.string(), { .program = "test" });
        RC_ASSERT (same.has_value());
        RC_ASSERT (same->isSame());
        RC_ASSERT (same->ticks == static_cast<std::uint64_t> (until - from));

        auto changed = *stretch;
        const auto place = *rc::gen::inRange<std::size_t> (0, changed.values.size());
        auto& value = changed.values[place];
        value = std::bit_cast<double> (std::bit_cast<std::uint64_t> (value) ^ 1u);
        RC_ASSERT (writeRunTest (log, file, changed, {}, "test").has_value());
        const auto other = playRunTest (file.string(), { .program = "test" });
        RC_ASSERT (other.has_value());
        RC_ASSERT (other->differences.size() == std::size_t { 1 });
        const auto& d = other->differences.front();
        RC_ASSERT (d.tick == static_cast<std::uint64_t> (from) + place / changed.names.size());
        RC_ASSERT (d.port == changed.names[place % changed.names.size()]);
        RC_ASSERT (d.ticks == std::uint64_t { 1 });
    }));
}

TEST_CASE ("a test whose graph was edited by hand, or that is cut off, is refused", "[runlog][run_test]")
{
    const TemporaryFolder folder;
    const auto log = logOf (folder.path());
    Messages warnings;
    const auto stretch = readStretch (log, { .until_s = 0.01, .program = "test" }, warnings);
    REQUIRE (stretch);
    const auto file = folder / "test.jsonl";
    REQUIRE (writeRunTest (log, file, *stretch, {}, "test"));
    const auto lines = linesIn (file);
    REQUIRE (lines.size() > 42);   // a head, 40 ticks, and the log

    auto edited = lines;
    auto& graph = edited[42];
    const auto at = graph.find ("Dry wood");
    REQUIRE (at != std::string::npos);
    graph.replace (at, 3, "Wet");
    writeLines (file, edited);
    CHECK (playRunTest (file.string(), { .program = "test" }).error().id == "test/graph_changed");

    for (const std::size_t kept : { std::size_t { 1 }, std::size_t { 20 }, std::size_t { 41 }, std::size_t { 42 } })
    {
        INFO (kept);
        writeLines (file, { lines.begin(), lines.begin() + static_cast<std::ptrdiff_t> (kept) });
        CHECK (! playRunTest (file.string(), { .program = "test" }));
    }
    writeLines (file, lines);
    CHECK (playRunTest (file.string(), { .program = "test" }));
}

TEST_CASE ("a stretch after the end of the run is refused, and one that reaches beyond it ends with it", "[runlog][run_test]")
{
    const TemporaryFolder folder;
    const auto log = logOf (folder.path());
    Messages warnings;
    CHECK (readStretch (log, { .from_s = 1.0, .program = "test" }, warnings).error().id == "take/empty");
    CHECK (readStretch (log, { .from_s = 0.01, .until_s = 0.01, .program = "test" }, warnings).error().id == "take/empty");
    CHECK (readStretch (log, { .role = "thumb", .program = "test" }, warnings).error().id == "take/role");
    const auto rest = readStretch (log, { .from_s = 0.05, .until_s = 9.0, .role = "stylus", .program = "test" }, warnings);
    REQUIRE (rest);
    CHECK (rest->until == logged_ticks);
    CHECK (rest->movement.size() == rest->ticks() * rest->columns.size());
}

TEST_CASE ("a test that would compare no port is refused", "[runlog][run_test]")
{
    const TemporaryFolder folder;
    const auto written = writeRunTest (logOf (folder.path()), folder / "none.jsonl", { .from = 0, .until = 10 }, {}, "test");
    REQUIRE (! written);
    CHECK (written.error().id == "test/no_ports");
    CHECK (! fs::exists (folder / "none.jsonl"));
}

TEST_CASE ("every file of the corpus of tests of runs is read or refused", "[runlog][run_test]") { CHECK (test::replay ("run_test", fuzz::tryRunTest) > 10); }
