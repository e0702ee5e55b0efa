// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "session.hpp"

#include <framework/repeated_answers.hpp>
#include <host/runlog/run_log_reader.hpp>

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tactus::host
{

/// A run again, from its log: no device moves, what came in comes from the log, and the same engine gives the same bits.
/// With a graph of its own, this graph all the time, on which all that still fits it is done; nothing is promised then.
class Replay
{
public:
    /// Says what is wrong on stderr and throws Stop if something is, as tick() does.
    Replay (const SessionOptions&, const std::string& log);

    Engine& engine() noexcept { return *running; }
    double rate() const noexcept { return log.head().rate_hz; }   ///< Hz
    const std::string& name() const noexcept { return name_of_graph; }

    /// One sample; false if the run was over, and there is none. It is over when the forces were brought to zero.
    bool tick();

    /// Says on stderr if the log ends before the run did.
    void reportEnd() const;

private:
    /// A role's hand, as it was.
    struct Hand final : public Device
    {
        void prepare (double) override {}
        Reading read() noexcept override { return reading; }
        void write (const Effort&) noexcept override {}
        DeviceLayout layout() const override { return has; }

        Reading reading;
        DeviceLayout has;
    };

    std::shared_ptr<Plan> compileNow (const graph::Graph&, const Plan* before);
    std::shared_ptr<Plan> compileOwn();
    std::shared_ptr<Plan> compileLogged (const Plan* before);
    void takeOver();
    void bindHands();
    void fetch();
    void carryOut();
    void turn (const std::string& param, double target);
    void strike (const std::string& input, double speed);
    [[noreturn]] void failHere (const Message&) const;

    SessionOptions told;
    RunLogReader log;
    FileAssets assets;
    RepeatedAnswers answers;   // before the engine, whose nodes ask it
    std::map<std::string, Hand> hands;
    std::unique_ptr<Engine> running;
    std::string name_of_graph;
    std::vector<std::string> records;
    std::vector<double> feed;

    std::optional<RunTick> next;   // what is to come in; nothing once the log is over
    std::optional<std::uint64_t> broken_at;
    std::uint64_t now = 0;
    bool has_first = false;              // the graph of tick 0
    std::optional<std::uint64_t> most;   // ticks
    std::set<std::string> not_turned;
};

}   // namespace tactus::host
