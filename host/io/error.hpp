// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace tactus::host
{

/// What went wrong with a file. The id never changes, so that tests and scripts may rely on it; the rest is for people.
struct Error
{
    std::string id;       // "csv/not_a_number"
    std::string where;    // "feed.csv:3:7", or a path
    std::string what;     // "'1.5 N' is not a number"
    std::string remedy;   // "write 1.5; units belong into the column name"
};

/// One line for a terminal: where: what; remedy [id].
inline std::string describe (const Error& error)
{
    return error.where + ": " + error.what + "; " + error.remedy + " [" + error.id + "]";
}

}   // namespace tactus::host
