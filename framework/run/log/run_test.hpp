// SPDX-License-Identifier: MIT
#pragma once

#include "stretch.hpp"

#include <cstdint>
#include <filesystem>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace tactus
{

inline constexpr std::string_view run_test_format = "tactus-test";
inline constexpr int run_test_version = 1;

/// The first line of a test of a run; docs/replay.md describes the format.
struct RunTestHead
{
    std::string program;                   ///< the program that wrote it, and its version
    std::string graph;                     ///< snapshotHash of the first graph
    std::vector<std::string> records {};   ///< ports, as in CompileOptions::records
    std::vector<std::string> ports {};     ///< names of the components that are compared
    std::uint64_t from = 0, until = 0;     ///< ticks that are compared
};

/// Writes a test: the expected values in a stretch of a run, and the log of the run up to the end of the stretch. `records` are the
/// ports of the stretch. Paths of files that nodes use are relative to the test. Ids: test/no_ports, file/unreadable, output/unwritable, and
/// those of RunLogReader. [main thread]
Result<> writeRunTest (const std::string& log, const std::filesystem::path& test, const Stretch&, const std::vector<std::string>& records,
                       const std::string& program);

/// Copies the log of a run, and returns the tick of its last line, which is the length of a run that ended. Paths of files that nodes use are relative
/// to the copy. Ids: file/unreadable, output/unwritable, and those of RunLogReader. [main thread]
Result<std::uint64_t> copyRunLog (const std::string& log, const std::filesystem::path& to);

/// Reads the first line. Ids: test/not_a_test, test/newer_version, test/unknown_version, test/value.
Result<RunTestHead> readRunTestHead (std::istream&, const std::string& name);

/// Reads the expected values, tick by tick. Ids: test/value, test/too_large, test/cut_off.
Result<std::vector<double>> readExpected (std::istream&, const RunTestHead&, const std::string& name);

/// A component whose values differ from the expected ones.
struct RunDifference
{
    std::string port;
    std::uint64_t tick = 0;               ///< the first one that differs
    double expected = 0.0, found = 0.0;   ///< at that tick
    std::uint64_t ticks = 0;              ///< number of ticks that differ
};

struct RunTestResult
{
    std::string graph;   ///< its name
    std::uint64_t ticks = 0;
    double rate_hz = 0.0;
    std::size_t ports = 0;
    std::vector<RunDifference> differences {};   ///< in the order of their first ticks
    std::optional<std::uint64_t> ended {};       ///< the tick at which the run ended, if that was too early
    Messages warnings {};

    bool isSame() const noexcept { return differences.empty() && ! ended; }
};

struct RunTestOptions
{
    const graph::Graph* graph = nullptr;   ///< tested instead of the graph in the test
    Assets* assets = nullptr;
    Services services {};
    std::string program {};
};

/// Replays the run of a test and compares the bits. All NaNs count as equal. Ids: those of Replay, readRunTestHead and readExpected,
/// test/graph_changed, test/ports. [main thread]
Result<RunTestResult> playRunTest (const std::string& test, const RunTestOptions&);

}   // namespace tactus
