// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/file/json_writer.hpp>
#include <framework/json.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace tactus::host
{

/// JSON has no words for what is not finite: in a log it is a text.
inline Json toLog (double v)
{
    if (std::isnan (v)) return "nan";
    if (std::isinf (v)) return v > 0.0 ? "inf" : "-inf";
    return v;
}

/// The same as text, the shortest that reads back to the same double; the sign of 0 stays.
inline std::string logNumber (double v) { return std::isfinite (v) ? jsonNumber (v) : toLog (v).dump(); }

inline std::optional<double> fromLog (const Json& value)
{
    if (value.is_number()) return value.get<double>();
    if (! value.is_string()) return std::nullopt;
    const auto& text = value.get_ref<const std::string&>();
    if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
    if (text == "inf") return std::numeric_limits<double>::infinity();
    if (text == "-inf") return -std::numeric_limits<double>::infinity();
    return std::nullopt;
}

}   // namespace tactus::host
