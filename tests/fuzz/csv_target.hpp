// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/devices/trace.hpp>
#include <host/io/csv.hpp>

#include <cstdlib>

namespace tactus::fuzz
{

/// A text is a table whose rows are all as wide as its header, or an error with a place. A table that is a trace has
/// times that rise from 0. Aborts if not.
inline void tryCsv (std::string_view text)
{
    const auto table = host::readTable (text, "fuzz.csv");
    if (! table)
    {
        const auto& e = table.error();
        if (e.id.empty() || e.where.empty() || e.what.empty() || e.remedy.empty()) std::abort();
        return;
    }
    if (table->columns.empty() || table->values.size() != table->rows() * table->columns.size()) std::abort();

    const auto trace = host::readTrace (table->columns, table->values);
    if (hasErrors (trace.messages)) return;
    double before = 0.0;
    for (const auto& row : trace.trace.rows)
    {
        if (! (row.t >= before)) std::abort();
        before = row.t;
    }
}

}   // namespace tactus::fuzz
