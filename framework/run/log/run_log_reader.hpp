// SPDX-License-Identifier: MIT
#pragma once

#include "log_lines.hpp"
#include "run_head.hpp"

#include <tactus/node/device.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/message.hpp>
#include <tactus/text/result.hpp>

#include <cstdint>
#include <istream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tactus
{

/// The inputs of a tick, in the order in which they take effect.
struct RunTick
{
    enum class Last
    {
        no,
        end,     ///< the run ended: there is no tick with this number
        broken   ///< writing could not keep up: this tick and later ones are unknown
    };

    std::uint64_t tick = 0;
    int line = 0;                                           ///< line number in the log, from 1
    std::optional<Json> graph {};                           ///< snapshot of the graph that takes over
    std::map<std::string, GuardLimits> guards {};           ///< guards of the new roles in the graph
    std::map<std::string, GuardLimits> tightened {};        ///< what the guards of other roles are tightened to, with the graph
    std::map<std::string, DeviceLayout> devices {};         ///< devices of the new roles, only those with more than a tool
    std::vector<std::string> kept {};                       ///< parameters that keep the values they were turned to, instead of the values in the graph
    std::vector<std::pair<std::string, double>> turns {};   ///< targets by parameter
    std::vector<std::pair<std::string, double>> hits {};    ///< speeds by input
    std::vector<std::uint64_t> late {};                     ///< numbers of the late queries, as for ReplayedQueries::repeat
    std::optional<double> passed_s {};                      ///< time since the last tick, in s; empty: one period
    std::optional<bool> halt {};                            ///< true: from this tick on, all efforts go to zero; false: they rise again
    bool rearm = false;                                     ///< true: clears all latched guard stops; applied before `emergency`
    bool emergency = false;
    std::vector<std::pair<std::string, Reading>> readings {};   ///< by role; other roles keep their last reading
    std::optional<std::vector<double>> feed {};                 ///< empty: the feeds keep their last values
    Last last = Last::no;
};

/// Reads a log line by line, packed or not, so the log may be larger than memory. Accepts any bytes. [main thread]
///
/// Ids: log/not_a_log, log/newer_version, log/unknown_version, log/order, log/missing, log/value, and the JSON ids of a graph
/// file: file/syntax, file/wrong_kind, …
class RunLogReader
{
public:
    static Result<RunLogReader> open (const std::string& path);

    /// `name` appears in error messages. `lines_before` is the number of lines of the file before the stream; line numbers in messages include them.
    static Result<RunLogReader> open (std::unique_ptr<std::istream>, std::string name, int lines_before = 0);

    const RunHead& head() const noexcept { return begin; }

    /// The next tick with new inputs; empty after the last one. If another graph replaced the first one before any tick, tick 0
    /// appears twice.
    Result<std::optional<RunTick>> next();

    /// True if the last line was incomplete, or if no line was marked as the last: the program died. Valid after next() has
    /// returned an empty value.
    bool isCutOff() const noexcept { return cut_off; }

    const std::string& name() const noexcept { return called; }

    /// The file and this line in it, as in "run.jsonl:7".
    std::string placeOf (int line_number) const;

private:
    RunLogReader() = default;

    std::optional<std::string> line();
    Result<> readHead();
    Result<RunTick> readTick (const std::string& text);
    Result<> place (RunTick&, std::optional<std::uint64_t> number);
    Message at (std::string id, std::string what, std::string remedy) const;

    LogLines in;
    std::string called;
    RunHead begin;
    std::map<std::string, LoggedReading, std::less<>> readings;
    std::optional<std::uint64_t> before;   // tick of the previous line
    int number = 0;                        // line number
    bool over = false, cut_off = false;
};

}   // namespace tactus
