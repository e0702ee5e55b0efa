// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace tactus::host
{

/// An SI prefix as files write it: "u" for micro.
struct SiPrefix
{
    std::string_view text;
    double factor = 1.0;
};

/// The most readable prefix for a value. None for 0, and for units that take no prefix.
SiPrefix prefixFor (double value, std::string_view unit) noexcept;

/// Formats a value with an SI prefix: "3.1 mJ".
std::string withPrefix (double value, const std::string& unit, int digits = 3);

}   // namespace tactus::host
