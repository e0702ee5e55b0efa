// SPDX-License-Identifier: MIT
#include "recording.hpp"

#include <tactus/file/text_file.hpp>
#include <tactus/kit/at.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/units.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

namespace tactus::host
{

namespace
{
constexpr double gram_force = 9.80665e-3, standard_gravity = 9.80665;

std::string trimmed (const std::string& s)
{
    const auto from = s.find_first_not_of (" \t\r\"#"), to = s.find_last_not_of (" \t\r\"");
    return from == std::string::npos ? "" : s.substr (from, to - from + 1);
}

std::vector<std::string> split (const std::string& line, char at)
{
    std::vector<std::string> parts { "" };
    for (const char c : line)
        if (c == at)
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

/// The name of a column that has none in the file.
std::string columnName (std::size_t index) { return "column " + std::to_string (index + 1); }

/// A header or a row as readTable expects it. Programs such as pandas leave the name of the first column empty.
std::string withCommas (const std::string& line, char separator, bool is_header)
{
    std::string joined;
    if (separator == ' ')
    {
        for (const char c : trimmed (line))
            if (c != ' ' && c != '\t')
                joined += c;
            else if (joined.back() != ',')
                joined += ',';
        return joined;
    }
    const auto parts = split (line, separator);
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
        const auto part = trimmed (parts[i]);
        joined += (i > 0 ? "," : "") + (is_header && part.empty() ? columnName (i) : part);
    }
    return joined;
}

bool startsWithNumber (const std::string& line)
{
    const auto start = trimmed (line);
    return ! start.empty() && (std::isdigit (static_cast<unsigned char> (start[0])) || start[0] == '-' || start[0] == '+' || start[0] == '.');
}

char separatorOf (const std::string& line)
{
    for (const char c : { ',', ';', '\t' })
        if (line.find (c) != std::string::npos) return c;
    return ' ';
}
}   // namespace

std::string unitIn (const std::string& column)
{
    for (const auto& [open, close] : { std::pair { '[', ']' }, std::pair { '(', ')' } })
        if (const auto from = column.find (open), to = column.rfind (close); from != std::string::npos && to != std::string::npos && from < to)
            return trimmed (column.substr (from + 1, to - from - 1));
    const auto from = column.rfind ('_');
    if (from == std::string::npos) return "";
    const auto unit = column.substr (from + 1);
    return unit == "gf" || unit == "g" || parseMeasure ("1 " + unit) ? unit : "";
}

std::optional<double> factorOf (const std::string& text, const std::string& si_unit)
{
    const auto unit = trimmed (text);
    if (unit == "gf" && si_unit == "N") return gram_force;
    if (unit == "g" && si_unit == "m/s2") return standard_gravity;
    const auto measure = parseMeasure (startsWithNumber (unit) ? unit : "1 " + unit), si = parseMeasure ("1 " + si_unit);
    if (! measure || ! si || measure->dimension != si->dimension || ! (std::abs (measure->value) > 0.0) || ! std::isfinite (measure->value)) return {};
    return measure->value;
}

namespace
{
/// A recording as readTable expects it, and the line in the file of each of its lines.
struct PlainText
{
    std::string text {};
    std::vector<std::size_t> lines {};   // from 1

    void add (const std::string& line, std::size_t index)
    {
        text += line + '\n';
        lines.push_back (index + 1);
    }
};

/// Replaces the line number in the place of a message, name:line:column, by that in the file. The column may differ there, so it is left
/// out.
Message inFile (Message message, const std::string& name, const PlainText& plain)
{
    if (! message.where.starts_with (name + ":")) return message;
    const auto line = std::strtoul (message.where.c_str() + name.size() + 1, nullptr, 10);
    if (line >= 1 && line <= plain.lines.size()) message.where = name + ":" + std::to_string (plain.lines[line - 1]);
    return message;
}
}   // namespace

Result<Table> readRecording (const std::filesystem::path& path)
{
    const auto name = path.string();
    const auto text = readFile (path);
    if (! text) return readTable (path);   // for its message
    const auto lines = split (*text, '\n');
    std::size_t header = 0;
    while (header < lines.size() && trimmed (lines[header]).empty())
        ++header;
    const auto has_names = [&] { return std::ranges::none_of (split (lines[header], ','), [] (const auto& part) { return trimmed (part).empty(); }); };
    const bool is_plain = header < lines.size() && separatorOf (lines[header]) == ',' && header + 1 < lines.size() && separatorOf (lines[header + 1]) == ','
                          && lines[header].find ('#') == std::string::npos && has_names();
    if (is_plain || header + 1 >= lines.size()) return readTable (*text, name);

    PlainText plain;
    const auto first_row = startsWithNumber (lines[header]) ? header : header + 1;
    auto names = withCommas (lines[header], separatorOf (lines[header]), true);
    if (first_row == header)
    {
        const auto count = at (std::ranges::count (withCommas (lines[header], separatorOf (lines[header]), false), ','));
        names = columnName (0);
        for (std::size_t i = 1; i <= count; ++i)
            names += "," + columnName (i);
    }
    plain.add (names, header);
    for (std::size_t i = first_row; i < lines.size(); ++i)
        if (! trimmed (lines[i]).empty()) plain.add (withCommas (lines[i], separatorOf (lines[i]), false), i);
    auto table = readTable (plain.text, name);
    if (! table) return inFile (table.error(), name, plain);
    return table;
}

std::string bareName (const std::string& column)
{
    auto name = column;
    if (const auto unit = unitIn (column); ! unit.empty()) name = column.substr (0, column.rfind (unit) - 1);
    name = trimmed (name);
    std::ranges::transform (name, name.begin(), [] (unsigned char c) { return c == ' ' ? '_' : static_cast<char> (std::tolower (c)); });
    return name;
}

std::optional<std::size_t> findColumn (const Table& table, const FitColumn& wanted, const ColumnChoice& choice)
{
    if (const auto chosen = choice.names.find (wanted.role); chosen != choice.names.end())
        return chosen->second.empty() ? std::nullopt : table.column (chosen->second);
    for (const auto& name : wanted.names)
        for (std::size_t i = 0; i < table.columns.size(); ++i)
            if (bareName (table.columns[i]) == name) return i;
    return {};
}

Result<std::vector<double>> columnOf (const Table& table, const std::string& file, const FitColumn& wanted, const ColumnChoice& choice)
{
    const auto chosen = choice.names.find (wanted.role);
    const auto found = findColumn (table, wanted, choice);
    const bool is_named = chosen != choice.names.end() && ! chosen->second.empty();
    if (! found && ! wanted.required && ! is_named) return std::vector<double> {};
    if (! found)
    {
        std::string columns;
        for (const auto& column : table.columns)
            columns += (columns.empty() ? "" : ", ") + column;
        return Message::error ("fit/column", file,
                               "there is no column " + quote (is_named ? chosen->second : wanted.role) + "; there are " + columns,
                               "name the column " + quote (wanted.role) + " (" + wanted.about + "), or say which one it is: --column " + wanted.role + "=NAME");
    }

    const auto& name = table.columns[*found];
    double factor = 1.0;
    if (const auto unit = choice.units.find (wanted.role); unit != choice.units.end())
        factor = unit->second;
    else if (const auto written = unitIn (name); ! written.empty() && ! wanted.unit.empty())
    {
        const auto known = factorOf (written, wanted.unit);
        if (! known)
            return Message::error ("fit/unit", file, "the column " + quote (name) + " is in " + quote (written) + ", not in a unit of " + wanted.unit,
                                   "say what 1 in this column means, such as --unit \"" + wanted.role + "=1 " + wanted.unit + "\"");
        factor = *known;
    }
    std::vector<double> values;
    for (std::size_t r = 0; r < table.rows(); ++r)
        values.push_back (factor * table.at (r, *found));
    return values;
}

}   // namespace tactus::host
