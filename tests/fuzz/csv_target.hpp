// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/file/csv.hpp>
#include <tactus/run/device/trace.hpp>

#include <cstdlib>

namespace tactus::fuzz
{

/// Reads the text as a table. Either all rows are as wide as the header, or reading reports an error with its location. If the
/// table is a trace, its times rise from 0. Aborts otherwise.
inline void tryCsv (std::string_view text)
{
    const auto table = readTable (text, "fuzz.csv");
    if (! table)
    {
        const auto& e = table.error();
        if (e.id.empty() || e.where.empty() || e.text.empty() || e.remedy.empty()) std::abort();
        return;
    }
    if (table->columns.empty() || table->values.size() != table->rows() * table->columns.size()) std::abort();

    const auto trace = readTrace (table->columns, table->values);
    if (hasErrors (trace.messages)) return;
    double before = 0.0;
    for (const auto& row : trace.trace.rows)
    {
        if (! (row.t >= before)) std::abort();
        before = row.t;
    }
}

}   // namespace tactus::fuzz
