// SPDX-License-Identifier: MIT
#pragma once

#include <framework/units.hpp>

#include <cmath>
#include <cstdlib>

namespace tactus::fuzz
{

/// A text is a finite measure whose unit can be written and read again, or a sentence. Aborts if not.
inline void tryUnits (std::string_view text)
{
    const auto result = parseMeasure (text);
    if (const auto* sentence = std::get_if<std::string> (&result))
    {
        if (sentence->empty()) std::abort();
        return;
    }
    const auto& measure = std::get<Measure> (result);
    if (! std::isfinite (measure.value)) std::abort();
    const auto again = parseMeasure ("1 " + symbolOf (measure.dimension));
    if (! std::holds_alternative<Measure> (again) || ! (std::get<Measure> (again).dimension == measure.dimension)) std::abort();
}

}   // namespace tactus::fuzz
