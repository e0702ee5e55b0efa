// SPDX-License-Identifier: MIT
#pragma once

#include "whole_error.hpp"

#include <tactus/run/log/graph_snapshot.hpp>
#include <tactus/run/log/run_log_reader.hpp>

#include <cstdlib>
#include <memory>
#include <sstream>
#include <string>

namespace tactus::fuzz
{

/// Reads the text as a run log. Either its ticks rise from 0, or reading reports an error with its location; the same applies to
/// the graphs in the log. Aborts otherwise.
inline void tryRunLog (std::string_view text)
{
    auto log = RunLogReader::open (std::make_unique<std::istringstream> (std::string (text)), "fuzz.jsonl");
    if (! log) return checkWhole (log.error());

    for (std::uint64_t k = 0;; ++k)
    {
        const auto line = log->next();
        if (! line) return checkWhole (line.error());
        if (! *line) return;
        const RunTick& tick = **line;
        if (tick.tick < k || (tick.feed && tick.feed->size() != log->head().feeds.size())) std::abort();
        k = tick.tick;
        if (! tick.graph) continue;
        const auto graph = readSnapshot (*tick.graph, ".");
        if (! graph && (graph.error().id.empty() || graph.error().text.empty() || graph.error().remedy.empty())) std::abort();
    }
}

}   // namespace tactus::fuzz
