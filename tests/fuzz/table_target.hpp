// SPDX-License-Identifier: MIT
#pragma once

#include "whole_error.hpp"

#include <tactus/file/assets/table.hpp>

#include <algorithm>

namespace tactus::fuzz
{

/// Reads the text as a table. Either it is a full grid of finite numbers, or reading reports an error with its location. Aborts
/// otherwise.
inline void tryTable (std::string_view text)
{
    const auto grid = readers::readGrid (text, "fuzz.csv");
    if (! grid) return checkWhole (grid.error());
    if (grid->rows < 1 || grid->columns < 1) std::abort();
    if (grid->values.size() != static_cast<std::size_t> (grid->rows) * static_cast<std::size_t> (grid->columns)) std::abort();
    if (! std::ranges::all_of (grid->values, [] (double v) { return isFinite (v); })) std::abort();
}

}   // namespace tactus::fuzz
