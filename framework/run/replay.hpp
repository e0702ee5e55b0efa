// SPDX-License-Identifier: MIT
#pragma once

#include "log/run_log_reader.hpp"
#include "run.hpp"
#include <tactus/run/log/replayed_queries.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tactus
{

/// Repeats a run from its log: no device moves, all inputs come from the log, and the same engine reproduces the run bit for
/// bit. It can also play a different graph; then everything in the log that still fits is applied to it, and the results may
/// differ. [main thread]
class Replay
{
public:
    /// The longest run, in ticks, that a log may request: seven hours at 4 kHz. A duration that the user gives may be longer.
    static constexpr std::uint64_t most_ticks_unasked = 100'000'000;

    struct Options
    {
        const graph::Graph* graph = nullptr;        ///< played instead of the graph in the log; must outlive the replay
        std::vector<std::string> records {};        ///< as in CompileOptions::records
        std::vector<plan::Override> overrides {};   ///< in addition to the overrides in the log
        Assets* assets = nullptr;
        Services services {};      ///< not used for answers to async queries, which come from the log
        double duration_s = 0.0;   ///< 0: the whole log, which must not be longer than most_ticks_unasked
        std::string program {};    ///< this program and its version, as in RunHead
    };

    /// Ids: those of RunLogReader and compile(), log/empty, log/too_long, log/graph, log/asset_missing, log/asset_changed.
    static Result<std::unique_ptr<Replay>> open (const std::string& log, Options);
    static Result<std::unique_ptr<Replay>> open (RunLogReader, Options);   ///< from an open log; no tick of it has been read yet

    Run& run() noexcept { return *running; }
    double rate() const noexcept { return log.head().rate_hz; }     ///< Hz
    const graph::Graph& graph() const noexcept { return played; }   ///< what is played now
    const std::string& name() const noexcept { return played.name; }

    /// Runs one tick. Returns false at the end of the log, after duration_s, or where the recorded run began to halt.
    Result<bool> tick();

    /// Warnings that have not been returned yet. Ids: log/other_program, log/other_functions, log/no_role, log/not_turned,
    /// log/not_struck.
    Messages takeWarnings() { return std::exchange (warnings, {}); }

    /// Call it after the last tick. Returns why the log ends before the end of the run, if it does. Ids: log/broken,
    /// log/cut_off.
    std::optional<Message> end() const;

private:
    /// Plays back the readings of a role.
    struct Hand final : public Device
    {
        void prepare (double) override {}
        Reading read() noexcept override { return reading; }
        void write (const Effort&) noexcept override {}
        DeviceLayout layout() const override { return has; }

        Reading reading;
        DeviceLayout has;
    };

    struct FeedValues final : public RunListener
    {
        void before (Plan&, std::uint64_t) noexcept override;
        std::vector<double> values;
    };

    Replay (RunLogReader, Options);

    Result<> begin();
    Result<> fetch();
    Result<graph::Graph> loggedGraph() const;
    Run::RoleDevice openHand (const std::string& role);
    Result<> carryOut();
    Result<> swapPlan();
    Result<> turn (const std::string& param, double target);
    Result<> strike (const std::string& input, double speed);
    Message here (const Message&) const;

    RunLogReader log;
    Options options;
    ReplayedQueries queries;   // must precede the run, whose nodes use it
    FeedValues feed;
    std::map<std::string, Hand*> hands;
    std::unique_ptr<Run> running;
    graph::Graph played;
    Messages warnings;

    std::optional<RunTick> next;   // the next inputs; empty at the end of the log
    std::optional<std::uint64_t> broken_at;
    std::uint64_t now = 0;
    bool has_begun = false, has_first = false;   // has_begun: the run is set up; has_first: the first graph of the log was reached
    std::optional<std::uint64_t> most;           // number of ticks in duration_s; empty: no limit
    std::set<std::string> not_there;             // parameters and inputs that the played graph does not have
};

}   // namespace tactus
