// SPDX-License-Identifier: MIT
#include "log_table.hpp"
#include "log_number.hpp"
#include "run_log_reader.hpp"

#include <tactus/text/budget.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace tactus
{

namespace
{
/// The unit of a field of a reading.
std::string_view unitOf (std::string_view key)
{
    if (key == "position" || key == "true_position") return "m";
    if (key == "true_velocity") return "m/s";
    if (key == "rotation") return "rad";
    if (key == "pressure" || key == "unrendered_force") return "N";
    if (key == "unrendered_torque") return "N*m";
    return key == "age" ? "s" : "1";
}

/// Columns that grow tick by tick. A new one is 0 up to now.
class Columns
{
public:
    double& at (const std::string& name, std::string_view unit)
    {
        const auto known = numbers.try_emplace (name, now.size());
        if (known.second)
        {
            table.columns.push_back ({ name, std::string (unit), std::vector<double> (rows, 0.0) });
            now.push_back (0.0);
        }
        return now[known.first->second];
    }

    Result<> keep()
    {
        ++rows;
        for (std::size_t i = 0; i < now.size(); ++i)
            table.columns[i].values.push_back (now[i]);
        return checkNumbers (static_cast<double> (rows) * static_cast<double> (now.size()));
    }

    void take (const std::string& role, const Reading& reading)
    {
        const auto logged = toLogged (reading);
        for (const auto& [key, first, size] : reading_fields)
            for (std::size_t k = 0; k < size; ++k)
                at (role + "." + std::string (key) + (size == 1 ? "" : std::string (".") + "xyz"[k]), unitOf (key)) = logged.numbers[first + k];
        for (const auto& [key, value] : channel_fields)
        {
            int i = 0;
            for (const double v : logged.*value)
                at (role + "." + std::string (key) + "." + std::to_string (i++), "") = v;
        }
    }

    NumberTable table;

private:
    std::map<std::string, std::size_t> numbers;
    std::vector<double> now;
    std::size_t rows = 0;
};

Json headJson (const RunHead& head)
{
    return { { "program", head.program }, { "rate_hz", head.rate_hz }, { "sets", head.sets }, { "feeds", head.feeds }, { "clocks", head.clocks } };
}

/// The events of a tick besides readings and feeds.
void note (Json& events, const RunTick& tick)
{
    const auto add = [&] (const char* kind, const std::string& name, Json value) {
        events.push_back ({ { "tick", tick.tick }, { "kind", kind }, { "name", name }, { "value", std::move (value) } });
    };
    if (tick.graph) add ("graph", "", {});
    for (const auto& [role, limits] : tick.tightened)
        add ("tightened", role, {});
    for (const auto& [param, target] : tick.turns)
        add ("turn", param, toLog (target));
    for (const auto& [input, speed] : tick.hits)
        add ("hit", input, toLog (speed));
    for (const auto question : tick.late)
        add ("late", "", question);
    if (tick.halt) add ("halt", "", *tick.halt);
    if (tick.rearm) add ("rearm", "", true);
    if (tick.emergency) add ("emergency", "", true);
    if (tick.last != RunTick::Last::no) add (tick.last == RunTick::Last::end ? "end" : "broken", "", true);
}
}   // namespace

TickRange TickRange::between (double from_s, double until_s, double rate_hz)
{
    constexpr double most = 1e10;   // ticks, the longest run
    const auto tick = [&] (double s) { return static_cast<std::uint64_t> (std::clamp (std::round (s * rate_hz), 0.0, most)); };
    TickRange range { .from = tick (from_s) };
    if (std::isfinite (until_s)) range.until = tick (until_s);
    return range;
}

Result<> checkNumbers (double numbers)
{
    if (numbers <= budgets().numbers) return {};
    return overBudget ("take/too_large", &Budgets::numbers, "the table", numbers, "read a shorter part, or fewer ports");
}

Result<NumberTable> readLogTable (const std::string& log, double from_s, double until_s)
{
    auto reader = RunLogReader::open (log);
    if (! reader) return reader.error();
    const auto rate_hz = reader->head().rate_hz;
    const auto range = TickRange::between (from_s, until_s, rate_hz);
    Columns columns;
    Json events = Json::array();
    std::uint64_t now = 0, last = 0;
    const auto passes = [&] (std::optional<double> seconds) { columns.at ("passed", "s") = seconds.value_or (1.0 / rate_hz); };
    const auto keepUntil = [&] (std::uint64_t tick) -> Result<> {
        if (now < range.from) passes ({});
        for (now = std::max (now, range.from); now < std::min (tick, range.until); ++now)
        {
            if (auto kept = columns.keep(); ! kept) return kept;
            passes ({});
        }
        return {};
    };
    for (;;)
    {
        auto next = reader->next();
        if (! next) return next.error();
        if (! *next) break;
        const auto& tick = **next;
        if (auto kept = keepUntil (tick.tick); ! kept) return kept.error();
        note (events, tick);
        if (tick.last != RunTick::Last::no || tick.tick >= range.until) break;
        passes (tick.passed_s);
        for (const auto& [role, reading] : tick.readings)
            columns.take (role, reading);
        for (std::size_t i = 0; tick.feed && i < tick.feed->size(); ++i)
            columns.at (reader->head().feeds[i], "") = (*tick.feed)[i];
        last = tick.tick;
    }
    if (reader->isCutOff())   // its last line is complete, so is its tick
        if (auto kept = keepUntil (last + 1); ! kept) return kept.error();
    columns.table.first = range.from;
    columns.table.about = { { "head", headJson (reader->head()) }, { "events", std::move (events) }, { "is_cut_off", reader->isCutOff() } };
    return std::move (columns.table);
}

}   // namespace tactus
