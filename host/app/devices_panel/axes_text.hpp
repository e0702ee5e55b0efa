// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/text/json.hpp>

#include <string>
#include <string_view>

namespace tactus::host
{

/// The axes of a workspace as typed: "y -x z"; rows of numbers stay JSON.
std::string textOfAxes (const Json&);

/// Reads typed axes: three of x, y and z, each with or without a minus, or JSON. Anything else is kept as a text, and rejected when the binding is
/// checked.
Json readAxesText (std::string_view);

}   // namespace tactus::host
