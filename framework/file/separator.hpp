// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace tactus
{

/// The separator of the columns in a line of a table. A semicolon or a tab, if the line then begins with a number: where the decimal sign is a comma,
/// programs separate by one of these. Else the first of comma, semicolon and tab that is outside of double quotes, or a space if there is none.
/// `usual` is the separator of the first row, if it is known: a semicolon or a tab then separates also where a field is not a number, such as 1.000,5.
char separatorOf (std::string_view line, char usual = '\0');

/// A field with a point in place of its decimal comma. Only a single comma in a field without a point counts as one.
std::string withPoint (std::string_view field);

}   // namespace tactus
