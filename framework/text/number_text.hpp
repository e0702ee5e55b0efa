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

}   // namespace tactus
