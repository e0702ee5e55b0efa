// SPDX-License-Identifier: MIT
#pragma once

#include "whole_error.hpp"

#include <host/base/assets/image.hpp>

namespace tactus::fuzz
{

/// Reads the bytes as an image. Either its values are from 0 (black) to 1 (white), or reading reports an error. Aborts otherwise.
inline void tryImage (std::string_view bytes)
{
    const auto grid = host::readImage (bytes, "fuzz.png");
    if (! grid) return checkWhole (grid.error());
    if (grid->rows < 1 || grid->columns < 1) std::abort();
    if (grid->values.size() != static_cast<std::size_t> (grid->rows) * static_cast<std::size_t> (grid->columns)) std::abort();
    for (const double grey : grid->values)
        if (! (grey >= 0.0 && grey <= 1.0)) std::abort();
}

}   // namespace tactus::fuzz
