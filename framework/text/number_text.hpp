// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cmath>
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

/// The number with this many digits, as printf writes it with %g, in any locale, but without an exponent from 1 to a million: "2000", not "2e+03".
inline std::string roundedText (double v, int digits = 6)
{
    char buffer[64];
    const auto write = [&buffer] (double x, int n) {
        return std::string (buffer, std::to_chars (buffer, buffer + sizeof buffer, x, std::chars_format::general, n).ptr);
    };
    const double size = std::abs (v);
    double most = 1.0;
    for (int i = 0; i < digits; ++i)
        most *= 10.0;
    if (! (size > 0.9 * most && size < 1e6)) return write (v, digits);
    double unit = 1.0;
    while (size / unit >= most)
        unit *= 10.0;
    return write (std::round (v / unit) * unit, 7);
}

}   // namespace tactus
