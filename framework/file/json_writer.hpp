// SPDX-License-Identifier: MIT
#pragma once

#include <framework/json.hpp>

#include <span>
#include <string>
#include <string_view>

namespace tactus
{

/// Text for people and for diffs: an object or list stays on its line while that is at most 120 characters long, else
/// it has one entry a line; plain numbers share lines. The entries of the keys in `one_a_line` always have lines of their
/// own, so that a change to one of them is a change of one line. Ends with a new line.
std::string writeJson (const Json&, std::span<const std::string_view> one_a_line = {});

/// The shortest text that reads back to the same double; with a point or an exponent, so that it stays one.
std::string jsonNumber (double);

}   // namespace tactus
