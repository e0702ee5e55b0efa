// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <sstream>
#include <string>

namespace tactus::test
{

/// The text of a table; `row` writes the row of this number. Numbers have 12 digits.
inline std::string table (const std::string& header, int rows, const std::function<void (std::ostream&, int)>& row)
{
    std::ostringstream text;
    text.precision (12);
    text << header << "\n";
    for (int i = 0; i < rows; ++i)
    {
        row (text, i);
        text << "\n";
    }
    return text.str();
}

}   // namespace tactus::test
