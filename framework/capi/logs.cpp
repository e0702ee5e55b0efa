// SPDX-License-Identifier: MIT
// Logs and replays as tables of numbers.
#include "handles.hpp"

#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/run/log/log_table.hpp>
#include <tactus/run/replay.hpp>
#include <tactus/run/turn.hpp>
#include <tactus/text/json.hpp>

#include <iterator>
#include <utility>

using tactus::Message;
using namespace tactus::capi;

struct tactus_table
{
    tactus::NumberTable numbers;
    std::string about;
};

namespace
{
tactus_table* tableOf (tactus::NumberTable numbers)
{
    auto about = numbers.about.dump (2);
    return new tactus_table { std::move (numbers), std::move (about) };
}

tactus_table* refused (tactus_messages* messages, Message why)
{
    failed (messages, std::move (why));
    return nullptr;
}

/// Plays a log to its end, and keeps the recorded values.
tactus::Result<tactus::NumberTable> played (const char* log, tactus::Replay::Options options, double from_s, double until_s, tactus_messages* messages)
{
    auto reader = tactus::RunLogReader::open (log);
    if (! reader) return reader.error();
    const std::string version = " " TACTUS_LIBRARY_VERSION, &by = reader->head().program;
    options.program = by.ends_with (version) ? by : "libtactus" + version;   // the command line and libtactus_live give the same bits
    auto opened = tactus::Replay::open (std::move (*reader), std::move (options));
    if (! opened) return opened.error();
    auto& replay = **opened;
    auto& run = replay.run();
    const auto range = tactus::TickRange::between (from_s, until_s, replay.rate());
    tactus::NumberTable table { .first = range.from };
    for (const auto& tap : run.engine().plan().taps())
        table.columns.push_back ({ tap.name, std::string (tap.unit) });
    std::uint64_t tick = 0;
    for (; tick < range.until; ++tick)
    {
        const auto more = replay.tick();
        add (messages, replay.takeWarnings());
        if (! more) return more.error();
        if (! *more) break;
        if (tick < range.from) continue;
        const auto& taps = run.engine().plan().taps();
        for (std::size_t i = 0; i < table.columns.size(); ++i)
            table.columns[i].values.push_back (*taps[i].value);
        const auto rows = static_cast<double> (tick - range.from + 1);
        if (auto few = tactus::checkNumbers (rows * static_cast<double> (table.columns.size())); ! few) return few.error();
    }
    const auto why = tick < range.until ? replay.end() : std::nullopt;
    if (why && messages != nullptr) messages->list.push_back (*why);
    table.about = { { "name", replay.name() }, { "rate_hz", replay.rate() }, { "ticks", tick }, { "is_cut_off", why.has_value() } };
    return table;
}
}   // namespace

tactus_table* tactus_log_read (const char* log, double from_s, double until_s, tactus_messages* messages)
{
    if (log == nullptr) return nullptr;
    return guarded<tactus_table*> (messages, nullptr, [&] {
        auto read = tactus::readLogTable (log, from_s, until_s);
        return read ? tableOf (std::move (*read)) : refused (messages, std::move (read).error());
    });
}

tactus_table* tactus_replay (const char* log, const tactus_graph* graph, const tactus_run_options* given, double from_s, double until_s,
                             tactus_messages* messages)
{
    if (log == nullptr || ! isSized (given, messages)) return nullptr;
    return guarded<tactus_table*> (messages, nullptr, [&]() -> tactus_table* {
        const auto options = known (given);
        CallerAssets assets { { options.assets, options.asset_context } };
        tactus::Replay::Options how { .records = list (options.records, options.record_count), .assets = &assets };
        how.services.nearest_triangle = tactus::nearestByBoxes;
        if (graph != nullptr) how.graph = &graph->history.graph();
        for (const auto& text : list (options.sets, options.set_count))
        {
            auto read = tactus::readOverride (text);
            if (! read) return refused (messages, std::move (read).error());
            how.overrides.push_back (std::move (*read));
        }
        auto table = played (log, std::move (how), from_s, until_s, messages);
        return table ? tableOf (std::move (*table)) : refused (messages, std::move (table).error());
    });
}

void tactus_table_free (tactus_table* t) { delete t; }
size_t tactus_table_columns (const tactus_table* t) { return t != nullptr ? t->numbers.columns.size() : 0; }
size_t tactus_table_rows (const tactus_table* t) { return tactus_table_columns (t) > 0 ? t->numbers.columns.front().values.size() : 0; }
uint64_t tactus_table_first (const tactus_table* t) { return t != nullptr ? t->numbers.first : 0; }
const char* tactus_table_about (const tactus_table* t) { return t != nullptr ? t->about.c_str() : ""; }
const char* tactus_table_name (const tactus_table* t, size_t i) { return i < tactus_table_columns (t) ? t->numbers.columns[i].name.c_str() : nullptr; }
const char* tactus_table_unit (const tactus_table* t, size_t i) { return i < tactus_table_columns (t) ? t->numbers.columns[i].unit.c_str() : nullptr; }
const double* tactus_table_values (const tactus_table* t, size_t i) { return i < tactus_table_columns (t) ? t->numbers.columns[i].values.data() : nullptr; }
