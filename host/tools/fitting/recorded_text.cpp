// SPDX-License-Identifier: MIT
#include "recorded_text.hpp"

#include <tactus/file/separator.hpp>
#include <tactus/kit/at.hpp>
#include <tactus/text/as_utf8.hpp>
#include <tactus/text/read_number.hpp>

#include <algorithm>
#include <cctype>

namespace tactus::host
{

namespace
{
using Fields = std::vector<std::string>;

Fields split (const std::string& line, char at)
{
    Fields parts { "" };
    for (const char c : line)
        if (c == at)
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

/// A number with a point in the place of its decimal comma; any other field as it is.
std::string numberOr (std::string field)
{
    auto plain = withPoint (field);
    return wholeNumber (plain) ? plain : field;
}

/// The fields of a line, without spaces around them. Several spaces separate like one.
Fields fieldsOf (const std::string& line, char separator)
{
    Fields fields;
    for (auto& part : split (separator == ' ' ? trimmed (line) : line, separator))
        if (auto field = trimmed (part); separator != ' ' || ! field.empty())
            fields.push_back (separator == ',' ? std::move (field) : numberOr (std::move (field)));
    return fields;
}

Fields fieldsOf (const std::string& line) { return fieldsOf (line, separatorOf (line)); }

/// The number of fields, without empty ones at the end.
std::size_t filled (const Fields& fields)
{
    auto count = fields.size();
    while (count > 0 && fields[count - 1].empty())
        --count;
    return count;
}

bool isNumber (const std::string& field) { return wholeNumber (field).has_value(); }

/// The name of a column that has none in the file.
std::string columnName (std::size_t index) { return "column " + std::to_string (index + 1); }

/// A micro sign in Latin-1 as the u that stands for it. In UTF-8, the byte follows another one.
std::string withoutLatin1 (std::string name)
{
    for (std::size_t i = 0; i < name.size(); ++i)
        if (name[i] == '\xB5' && (i == 0 || static_cast<unsigned char> (name[i - 1]) < 0x80)) name[i] = 'u';
    return name;
}

/// Fields with commas between them. Empty fields after the last column are left out.
std::string joined (Fields fields, std::size_t columns, bool are_names)
{
    std::string line;
    if (fields.size() > columns && filled (fields) <= columns) fields.resize (columns);
    for (std::size_t i = 0; i < fields.size(); ++i)
    {
        if (i > 0) line += ',';
        if (are_names)
            line += fields[i].empty() ? columnName (i) : withoutLatin1 (fields[i]);
        else   // one field, even if it is not a number
            line += fields[i].find (',') == std::string::npos ? fields[i] : '"' + fields[i] + '"';
    }
    return line;
}

/// The indices of lines that are not blank.
std::vector<std::size_t> writtenLines (const std::vector<std::string>& lines)
{
    std::vector<std::size_t> written;
    for (std::size_t i = 0; i < lines.size(); ++i)
        if (! trimmed (lines[i]).empty()) written.push_back (i);
    return written;
}

struct Place
{
    std::size_t first_row = 0;   // an index of the lines that are not blank
    bool has_names = false;      // the line before it
};

/// The first of two rows of numbers, or the last line. A line above it that could be a damaged row is the first row. Empty if there is none.
std::optional<Place> placeOfTable (const std::vector<std::string>& lines, const std::vector<std::size_t>& written)
{
    const auto fieldsIn = [&] (std::size_t i) { return fieldsOf (lines[written[i]]); };
    const auto columns = [&] (std::size_t i) {   // 0 if it is not a row of numbers
        const auto fields = fieldsIn (i);
        const auto count = filled (fields);
        return std::all_of (fields.begin(), fields.begin() + static_cast<std::ptrdiff_t> (count), isNumber) && count > 1 ? count : std::size_t { 0 };
    };
    for (std::size_t i = 0; i < written.size(); ++i)
    {
        const auto count = columns (i);
        if (count == 0 || (i + 1 < written.size() && columns (i + 1) != count)) continue;
        std::size_t first = 0;
        while (first < i && ! (isNumber (fieldsIn (first).front()) && filled (fieldsIn (first)) == count))
            ++first;
        if (first == 0) return Place {};
        const auto above = fieldsIn (first - 1);
        const bool is_prose = filled (above) != count && separatorOf (lines[written[first - 1]]) == ' ' && separatorOf (lines[written[first]]) != ' ';
        return Place { first, ! isNumber (above.front()) && ! is_prose };
    }
    return {};
}
}   // namespace

std::string trimmed (const std::string& s)
{
    const auto from = s.find_first_not_of (" \t\r\"#"), to = s.find_last_not_of (" \t\r\"");
    return from == std::string::npos ? "" : s.substr (from, to - from + 1);
}

bool startsWithNumber (const std::string& line)
{
    const auto start = trimmed (line);
    return ! start.empty() && (std::isdigit (static_cast<unsigned char> (start[0])) || start[0] == '-' || start[0] == '+' || start[0] == '.');
}

std::optional<RecordedText> tableIn (const std::string& written_text)
{
    const auto text = asUtf8 (written_text);
    constexpr const char* byte_order_mark = "\xEF\xBB\xBF";
    const auto lines = split (text.starts_with (byte_order_mark) ? text.substr (3) : text, '\n');
    const auto written = writtenLines (lines);
    if (written.size() < 2) return {};
    const auto place = placeOfTable (lines, written).value_or (Place { startsWithNumber (lines[written[0]]) ? std::size_t { 0 } : 1, true });
    const auto& first = lines[written[place.first_row]];
    const auto numbers = fieldsOf (first);
    const auto names = place.first_row > 0 && place.has_names ? fieldsOf (lines[written[place.first_row - 1]]) : Fields {};
    const auto& top = lines[written[0]];
    const bool is_plain = place.first_row == 1 && written[1] == 1 && separatorOf (top) == ',' && separatorOf (first) == ','
                          && top.find ('#') == std::string::npos
                          && std::ranges::none_of (names, &std::string::empty) && filled (numbers) == numbers.size();
    if (is_plain) return {};

    RecordedText table;
    const auto columns = std::max (filled (names), filled (numbers));
    if (names.empty())
        table.add (joined (Fields (columns), columns, true), written[place.first_row]);
    else
        table.add (joined (names, columns, true), written[place.first_row - 1]);
    for (auto i = place.first_row; i < written.size(); ++i)
        table.add (joined (fieldsOf (lines[written[i]], separatorOf (lines[written[i]], separatorOf (first))), columns, false), written[i]);
    return table;
}

}   // namespace tactus::host
