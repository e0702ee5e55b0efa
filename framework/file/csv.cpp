// SPDX-License-Identifier: MIT
#include "csv.hpp"
#include "separator.hpp"
#include "text_file.hpp"

#include <tactus/kit/at.hpp>
#include <tactus/text/as_utf8.hpp>
#include <tactus/text/budget.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/read_number.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

namespace tactus
{

namespace
{
/// Longer than any line of a real table, so it tells binary files from tables.
constexpr std::size_t longest_line = std::size_t { 512 } * 1024;

/// Rows are written once there are this many bytes of them.
constexpr std::size_t bytes_per_write = std::size_t { 64 } * 1024;

constexpr std::string_view spaces = " \t";

struct Field
{
    std::string_view text;    // text of the field, without surrounding spaces and quotes
    std::size_t column = 1;   // column of the first byte of the field
};

std::string_view trim (std::string_view text)
{
    const auto first = text.find_first_not_of (spaces);
    return first == std::string_view::npos ? std::string_view {} : text.substr (first, text.find_last_not_of (spaces) - first + 1);
}

std::string withoutDoubledQuotes (std::string_view text)
{
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i)
    {
        plain += text[i];
        if (text[i] == '"')
            ++i;
    }
    return plain;
}

class Parser
{
public:
    Parser (std::string csv, std::string_view csv_name) : whole (std::move (csv)), rest (whole), name (csv_name)
    {
        if (rest.starts_with ("\xEF\xBB\xBF"))
            rest.remove_prefix (3);
    }

    Result<Table> parse()
    {
        if (rest.find_first_not_of (" \t\r\n") == std::string_view::npos)
            return Message::error ("csv/empty", name, "the file is empty", "write a row of column names, then rows of numbers");

        separator = separatorOf (rest.substr (0, rest.find_first_of ("\r\n")));
        if (separator == ' ') separator = ',';   // one column; its name may have spaces
        auto parsed = nextLine();
        if (parsed)
            parsed = readHeader();

        while (parsed && rest.find_first_not_of (" \t\r\n") != std::string_view::npos)
        {
            parsed = nextLine();
            if (parsed)
                parsed = readRow();
        }

        if (! parsed)
            return parsed.error();
        return std::move (table);
    }

private:
    /// An error in the current line. Columns count bytes from 1.
    Message fail (std::string id, std::size_t column, std::string what, std::string remedy) const
    {
        return Message::error (std::move (id), name + ":" + std::to_string (line_number) + ":" + std::to_string (column), std::move (what), std::move (remedy));
    }

    std::string_view separatorInWords() const { return separator == ',' ? "comma" : separator == ';' ? "semicolon"
                                                                                                     : "tab"; }

    std::string numberText (std::string_view field) const { return separator == ',' ? std::string (field) : withPoint (field); }

    Result<> nextLine()
    {
        const auto end = rest.find_first_of ("\r\n");
        const auto line = rest.substr (0, end);
        rest.remove_prefix (line.size());
        if (! rest.empty())
            rest.remove_prefix (rest.starts_with ("\r\n") ? 2 : 1);
        ++line_number;

        if (line.size() > longest_line)
            return fail ("csv/line_too_long", longest_line + 1,
                         "the line has " + std::to_string (line.size()) + " bytes, more than " + std::to_string (longest_line),
                         "check that the file is a table with one row per line");
        if (const auto nul = line.find ('\0'); nul != std::string_view::npos)
            return fail ("csv/nul_byte", nul + 1, "there is a NUL byte",
                         "check that the file is text, and save it as UTF-8");
        if (trim (line).empty())
            return fail ("csv/blank_line", 1, "the line is blank", "remove the line; blank lines are allowed only at the end");

        return splitLine (line);
    }

    Result<> splitLine (std::string_view line)
    {
        fields.clear();

        for (std::size_t at = 0;; ++at)   // at: the position after the separator
        {
            at = std::min (line.find_first_not_of (separator == '\t' ? " " : spaces, at), line.size());

            if (at < line.size() && line[at] == '"')
            {
                const auto close = closingQuote (line, at);
                if (close == std::string_view::npos)
                    return fail ("csv/broken_quote", at + 1, "the double quote is not closed on this line",
                                 "add the closing quote, or remove this one");

                fields.push_back ({ .text = trim (line.substr (at + 1, close - at - 1)), .column = at + 1 });
                at = std::min (line.find_first_not_of (separator == '\t' ? " " : spaces, close + 1), line.size());
                if (at < line.size() && line[at] != separator)
                    return fail ("csv/broken_quote", at + 1, "there is text after a closing double quote",
                                 "put a " + std::string (separatorInWords()) + " after the closing quote, or write \"\" for a quote inside quotes");
            }
            else
            {
                const auto comma = std::min (line.find (separator, at), line.size());
                fields.push_back ({ .text = trim (line.substr (at, comma - at)), .column = at + 1 });
                at = comma;
            }

            if (at == line.size())
                return {};
        }
    }

    static std::size_t closingQuote (std::string_view line, std::size_t open)
    {
        auto close = line.find ('"', open + 1);
        while (close != std::string_view::npos && close + 1 < line.size() && line[close + 1] == '"')
            close = line.find ('"', close + 2);
        return close;
    }

    bool isNumber (const Field& field) { return wholeNumber (numberText (field.text)).has_value(); }

    static std::string inColumn (std::string_view column, std::string_view text, const char* what)
    {
        return quote (text) + " in column " + quote (column) + " " + what;
    }

    Result<> readHeader()
    {
        if (std::ranges::all_of (fields, [&] (const Field& f) { return isNumber (f); }))
            return fail ("csv/no_header", 1, "the first row holds numbers", "put a row of column names above it");

        std::set<std::string> seen;
        for (const auto& field : fields)
        {
            if (field.text.empty())
                return fail ("csv/empty_column_name", field.column,
                             "column " + std::to_string (table.columns.size() + 1) + " has no name",
                             "name the column, or remove the extra comma");

            table.columns.push_back (withoutDoubledQuotes (field.text));
            if (! seen.insert (table.columns.back()).second)
                return fail ("csv/duplicate_column", field.column, "there are two columns " + quote (table.columns.back()),
                             "give each column a different name");
        }
        return {};
    }

    Result<> readRow()
    {
        if (fields.size() != table.columns.size())
        {
            const auto first_too_many = std::min (fields.size() - 1, table.columns.size());
            const bool is_short = fields.size() < table.columns.size();
            return fail ("csv/ragged_row", fields[first_too_many].column,
                         "the row has " + std::to_string (fields.size()) + " fields, but the header has " + std::to_string (table.columns.size()),
                         is_short ? "write nan where a number is missing" : "remove the extra fields; numbers have a decimal point, not a comma");
        }

        if (const auto numbers = static_cast<double> (table.values.size() + fields.size()); numbers > budgets().numbers)
        {
            auto over = overBudget ("csv/too_large", &Budgets::numbers, "the table", numbers, "save a part of it");
            return fail (std::move (over.id), 1, std::move (over.text), std::move (over.remedy));
        }

        for (std::size_t i = 0; i < fields.size(); ++i)
        {
            const auto& [written, column] = fields[i];
            const auto text = numberText (written);
            const auto& name_of_column = table.columns[i];
            if (text.empty())
                return fail ("csv/empty_field", column, "there is no number in column " + quote (name_of_column),
                             "write nan where a number is missing");

            const auto number = readNumber (text);
            if (number.size > 0 && ! number.is_in_range)
                return fail ("csv/out_of_range", column, inColumn (name_of_column, written, "is out of the range of a double"),
                             "write inf or 0 if that is what you mean");
            if (number.size != text.size())
            {
                const bool has_separator = text.find_first_of (";\t") != text.npos;
                return fail ("csv/not_a_number", column, inColumn (name_of_column, written, "is not a number"),
                             has_separator ? "separate the columns by commas" : "write a number like -1.5e-3, without a unit or marks between thousands");
            }

            table.values.push_back (number.value);
        }
        return {};
    }

    std::string whole;
    std::string_view rest;
    std::string name;
    std::size_t line_number = 0;
    char separator = ',';
    std::vector<Field> fields;   // fields of the current line; reused to save allocations
    Table table;
};

Message unreadableTable (std::string_view name, std::string what)
{
    return Message::error ("csv/unreadable", std::string (name), std::move (what), "check the path and the permissions");
}

bool needsQuotes (std::string_view name)
{
    return name.find_first_of (",;\t\"") != std::string_view::npos;
}

std::string quotedForFile (std::string_view name)
{
    std::string quoted = "\"";
    for (const char c : name)
        quoted += c == '"' ? std::string ("\"\"") : std::string (1, c);
    return quoted + "\"";
}
}   // namespace

std::optional<std::size_t> Table::column (std::string_view name) const noexcept
{
    const auto found = std::ranges::find (columns, name);
    if (found == columns.end())
        return std::nullopt;
    return tactus::at (found - columns.begin());
}

Result<Table> readTable (std::string_view text, std::string_view name)
{
    return Parser (asUtf8 (text), name).parse();
}

Result<Table> readTable (std::istream& in, std::string_view name)
{
    const std::string text { std::istreambuf_iterator<char> (in), {} };
    if (in.bad())
        return unreadableTable (name, "reading stopped halfway");
    return readTable (text, name);
}

Result<Table> readTable (const std::filesystem::path& path)
{
    auto text = readFile (path);
    if (text)
    {
        auto table = readTable (*text, path.string());
        constexpr double bytes_per_number = 16.0;
        // If this exceeds the budget, the next file is refused.
        static_cast<void> (chargeReading (table ? bytes_per_number * static_cast<double> (table->values.size()) : 0.0));
        return table;
    }
    auto why = std::move (text).error();
    if (why.id == "file/unreadable")
        return unreadableTable (path.string(), std::move (why.text));
    why.where = path.string();
    return why;
}

TableWriter::TableWriter (AtomicFile opened, std::size_t width) : file (std::move (opened)), columns (width) {}

Result<TableWriter> TableWriter::create (const std::filesystem::path& path, std::span<const std::string> columns, IfKilled if_killed)
{
    std::string header;
    for (const auto& name : columns)
        header += (&name == columns.data() ? "" : ",") + (needsQuotes (name) ? quotedForFile (name) : name);

    // A header that cannot be read back is not written. Reading it back finds its errors and their ids.
    const auto readable = readTable (header, path.string());
    if (! readable)
        return readable.error();
    if (! std::ranges::equal (readable->columns, columns))
        return Message::error ("csv/column_name", path.string(), "a column name contains a line break, or begins or ends with a space",
                               "write the name on one line, without surrounding spaces");

    auto opened = AtomicFile::create (path, if_killed);
    if (! opened)
        return opened.error();

    TableWriter writer (std::move (*opened), columns.size());
    writer.lines = std::move (header) + '\n';
    return writer;
}

Result<> TableWriter::row (std::span<const double> values)
{
    if (values.size() != columns)
        return Message::error ("csv/ragged_row", "the row to write",
                               "it has " + std::to_string (values.size()) + " values, but the header has " + std::to_string (columns) + " columns",
                               "give one value per column");

    for (std::size_t i = 0; i < values.size(); ++i)
    {
        if (i > 0)
            lines += ',';
        lines += numberText (values[i]);
    }
    lines += '\n';
    return lines.size() < bytes_per_write ? Result<> {} : flush();
}

Result<> TableWriter::flush()
{
    errno = 0;
    auto& out = file.stream();
    const bool written = out.write (lines.data(), static_cast<std::streamsize> (lines.size())) && out.flush();
    lines.clear();
    if (! written)
        return file.writeError();
    return {};
}

Result<> TableWriter::commit()
{
    if (auto written = flush(); ! written)
        return written;
    return file.commit();
}

}   // namespace tactus
