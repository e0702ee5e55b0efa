// SPDX-License-Identifier: MIT
#pragma once

#include "atomic_file.hpp"

#include <cstddef>
#include <filesystem>
#include <istream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactus
{

/// Named columns of numbers.
struct Table
{
    std::vector<std::string> columns;
    std::vector<double> values;   // row after row

    std::size_t rows() const noexcept { return columns.empty() ? 0 : values.size() / columns.size(); }
    std::span<const double> row (std::size_t index) const { return std::span (values).subspan (index * columns.size(), columns.size()); }
    double at (std::size_t row_index, std::size_t column_index) const { return values[row_index * columns.size() + column_index]; }
    std::optional<std::size_t> column (std::string_view name) const noexcept;
};

/// Reads comma-separated numbers under a header row.
///
/// Numbers have a decimal point in any locale; nan, inf and -inf, in upper or lower case, are numbers too. A byte order mark,
/// any line ends, blank lines at the end, spaces around fields and double quotes are accepted. Columns keep their order. A
/// header alone is a table without rows. Accepts any text.
///
/// Errors: csv/empty, csv/no_header, csv/empty_column_name, csv/duplicate_column, csv/empty_field, csv/not_a_number,
/// csv/out_of_range, csv/ragged_row, csv/blank_line, csv/broken_quote, csv/nul_byte, csv/line_too_long, csv/too_large, csv/unreadable, file/too_large. `where`
/// is name:line:column. Lines and columns count from 1, and columns count bytes.
Result<Table> readTable (std::string_view text, std::string_view name);
Result<Table> readTable (std::istream& in, std::string_view name);
Result<Table> readTable (const std::filesystem::path& path);

/// Writes a table row by row, each number as the shortest text that reads back to the same double. The file appears on commit()
/// or not at all; IfKilled says what becomes of it if the process is killed before.
class TableWriter
{
public:
    /// Column names must be valid for readTable: not empty, unique, on one line.
    static Result<TableWriter> create (const std::filesystem::path& path, std::span<const std::string> columns, IfKilled = IfKilled::removed);

    Result<> row (std::span<const double> values);

    /// Hands all rows so far to the system; they then survive the end of the process.
    Result<> flush();
    Result<> commit();

private:
    TableWriter (AtomicFile opened, std::size_t width);
    AtomicFile file;
    std::size_t columns;
    std::string lines;   // that wait to be written; only whole lines are written, because a process can be killed in between
};

}   // namespace tactus
