// SPDX-License-Identifier: MIT
#pragma once

#include "log_lines.hpp"
#include "run_head.hpp"
#include "run_journal.hpp"

#include <tactus/text/json.hpp>
#include <tactus/text/result.hpp>

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace tactus
{

/// Writes a log during a run, so that the run can be repeated bit for bit; docs/replay.md describes the format. The file is
/// written in place, one line per tick, so everything drained before a crash is in the file. The first line waits for the first tick, whose
/// time it tells. [main thread, except journal()]
class RunLog
{
public:
    /// Replaces any file with this name, but a packed log, whose name ends in packed_log, is never replaced. The buffer holds one second of data for the
    /// roles and feeds listed in the RunHead. Ids: output/unwritable, output/exists.
    static Result<std::unique_ptr<RunLog>> create (const std::filesystem::path&, const RunHead&);

    /// Receives the events of the tick thread.
    Journal& journal() noexcept { return taken; }

    /// The base of relative paths in the log.
    const std::filesystem::path& folder() const noexcept { return place; }

    /// Call it before a plan is submitted, with the plan, the snapshot of its graph, and the guards and devices of new roles.
    void expect (std::shared_ptr<const Plan>, const Json& snapshot, const std::map<std::string, GuardLimits>& joining = {},
                 const std::map<std::string, DeviceLayout>& devices = {});

    /// Sets a function that returns, as JSON, when the first tick began, or nothing if the run is not in real time. It is called once, after that tick.
    void beginsAt (std::function<std::optional<Json>()> f) { first_tick = std::move (f); }

    /// Writes what the tick thread has recorded. Call it many times a second, and once more after the last tick. If writing fails, the log ends
    /// after the last complete line, and nothing more is written.
    Result<> drain();

    /// Marks the end of the run. Ids: output/unwritable.
    Result<> finish();

    /// The first tick at which the log could not keep up. The log ends there.
    std::optional<std::uint64_t> brokenAt() const noexcept { return taken.brokenAt(); }

private:
    struct Expected
    {
        std::shared_ptr<const Plan> plan;
        std::string graph;
    };

    RunLog (const std::filesystem::path&, const RunHead&);

    void take();
    void takeOver (std::uint64_t serial);
    void takeTick (std::size_t roles, std::size_t feeds);
    LoggedReading takeReading();
    void takeTightened (std::size_t role);
    void add (std::string_view key, std::string_view value);
    void endLine();
    void beginFile (const std::optional<Json>& clocks);
    static Result<> written (bool good, const std::filesystem::path&);

    std::filesystem::path path, place;
    RunHead head;
    std::unique_ptr<std::ostream> out;   // null once the log is closed
    std::unique_ptr<LogPacker> packer;   // null: the log is text
    bool has_begun = false;              // the first line is written
    std::string held;                    // lines of graphs that take over before that
    std::uintmax_t whole = 0;            // bytes known to be in the file, up to the end of a line
    RunJournal taken;

    std::deque<Expected> expected;               // the running plan, and submitted plans that may replace it
    std::string graph;                           // the last graph written
    std::map<std::string, GuardLimits> joined;   // guards of roles that have joined or may join, until they are written
    std::map<std::string, DeviceLayout> joined_devices;
    std::map<std::string, LoggedReading> readings;
    std::vector<double> feed;
    std::function<std::optional<Json>()> first_tick;
    std::uint64_t now = 0;   // tick number

    // Parts of the line for this tick.
    LogLine line;
    std::map<std::string, GuardLimits> tightened;
    std::string turns, kept, hits;
    std::string late;
};

}   // namespace tactus
