// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/units.hpp>

#include <cmath>
#include <cstdlib>

namespace tactus::fuzz
{

/// Reads the text as a measure. Either it is finite and its unit can be written and read back, or reading reports an error.
/// Aborts otherwise.
inline void tryUnits (std::string_view text)
{
    const auto result = parseMeasure (text);
    if (! result)
    {
        if (result.error().text.empty()) std::abort();
        return;
    }
    const auto& measure = *result;
    if (! std::isfinite (measure.value)) std::abort();
    const auto again = parseMeasure ("1 " + symbolOf (measure.dimension));
    if (! again || ! (again->dimension == measure.dimension)) std::abort();
}

}   // namespace tactus::fuzz
