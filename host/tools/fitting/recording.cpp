// SPDX-License-Identifier: MIT
#include "recording.hpp"
#include "recorded_text.hpp"
#include "surface_preset.hpp"

#include <tactus/file/text_file.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/number_text.hpp>
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

/// Units that some programs write in full, as their symbols: "um" for "Micrometer", "s" for "sec". Other text stays as it is.
std::string symbolIn (const std::string& unit)
{
    std::string word = unit;
    std::ranges::transform (word, word.begin(), [] (unsigned char c) { return static_cast<char> (std::tolower (c)); });
    if (word.size() > 4 && word.ends_with ('s')) word.pop_back();
    if (word == "sec") return "s";
    if (word == "micron") return "um";
    constexpr std::pair<const char*, const char*> prefixes[] { { "nano", "n" }, { "micro", "u" }, { "milli", "m" }, { "centi", "c" }, { "", "" } };
    constexpr std::pair<const char*, const char*> units[] { { "meter", "m" }, { "metre", "m" }, { "newton", "N" }, { "second", "s" } };
    for (const auto& [prefix, letter] : prefixes)
        for (const auto& [name, symbol] : units)
            if (word == std::string (prefix) + name) return std::string (letter) + symbol;
    return unit;
}

bool isUnit (const std::string& text) { return text == "gf" || text == "g" || parseMeasure ("1 " + symbolIn (text)).has_value(); }

/// "m_s" as "m/s"
std::string quotient (std::string unit)
{
    std::ranges::replace (unit, '_', '/');
    return unit;
}

/// The unit as the name of a column has it, such as the "m_s" of speed_m_s.
std::string writtenUnit (const std::string& column)
{
    for (const auto& [open, close] : { std::pair { '[', ']' }, std::pair { '(', ')' } })
        if (const auto from = column.find (open), to = column.rfind (close); from != std::string::npos && to != std::string::npos && from < to)
            return trimmed (column.substr (from + 1, to - from - 1));
    const auto from = column.find_last_of ("_ ");
    if (from == std::string::npos) return "";
    const auto before = from == 0 ? std::string::npos : column.find_last_of ("_ ", from - 1);
    if (before != std::string::npos && column[from] == '_' && std::isalpha (static_cast<unsigned char> (column[before + 1])) != 0)
        if (const auto over = column.substr (before + 1); isUnit (quotient (over))) return over;
    const auto unit = column.substr (from + 1);
    const bool is_number = unit.find_first_not_of ("0123456789.") == std::string::npos;   // "channel 1" is a name
    return ! is_number && isUnit (unit) ? unit : "";
}
}   // namespace

std::string unitIn (const std::string& column) { return quotient (writtenUnit (column)); }

std::optional<double> factorOf (const std::string& text, const std::string& si_unit)
{
    const auto unit = symbolIn (trimmed (text));
    if ((unit == "gf" || unit == "g") && si_unit == "N") return gram_force;
    if (unit == "g" && si_unit == "m/s2") return standard_gravity;
    const auto measure = parseMeasure (startsWithNumber (unit) ? unit : "1 " + unit), si = parseMeasure ("1 " + si_unit);
    if (! measure || ! si || measure->dimension != si->dimension || ! (std::abs (measure->value) > 0.0) || ! std::isfinite (measure->value)) return {};
    return measure->value;
}

namespace
{
/// Replaces the line number in the place of a message, name:line:column, by that in the file. The column may differ there, so it is left
/// out.
Message inFile (Message message, const std::string& name, const RecordedText& plain)
{
    if (! message.where.starts_with (name + ":")) return message;
    const auto line = std::strtoul (message.where.c_str() + name.size() + 1, nullptr, 10);
    if (line >= 1 && line <= plain.lines.size()) message.where = name + ":" + std::to_string (plain.lines[line - 1]);
    return message;
}

/// Adds integrated_position where the names of the columns leave no doubt. A speed has no direction, so it does not do.
void integrate (Table& table)
{
    const auto find = [&] (const char* unit, std::vector<std::string> names) { return findColumn (table, { names.front(), unit, true, names, {} }); };
    const auto valuesIn = [&] (std::size_t i, const char* unit) {
        return columnOf (table, {}, { table.columns[i], unit, true, { bareName (table.columns[i]) }, {} });
    };
    const auto t = find ("s", { "t", "time" }), v = find ("m/s", { "velocity", "v" });
    const bool is_stroke =
        find ("N", { "friction", "friction_force", "drag" })
        || (find ("N", { "force", "fx", "ft" }) && find ("N", { "load", "normal", "normal_force", "fz", "fn" }));
    if (! t || ! v || ! is_stroke || find ("m", { "position", "x", "displacement", "travel", "depth" })) return;
    const auto time = valuesIn (*t, "s"), velocity = valuesIn (*v, "m/s");
    if (! time || ! velocity) return;
    const auto rows = table.rows(), width = table.columns.size();
    std::vector<double> values;
    values.reserve (rows * (width + 1));
    double x = 0.0;
    for (std::size_t r = 0; r < rows; ++r)
    {
        if (r > 0) x += 0.5 * ((*velocity)[r] + (*velocity)[r - 1]) * ((*time)[r] - (*time)[r - 1]);
        values.insert (values.end(), table.values.begin() + static_cast<std::ptrdiff_t> (r * width),
                       table.values.begin() + static_cast<std::ptrdiff_t> ((r + 1) * width));
        values.push_back (x);
    }
    table.columns.emplace_back (integrated_position);
    table.values = std::move (values);
}
}   // namespace

Result<Table> readRecording (const std::filesystem::path& path)
{
    const auto name = path.string();
    const auto text = readFile (path);
    if (! text) return readTable (path);   // for its message
    const auto plain = tableIn (*text);
    auto table = readTable (plain ? plain->text : *text, name);
    if (! table) return plain ? inFile (table.error(), name, *plain) : table.error();
    integrate (*table);
    return table;
}

Table tableOf (const Signal& signal)
{
    Table table { .columns = { "t" }, .values = {} };
    for (std::size_t c = 1; c <= signal.channels.size(); ++c)
        table.columns.push_back ("channel " + std::to_string (c));
    const auto rows = signal.channels.empty() ? 0 : signal.channels.front().size();
    table.values.reserve (rows * table.columns.size());
    for (std::size_t i = 0; i < rows; ++i)
    {
        table.values.push_back (static_cast<double> (i) / signal.rate_hz);
        for (const auto& channel : signal.channels)
            table.values.push_back (channel[i]);
    }
    return table;
}

std::string bareName (const std::string& column)
{
    auto name = column;
    if (const auto unit = writtenUnit (column); ! unit.empty()) name = column.substr (0, column.rfind (unit) - 1);
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
            addToList (columns, column);
        return Message::error ("fit/column", file,
                               "there is no column " + quote (is_named ? chosen->second : wanted.role) + "; there are " + columns,
                               "name the column " + quote (wanted.role) + " (" + wanted.about + "), or say which one it is: --column " + wanted.role + "=NAME"
                                   + (wanted.role == "t" ? "; if the rows have no times, give their rate: --rate HZ" : ""));
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
    constexpr double largest = 1e30;   // beyond it, squares in a fit would overflow
    std::vector<double> values;
    for (std::size_t r = 0; r < table.rows(); ++r)
    {
        const auto value = table.at (r, *found), scaled = factor * value;
        if (std::isfinite (value) && ! (std::abs (scaled) <= largest))
            return Message::error ("fit/range", file,
                                   "row " + std::to_string (r + 1) + " of the column " + quote (name) + " is " + roundedText (value, 3)
                                       + ", which no sensor measures",
                                   "correct the row, or check the unit of the column");
        values.push_back (scaled);
    }
    return values;
}

}   // namespace tactus::host
