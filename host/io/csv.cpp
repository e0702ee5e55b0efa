// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/io/csv.hpp>

#include <framework/number_text.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

namespace tactus::host
{

namespace
{
/// No table of ours is wider; a binary file taken for a table is told from one by this.
constexpr std::size_t longest_line = 512 * 1024;

constexpr std::string_view spaces = " \t";

using Checked = tl::expected<void, Error>;

struct Field
{
    std::string_view text;    // without surrounding spaces and quotes
    std::size_t column = 1;   // of its first byte
};

std::string_view trim (std::string_view text)
{
    const auto first = text.find_first_not_of (spaces);
    return first == std::string_view::npos ? std::string_view {} : text.substr (first, text.find_last_not_of (spaces) - first + 1);
}

std::string quote (std::string_view text)
{
    constexpr std::size_t enough = 40;
    std::string quoted = "'";
    quoted += text.substr (0, enough);
    quoted += text.size() > enough ? "…'" : "'";
    return quoted;
}

struct Number
{
    double value = 0.0;
    std::errc problem {};
};

Number parseNumber (std::string_view text)
{
    // from_chars knows no plus sign, but some instruments write one.
    if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+')
        text.remove_prefix (1);

    Number number;
    const auto* const end = text.data() + text.size();
    const auto [stop, problem] = std::from_chars (text.data(), end, number.value);
    number.problem = problem == std::errc {} && stop != end ? std::errc::invalid_argument : problem;
    return number;
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
    Parser (std::string_view csv, std::string_view csv_name) : rest (csv), name (csv_name)
    {
        if (rest.starts_with ("\xEF\xBB\xBF"))
            rest.remove_prefix (3);
    }

    tl::expected<Table, Error> parse()
    {
        if (rest.find_first_not_of (" \t\r\n") == std::string_view::npos)
            return tl::unexpected (Error { .id = "csv/empty",
                                           .where = name,
                                           .what = "there is nothing in it",
                                           .remedy = "write a row of column names, then rows of numbers" });

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
            return tl::unexpected (parsed.error());
        return std::move (table);
    }

private:
    /// Column counts bytes of the current line from 1.
    tl::unexpected<Error> fail (std::string id, std::size_t column, std::string what, std::string remedy) const
    {
        return tl::unexpected (Error { .id = std::move (id),
                                       .where = name + ":" + std::to_string (line_number) + ":" + std::to_string (column),
                                       .what = std::move (what),
                                       .remedy = std::move (remedy) });
    }

    Checked nextLine()
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
                         "check that the file is a table with one row a line");
        if (const auto nul = line.find ('\0'); nul != std::string_view::npos)
            return fail ("csv/nul_byte", nul + 1, "there is a NUL byte",
                         "check that the file is text, and save it as UTF-8");
        if (trim (line).empty())
            return fail ("csv/blank_line", 1, "the line is blank", "remove it; blank lines may only stand at the end");

        return splitLine (line);
    }

    Checked splitLine (std::string_view line)
    {
        fields.clear();

        for (std::size_t at = 0;; ++at)   // at: behind the comma
        {
            at = std::min (line.find_first_not_of (spaces, at), line.size());

            if (at < line.size() && line[at] == '"')
            {
                const auto close = closingQuote (line, at);
                if (close == std::string_view::npos)
                    return fail ("csv/broken_quote", at + 1, "the double quote is not closed on this line",
                                 "close it, or remove it");

                fields.push_back ({ .text = trim (line.substr (at + 1, close - at - 1)), .column = at + 1 });
                at = std::min (line.find_first_not_of (spaces, close + 1), line.size());
                if (at < line.size() && line[at] != ',')
                    return fail ("csv/broken_quote", at + 1, "there is text behind a closing double quote",
                                 "put a comma there, or write \"\" for a quote inside quotes");
            }
            else
            {
                const auto comma = std::min (line.find (',', at), line.size());
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

    static bool isNumber (const Field& field) { return parseNumber (field.text).problem == std::errc {}; }

    static std::string inColumn (std::string_view column, std::string_view text, const char* what)
    {
        return quote (text) + " in column " + quote (column) + " " + what;
    }

    Checked readHeader()
    {
        if (std::ranges::all_of (fields, isNumber))
            return fail ("csv/no_header", 1, "the first row holds numbers", "put a row of column names above it");

        std::set<std::string> seen;
        for (const auto& field : fields)
        {
            if (field.text.empty())
                return fail ("csv/empty_column_name", field.column,
                             "column " + std::to_string (table.columns.size() + 1) + " has no name",
                             "name it, or remove the comma too many");

            table.columns.push_back (withoutDoubledQuotes (field.text));
            if (! seen.insert (table.columns.back()).second)
                return fail ("csv/duplicate_column", field.column, "there are two columns " + quote (table.columns.back()),
                             "give each column a name of its own");
        }
        return {};
    }

    Checked readRow()
    {
        if (fields.size() != table.columns.size())
        {
            const auto first_too_many = std::min (fields.size() - 1, table.columns.size());
            return fail ("csv/ragged_row", fields[first_too_many].column,
                         "the row has " + std::to_string (fields.size()) + " fields, the header " + std::to_string (table.columns.size()),
                         fields.size() < table.columns.size() ? "write nan where a number is missing"
                                                              : "remove what is too much; numbers take a decimal point, not a comma");
        }

        for (std::size_t i = 0; i < fields.size(); ++i)
        {
            const auto& [text, column] = fields[i];
            const auto& name_of_column = table.columns[i];
            if (text.empty())
                return fail ("csv/empty_field", column, "there is no number in column " + quote (name_of_column),
                             "write nan where a number is missing");

            const auto number = parseNumber (text);
            if (number.problem == std::errc::result_out_of_range)
                return fail ("csv/out_of_range", column, inColumn (name_of_column, text, "is beyond what a double holds"),
                             "write inf or 0 if that is meant");
            if (number.problem != std::errc {})
                return fail ("csv/not_a_number", column, inColumn (name_of_column, text, "is not a number"),
                             text.find_first_of (";\t") == std::string_view::npos ? "write a number like -1.5e-3, without a unit"
                                                                                  : "separate the columns by commas");

            table.values.push_back (number.value);
        }
        return {};
    }

    std::string_view rest;
    std::string name;
    std::size_t line_number = 0;
    std::vector<Field> fields;   // of the current line, kept for its memory
    Table table;
};

Error unreadable (std::string_view name, std::string what)
{
    return { .id = "csv/unreadable",
             .where = std::string (name),
             .what = std::move (what),
             .remedy = "check the path and the permissions" };
}

bool needsQuotes (std::string_view name)
{
    return name.find_first_of (",\"") != std::string_view::npos;
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
    return static_cast<std::size_t> (found - columns.begin());
}

tl::expected<Table, Error> readTable (std::string_view text, std::string_view name)
{
    return Parser (text, name).parse();
}

tl::expected<Table, Error> readTable (std::istream& in, std::string_view name)
{
    const std::string text { std::istreambuf_iterator<char> (in), {} };
    if (in.bad())
        return tl::unexpected (unreadable (name, "reading stopped half way"));
    return readTable (text, name);
}

tl::expected<Table, Error> readTable (const std::filesystem::path& path)
{
    std::error_code ignored;
    if (std::filesystem::is_directory (path, ignored))
        return tl::unexpected (unreadable (path.string(), "it is a folder, not a table"));

    if (std::filesystem::exists (path, ignored) && ! std::filesystem::is_regular_file (path, ignored) && ! std::filesystem::is_fifo (path, ignored))
        return tl::unexpected (unreadable (path.string(), "it is no file, and may never end"));

    std::ifstream in (path, std::ios::binary);
    if (! in)
        return tl::unexpected (unreadable (path.string(), "there is no such file, or it may not be read"));
    return readTable (in, path.string());
}

TableWriter::TableWriter (AtomicFile opened, std::size_t width) : file (std::move (opened)), columns (width) {}

tl::expected<TableWriter, Error> TableWriter::create (const std::filesystem::path& path, std::span<const std::string> columns)
{
    std::string header;
    for (const auto& name : columns)
        header += (&name == columns.data() ? "" : ",") + (needsQuotes (name) ? quotedForFile (name) : name);

    // What would not be read back is not written. Reading the header finds its faults, each with its id.
    const auto readable = readTable (header, path.string());
    if (! readable)
        return tl::unexpected (readable.error());
    if (! std::ranges::equal (readable->columns, columns))
        return tl::unexpected (Error { .id = "csv/column_name",
                                       .where = path.string(),
                                       .what = "a column name has a line break, or spaces around it",
                                       .remedy = "write it as words on one line" });

    auto opened = createFile (path);
    if (! opened)
        return tl::unexpected (opened.error());

    TableWriter writer (std::move (*opened), columns.size());
    writer.line = std::move (header);
    if (const auto written = writer.writeLine(); ! written)
        return tl::unexpected (written.error());
    return writer;
}

tl::expected<void, Error> TableWriter::row (std::span<const double> values)
{
    if (values.size() != columns)
        return tl::unexpected (Error { .id = "csv/ragged_row",
                                       .where = "the row to write",
                                       .what = "it has " + std::to_string (values.size()) + " values, the header " + std::to_string (columns),
                                       .remedy = "give one value a column" });

    line.clear();
    for (const double value : values)
    {
        if (! line.empty())
            line += ',';
        line += numberText (value);
    }
    return writeLine();
}

tl::expected<void, Error> TableWriter::commit()
{
    return commitFile (file);
}

tl::expected<void, Error> TableWriter::writeLine()
{
    line += '\n';
    if (! file.stream().write (line.data(), static_cast<std::streamsize> (line.size())))
        return tl::unexpected (writeFailed (file));
    return {};
}

}   // namespace tactus::host
