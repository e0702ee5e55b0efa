// SPDX-License-Identifier: MIT
#include "logs.hpp"
#include "assets.hpp"
#include "graph.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <tactus/file/graph_file.hpp>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tactus::python
{

namespace
{
using Columns = py::array_t<double, py::array::f_style>;

/// The first tick, the names and units of the columns, the values with a column for each, and the rest as JSON.
py::tuple given (std::unique_ptr<tactus_table, void (*) (tactus_table*)> table)
{
    const auto columns = tactus_table_columns (table.get()), rows = tactus_table_rows (table.get());
    Columns values ({ static_cast<py::ssize_t> (rows), static_cast<py::ssize_t> (columns) });
    std::vector<std::string> names, units;
    for (std::size_t i = 0; i < columns; ++i)
    {
        names.emplace_back (tactus_table_name (table.get(), i));
        units.emplace_back (tactus_table_unit (table.get(), i));
        std::copy_n (tactus_table_values (table.get(), i), rows, values.mutable_data() + i * rows);
    }
    return py::make_tuple (tactus_table_first (table.get()), names, units, values, std::string (tactus_table_about (table.get())));
}

py::tuple readLog (const std::string& log, double from_s, double until_s)
{
    tactus_messages messages;
    std::unique_ptr<tactus_table, void (*) (tactus_table*)> table { nullptr, tactus_table_free };
    {
        const py::gil_scoped_release without_gil;
        table.reset (tactus_log_read (log.c_str(), from_s, until_s, &messages));
    }
    report (messages.list);
    return given (std::move (table));
}

py::tuple replay (const std::string& log, const EditedGraph* graph, const std::vector<std::string>& records, const std::map<std::string, std::string>& sets,
                  py::object supplied, double from_s, double until_s)
{
    PythonAssets assets { std::move (supplied) };
    std::vector<const char*> ports, values;
    std::vector<std::string> texts;
    for (const auto& port : records)
        ports.push_back (port.c_str());
    for (const auto& [name, value] : sets)
    {
        const auto json = jsonOf (value);
        texts.push_back (name + "=" + (json.is_string() ? json.asString() : json.dump()));
    }
    for (const auto& text : texts)
        values.push_back (text.c_str());
    tactus_run_options options = TACTUS_RUN_OPTIONS;
    options.records = ports.data();
    options.record_count = ports.size();
    options.sets = values.data();
    options.set_count = values.size();
    options.assets = assets.reader().read;
    options.asset_context = assets.reader().context;
    std::optional<tactus_graph> copy;
    if (graph != nullptr) copy.emplace (tactus_graph { graph::History (graph->graph()) });
    tactus_messages messages;
    std::unique_ptr<tactus_table, void (*) (tactus_table*)> table { nullptr, tactus_table_free };
    {
        const py::gil_scoped_release without_gil;
        table.reset (tactus_replay (log.c_str(), copy ? &*copy : nullptr, &options, from_s, until_s, &messages));
        assets.release();
    }
    assets.raiseFailure();
    report (messages.list);
    return given (std::move (table));
}
}   // namespace

void bindLogs (py::module_& module)
{
    module.def ("read_log", &readLog);
    module.def ("replay", &replay);
}

}   // namespace tactus::python
