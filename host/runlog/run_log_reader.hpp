// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "reading_fields.hpp"
#include "run_head.hpp"

#include <framework/device.hpp>
#include <framework/json.hpp>
#include <framework/message.hpp>
#include <host/io/error.hpp>

#include <tl/expected.hpp>

#include <cstdint>
#include <istream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

/// What came in on a tick, in the order in which it took effect.
struct RunTick
{
    enum class Last
    {
        no,
        end,     ///< the run was over: there is no tick of this number
        broken   ///< writing could not keep up: of this tick and those after it nothing is known
    };

    std::uint64_t tick = 0;
    int line = 0;                                           ///< of the log, from 1
    std::optional<Json> graph {};                           ///< snapshot of the one that took over
    std::map<std::string, GuardLimits> guards {};           ///< of roles that it has first
    std::map<std::string, DeviceLayout> devices {};         ///< the same, of those that have more than a tool
    std::vector<std::string> kept {};                       ///< parameters that stay where they were turned, whatever it has
    std::vector<std::pair<std::string, double>> turns {};   ///< targets by parameter
    std::vector<std::pair<std::string, double>> hits {};    ///< speeds by input
    std::vector<std::uint64_t> late {};                     ///< as RepeatedAnswers takes them
    std::optional<bool> halt {};                            ///< from this tick on all efforts are brought to zero, or rise again
    bool rearm = false;                                     ///< what has stopped a guard for good ends; before an emergency stop
    bool emergency = false;
    std::vector<std::pair<std::string, Reading>> readings {};   ///< by role; of the others as before
    std::optional<std::vector<double>> feed {};                 ///< as before, if there is none
    Last last = Last::no;
};

/// Reads a log line by line, so that it may be longer than the memory. Text may be anything. [main thread]
///
/// Ids: log/not_a_log, log/newer_version, log/unknown_version, log/order, log/missing, log/value, and those of JSON as of
/// a graph file: file/syntax, file/wrong_kind, …
class RunLogReader
{
public:
    static tl::expected<RunLogReader, Error> open (const std::string& path);

    /// `name` is what errors call it.
    static tl::expected<RunLogReader, Error> open (std::unique_ptr<std::istream>, std::string name);

    const RunHead& head() const noexcept { return begin; }

    /// The next tick on which something came in that was not there before; nothing after the last. A graph that took over
    /// from the first before any tick comes as tick 0 once more.
    tl::expected<std::optional<RunTick>, Error> next();

    /// True if the last line was not whole, or no line said that it is the last: the program died. Once next() gave nothing.
    bool isCutOff() const noexcept { return cut_off; }

    const std::string& name() const noexcept { return called; }

    /// "run.jsonl:7"
    std::string placeOf (int line_number) const;

private:
    RunLogReader() = default;

    std::optional<std::string> line();
    tl::expected<void, Error> readHead();
    tl::expected<RunTick, Error> readTick (const std::string& text);
    Error at (std::string id, std::string what, std::string remedy) const;

    std::unique_ptr<std::istream> in;
    std::string called;
    RunHead begin;
    std::map<std::string, LoggedReading, std::less<>> readings;
    std::optional<std::uint64_t> before;   // tick of the line before
    int number = 0;                        // of the line
    bool over = false, cut_off = false;
};

}   // namespace tactus::host
