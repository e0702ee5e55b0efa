// SPDX-License-Identifier: MIT
#pragma once

#include "json.hpp"

#include <span>
#include <string>
#include <string_view>

namespace tactus
{

/// Writes JSON for people and for diffs: an object or list goes on one line if it fits into 120 characters, else it gets one entry per
/// line; plain numbers share lines. The entries of the keys in `one_a_line` always get separate lines, so that a change to one
/// entry changes one line. Ends with a new line.
std::string writeJson (const Json&, std::span<const std::string_view> one_a_line = {});

/// The shortest text that reads back to the same double. It has a point or an exponent, so it remains a floating-point number.
std::string jsonNumber (double);

}   // namespace tactus
