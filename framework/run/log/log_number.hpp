// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/json.hpp>
#include <tactus/text/json_writer.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace tactus
{

/// JSON has no numbers that are not finite, so a log writes them as text.
inline Json toLog (double v)
{
    if (std::isnan (v)) return "nan";
    if (std::isinf (v)) return v > 0.0 ? "inf" : "-inf";
    return v;
}

/// The shortest text that reads back to the same double; the sign of 0 is kept.
inline std::string logNumber (double v) { return std::isfinite (v) ? jsonNumber (v) : toLog (v).dump(); }

inline std::optional<double> fromLog (const Json& value)
{
    if (value.is_number()) return value.get<double>();
    if (! value.is_string()) return std::nullopt;
    const auto& text = value.asString();
    if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
    if (text == "inf") return std::numeric_limits<double>::infinity();
    if (text == "-inf") return -std::numeric_limits<double>::infinity();
    return std::nullopt;
}

}   // namespace tactus
