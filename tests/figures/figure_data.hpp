// SPDX-License-Identifier: MIT
#pragma once

/// Data of the figures in docs/chapter.md. A test renders a graph of docs/figures/, checks what the figure shows, and
/// writes the numbers to build/figures/. draw.py draws them with the scripts in plots/.

#include <tactus/file/csv.hpp>

#include <string>
#include <vector>

namespace tactus::test
{

using Columns = std::vector<std::vector<double>>;

/// The recorded columns of a run, by name.
class Record
{
public:
    explicit Record (Table);

    std::size_t rows() const noexcept { return table.rows(); }
    const std::vector<std::string>& columns() const noexcept { return table.columns; }
    double at (const std::string& column, std::size_t row) const { return table.at (row, index (column)); }
    std::vector<double> operator[] (const std::string& column) const;

private:
    std::size_t index (const std::string& column) const;

    Table table;
};

/// Renders docs/figures/GRAPH.json into build/figures/NAME.csv. `options` are those of `tactus render`.
Record renderFigure (const std::string& graph, const std::string& name, const std::vector<std::string>& options);

/// Runs `tactus COMMAND docs/figures/NAME.json`, which writes a table to build/figures/NAME.csv.
Record analyseFigure (const std::string& command, const std::string& name, const std::vector<std::string>& options);

/// Like renderFigure, but keeps no file. For runs that contribute only a single number to a figure.
Record renderOnce (const std::string& graph, const std::vector<std::string>& options);

/// Writes build/figures/NAME.csv, row by row.
void writeFigure (const std::string& name, const std::vector<std::string>& columns, const Columns& rows);

}   // namespace tactus::test
