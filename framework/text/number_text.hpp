// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <string>

namespace tactus
{

/// The shortest text that reads back to the same double, in any locale. The sign of a NaN is dropped.
inline std::string numberText (double v)
{
    if (v != v) return "nan";
    char buffer[32];
    return { buffer, std::to_chars (buffer, buffer + sizeof buffer, v).ptr };
}

/// The number with this many digits, as printf writes it with %g, in any locale.
inline std::string roundedText (double v, int digits = 6)
{
    char buffer[64];
    return { buffer, std::to_chars (buffer, buffer + sizeof buffer, v, std::chars_format::general, digits).ptr };
}

}   // namespace tactus
