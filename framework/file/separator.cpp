// SPDX-License-Identifier: MIT
#include "separator.hpp"

#include <tactus/text/read_number.hpp>

#include <algorithm>
#include <cstddef>

namespace tactus
{

namespace
{
/// True if a line has this separator, and its first field that is not empty is then a number.
bool beginsWithNumber (std::string_view line, char separator)
{
    constexpr std::string_view around = " \t\r\"#";
    if (line.find (separator) == line.npos) return false;
    while (! line.empty())
    {
        auto field = line.substr (0, line.find (separator));
        line.remove_prefix (std::min (line.size(), field.size() + 1));
        field.remove_prefix (std::min (field.find_first_not_of (around), field.size()));
        field = field.substr (0, field.find_last_not_of (around) + 1);
        if (! field.empty()) return wholeNumber (withPoint (field)).has_value();
    }
    return false;
}

bool isOutsideOfQuotes (std::string_view line, char wanted)
{
    bool is_quoted = false;
    return std::ranges::any_of (line, [&] (char c) {
        if (c == '"') is_quoted = ! is_quoted;
        return c == wanted && ! is_quoted;
    });
}
}   // namespace

char separatorOf (std::string_view line, char usual)
{
    if ((usual == ';' || usual == '\t') && line.find (usual) != line.npos) return usual;
    for (const char c : { ';', '\t' })
        if (beginsWithNumber (line, c)) return c;
    for (const char c : { ',', ';', '\t' })
        if (isOutsideOfQuotes (line, c)) return c;
    return ' ';
}

std::string withPoint (std::string_view field)
{
    std::string plain (field);
    const auto comma = field.find (',');
    if (comma != field.npos && field.find (',', comma + 1) == field.npos && field.find ('.') == field.npos) plain[comma] = '.';
    return plain;
}

}   // namespace tactus
