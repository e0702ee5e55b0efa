// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace tactus::host
{

/// C++ text without comments, white space and the bodies of functions. If two versions of a header have the same declarations, their
/// classes have the same members in the same places. Bodies that may affect the members are kept: those of functions that are
/// constexpr or consteval, or whose result is `auto`. The opposite does not hold: a new default value, or anything that this function
/// does not understand, also changes the text.
std::string declarationsOf (std::string_view source);

}   // namespace tactus::host
