// SPDX-License-Identifier: GPL-3.0-or-later
#include "trace_file.hpp"

#include <host/app/text/filled.hpp>

#include <limits>

namespace tactus::host
{

Result<> writeTraces (const std::filesystem::path& path, const TraceList& all)
{
    TraceList traces;
    std::vector<std::string> columns { "t" };
    auto begin = std::numeric_limits<std::uint64_t>::max(), end = std::uint64_t { 0 };
    for (const auto& t : all)
    {
        if (std::ranges::count (columns, t->name()) > 0 || t->begin() == t->end()) continue;
        traces.push_back (t);
        columns.push_back (t->name());
        begin = std::min (begin, t->begin());
        end = std::max (end, t->end());
    }
    if (traces.empty())
        return Message::error ("scope/nothing", path.string(), TRANS ("there is nothing to save yet").toStdString(),
                               TRANS ("run the graph first").toStdString());

    auto writer = TableWriter::create (path, columns);
    if (! writer) return writer.error();
    std::vector<double> row (columns.size());
    for (auto tick = begin; tick < end; ++tick)
    {
        row[0] = static_cast<double> (tick) / traces.front()->rate();
        for (std::size_t i = 0; i < traces.size(); ++i)
        {
            const auto& t = *traces[i];
            row[i + 1] = tick >= t.begin() && tick < t.end() ? t.at (tick) : std::numeric_limits<double>::quiet_NaN();
        }
        if (const auto written = writer->row (row); ! written) return written;
    }
    return writer->commit();
}

}   // namespace tactus::host
