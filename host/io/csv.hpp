// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/io/atomic_file.hpp>
#include <host/io/error.hpp>

#include <tl/expected.hpp>

#include <cstddef>
#include <filesystem>
#include <istream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
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
/// A number is written with a decimal point whatever the locale; nan, inf and -inf in any case are numbers too.
/// Tolerated: a byte order mark, any line ends, blank lines at the end, spaces around fields, double quotes.
/// Columns keep their order; a header alone is a table without rows. No input crashes it.
///
/// Ids of errors: csv/empty, csv/no_header, csv/empty_column_name, csv/duplicate_column, csv/empty_field,
/// csv/not_a_number, csv/out_of_range, csv/ragged_row, csv/blank_line, csv/broken_quote, csv/nul_byte,
/// csv/line_too_long, csv/unreadable. Where: name:line:column, counted in bytes from 1.
[[nodiscard]] tl::expected<Table, Error> readTable (std::string_view text, std::string_view name);
[[nodiscard]] tl::expected<Table, Error> readTable (std::istream& in, std::string_view name);
[[nodiscard]] tl::expected<Table, Error> readTable (const std::filesystem::path& path);

/// Writes a table row by row, each number as the shortest text that reads back to the same double.
/// The file appears on commit() or not at all.
class TableWriter
{
public:
    /// Columns must be as readTable wants them: named, each name once, one line.
    [[nodiscard]] static tl::expected<TableWriter, Error> create (const std::filesystem::path& path, std::span<const std::string> columns);

    [[nodiscard]] tl::expected<void, Error> row (std::span<const double> values);
    [[nodiscard]] tl::expected<void, Error> commit();

private:
    TableWriter (AtomicFile opened, std::size_t width);
    tl::expected<void, Error> writeLine();

    AtomicFile file;
    std::size_t columns;
    std::string line;   // kept for its memory
};

}   // namespace tactus::host
