// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <charconv>
#include <iterator>
#include <string>

namespace tactus::host
{

/// The shortest text that reads back as the same float, the number type of OSC.
inline std::string floatText (float v)
{
    char text[32];
    const auto end = std::to_chars (std::begin (text), std::end (text), v).ptr;
    return { text, end };
}

}   // namespace tactus::host
