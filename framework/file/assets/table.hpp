// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/assets.hpp>
#include <tactus/text/result.hpp>

#include <string_view>

namespace tactus::readers
{

/// Reads numbers in rows and columns, as instruments and programs write them: separated by commas, semicolons, tabs or
/// spaces, with decimal points, one row per line. Skips lines before the first one that starts with a number, blank lines,
/// lines that start with # or %, and separators at the end of a line. Unlike readTable (framework/file/csv.hpp) it does not
/// look for column names.
///
/// Two columns, the first of which rises evenly, are a profilometer scan (positions and heights) and become one row of
/// heights. "Evenly" means that no position is off by a whole step, since instruments round positions.
///
/// Error ids: table/empty, table/not_a_number, table/ragged_row, table/uneven, table/too_large, table/binary.
/// `where` is name:line.
[[nodiscard]] Result<Grid> readGrid (std::string_view text, std::string_view name);

}   // namespace tactus::readers
