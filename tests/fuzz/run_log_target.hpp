// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "whole_error.hpp"

#include <host/runlog/graph_snapshot.hpp>
#include <host/runlog/run_log_reader.hpp>

#include <cstdlib>
#include <memory>
#include <sstream>
#include <string>

namespace tactus::fuzz
{

/// A text is a log whose ticks rise from 0, or an error with a place; so are the graphs in it. Aborts if not.
inline void tryRunLog (std::string_view text)
{
    auto log = host::RunLogReader::open (std::make_unique<std::istringstream> (std::string (text)), "fuzz.jsonl");
    if (! log) return checkWhole (log.error());

    for (std::uint64_t k = 0;; ++k)
    {
        const auto line = log->next();
        if (! line) return checkWhole (line.error());
        if (! *line) return;
        const host::RunTick& tick = **line;
        if (tick.tick < k || (tick.feed && tick.feed->size() != log->head().feeds.size())) std::abort();
        k = tick.tick;
        if (! tick.graph) continue;
        const auto graph = host::readSnapshot (*tick.graph, ".");
        if (const auto* m = std::get_if<Message> (&graph); m && (m->id.empty() || m->text.empty() || m->remedy.empty())) std::abort();
    }
}

}   // namespace tactus::fuzz
