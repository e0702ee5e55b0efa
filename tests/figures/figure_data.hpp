// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// The data of the pictures in docs/chapter.md. A test renders a graph of docs/figures/, asserts what the picture will
/// show, and leaves the numbers in build/figures/; the script beside it draws them (draw.py).

#include <host/io/csv.hpp>

#include <string>
#include <vector>

namespace tactus::test
{

using Columns = std::vector<std::vector<double>>;

/// What was recorded of a run, by name.
class Record
{
public:
    explicit Record (host::Table);

    std::size_t rows() const noexcept { return table.rows(); }
    double at (const std::string& column, std::size_t row) const { return table.at (row, index (column)); }
    std::vector<double> operator[] (const std::string& column) const;

private:
    std::size_t index (const std::string& column) const;

    host::Table table;
};

/// Renders docs/figures/GRAPH.json into build/figures/NAME.csv. `options` are those of `tactus render`.
Record renderFigure (const std::string& graph, const std::string& name, const std::vector<std::string>& options);

/// As renderFigure, for runs of which the picture shows a number only; nothing is kept.
Record renderOnce (const std::string& graph, const std::vector<std::string>& options);

/// Writes build/figures/NAME.csv, row by row.
void writeFigure (const std::string& name, const std::vector<std::string>& columns, const Columns& rows);

}   // namespace tactus::test
