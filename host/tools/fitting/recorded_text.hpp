// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// A recording as readTable expects it: names and numbers separated by commas.
struct RecordedText
{
    std::string text {};
    std::vector<std::size_t> lines {};   ///< the line in the file of each line of the text, from 1

    void add (const std::string& line, std::size_t index)
    {
        text += line + '\n';
        lines.push_back (index + 1);
    }
};

/// Finds the table in the text of a file: the first rows of numbers, and the names above them. Lines above the names, which some programs write about
/// the measurement, are left out; so are empty fields at the ends of all rows. Columns may be separated by commas, semicolons, tabs or spaces. A column
/// without a name is called "column N". A line that could be a row of the table is never left out. Empty if readTable can read the text as it is, or
/// there is no table, so that readTable says what is wrong.
std::optional<RecordedText> tableIn (const std::string& text);

/// Without spaces, quotation marks and # at the ends.
std::string trimmed (const std::string&);

bool startsWithNumber (const std::string&);

}   // namespace tactus::host
