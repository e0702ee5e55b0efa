// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "reading_fields.hpp"
#include "run_head.hpp"
#include "run_journal.hpp"

#include <framework/json.hpp>
#include <host/io/error.hpp>

#include <tl/expected.hpp>

#include <cstdint>
#include <deque>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// Writes down a run as it goes on, so that it can be repeated to the bit; docs/replay.md says how a log looks. The file is
/// written in place, a line a tick: what had been drained when a program dies is there. [main thread, but for journal()]
class RunLog
{
public:
    /// Replaces a file of this name. There is room for so many roles and feeds as the head has, for a second.
    /// Ids: output/unwritable.
    static tl::expected<std::unique_ptr<RunLog>, Error> create (const std::filesystem::path&, const RunHead&);

    /// To be told what happens on the tick thread.
    Journal& journal() noexcept { return taken; }

    /// Where relative paths in the log start.
    const std::filesystem::path& folder() const noexcept { return place; }

    /// This plan, made of the graph of this snapshot, may tick from now on, with the guards and devices of roles that are new:
    /// to be said before it is submitted.
    void expect (std::shared_ptr<const Plan>, const Json& snapshot, const std::map<std::string, GuardLimits>& joining = {}, const std::map<std::string, DeviceLayout>& devices = {});

    /// Writes what has come in. To be called many times a second, and to the last after the ticks. Where that fails the log
    /// ends, after the last line that was whole, and nothing more is written.
    tl::expected<void, Error> drain();

    /// The end of the run. Ids: output/unwritable.
    tl::expected<void, Error> finish();

    /// The tick from which on the log could not keep up; it ends there.
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
    void add (std::string_view key, std::string_view value);
    void endLine();
    tl::expected<void, Error> written();

    std::filesystem::path path, place;
    std::ofstream out;
    std::uintmax_t whole = 0;   // bytes that are known to be in the file, and end a line
    RunJournal taken;

    std::deque<Expected> expected;               // the plan that ticks, and those that may come
    std::string graph;                           // as it was last written
    std::map<std::string, GuardLimits> joined;   // since, or to come
    std::map<std::string, DeviceLayout> joined_devices;
    std::map<std::string, LoggedReading> readings;
    std::vector<double> feed;
    std::uint64_t now = 0;   // tick

    // Of the line for this tick.
    std::string line;
    std::string turns, kept, hits;
    std::string late;
};

}   // namespace tactus::host
