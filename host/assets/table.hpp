// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/assets.hpp>
#include <host/io/error.hpp>

#include <tl/expected.hpp>

#include <string_view>

namespace tactus::host
{

/// Reads numbers in rows and columns as instruments and programs write them: separated by commas, semicolons, tabs or
/// spaces, with a decimal point, one row a line. Passed over: lines before the first that begins with a number, blank
/// lines, lines that begin with # or %, separators at the end of a line. Unlike readTable (host/io/csv.hpp) it looks
/// for no names of columns.
///
/// Two columns of which the first rises evenly are a line of a profilometer, positions and heights: it becomes one row
/// of heights. Even means that no position is a whole step off its place, as instruments round positions.
///
/// Ids of errors: table/empty, table/not_a_number, table/ragged_row, table/uneven, table/too_large, table/binary.
/// Where: name:line.
[[nodiscard]] tl::expected<Grid, Error> readGrid (std::string_view text, std::string_view name);

}   // namespace tactus::host
