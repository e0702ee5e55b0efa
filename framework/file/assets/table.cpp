// SPDX-License-Identifier: MIT
#include "table.hpp"
#include "lines.hpp"

#include <tactus/file/separator.hpp>
#include <tactus/text/as_utf8.hpp>
#include <tactus/text/budget.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace tactus::readers
{

namespace
{
constexpr std::string_view spaces = " \t";

std::string_view trim (std::string_view text)
{
    text.remove_prefix (std::min (text.find_first_not_of (spaces), text.size()));
    return text.substr (0, text.find_last_not_of (spaces) + 1);
}

/// Removes a field from the front of a line.
std::string_view takeField (std::string_view& line, char separator)
{
    if (separator == ' ') return takeWord (line);
    const auto end = std::min (line.find (separator), line.size());
    const auto field = line.substr (0, end);
    line.remove_prefix (std::min (end + 1, line.size()));
    return trim (field);
}

class Reader
{
public:
    Reader (std::string_view text, std::string_view name_) : lines (text), name (name_) {}

    Result<Grid> read()
    {
        while (const auto line = lines.next())
        {
            if (line->find ('\0') != std::string_view::npos) return fail ("table/binary", "there is a NUL byte", "check that the file is text");
            const auto said = trim (*line);
            if (said.empty() || said[0] == '#' || said[0] == '%') continue;
            if (auto taken = takeRow (said); ! taken) return taken.error();
        }
        if (grid.rows == 0) return fail ("table/empty", "no line starts with a number", "save it as text, with numbers in rows and columns");
        if (auto checked = takeLine(); ! checked) return checked.error();
        return std::move (grid);
    }

private:
    using Checked = Result<>;

    Lines lines;
    std::string_view name;
    Grid grid;
    std::size_t first_row = 0;   // line number of the first row
    char usual = '\0';           // the separator of the first row

    Message fail (std::string id, std::string what, std::string remedy) const
    {
        return failAt (lines.number(), std::move (id), std::move (what), std::move (remedy));
    }

    Message failAt (std::size_t line, std::string id, std::string what, std::string remedy) const
    {
        return Message::error (std::move (id), std::string (name) + ":" + std::to_string (line), std::move (what), std::move (remedy));
    }

    Checked takeRow (std::string_view line)
    {
        const char separator = separatorOf (line, usual);
        while (! line.empty() && line.back() == separator)
            line = trim (line.substr (0, line.size() - 1));

        int columns = 0;
        while (! line.empty())
        {
            const auto field = takeField (line, separator);
            const auto value = numberIn<double> (separator == ',' ? std::string (field) : withPoint (field));
            if (! value && columns == 0 && grid.rows == 0) return {};   // a header line
            if (! value || ! std::isfinite (*value))
                return fail (
                    "table/not_a_number", field.empty() ? "a number is missing" : quote (field) + " is not a finite number",
                    field.find (',') == std::string_view::npos ? "fill in missing numbers, and remove other text" : "write decimal points instead of commas");
            if (const auto numbers = static_cast<double> (grid.values.size()) + 1.0; numbers > budgets().numbers)
            {
                auto over = overBudget ("table/too_large", &Budgets::numbers, "it", numbers, "save a part of it, or every second row and column");
                return fail (std::move (over.id), std::move (over.text), std::move (over.remedy));
            }
            grid.values.push_back (*value);
            ++columns;
        }

        if (columns == 0 && grid.rows == 0) return {};   // the line has only separators
        if (grid.rows == 0)
        {
            grid.columns = columns;
            first_row = lines.number();
            usual = separator;
        }
        if (columns != grid.columns)
            return fail ("table/ragged_row",
                         "the row has " + std::to_string (columns) + " numbers, but the first row (line " + std::to_string (first_row) + ") has "
                             + std::to_string (grid.columns),
                         "give every row the same number of columns");
        ++grid.rows;
        return {};
    }

    /// The power of ten of the last written digit of the positions, so that all positions are multiples of it; 0 if it is below 1e-9.
    double lastDigit() const
    {
        constexpr double rounding = 1e-6;
        for (double digit = 1e3; digit > 0.5e-9; digit *= 0.1)
        {
            bool all = true;
            for (int i = 0; all && i < grid.rows; ++i)
                all = std::abs (grid (i, 0) / digit - std::round (grid (i, 0) / digit)) < rounding;
            if (all) return digit;
        }
        return 0.0;
    }

    /// Converts two columns, positions and heights, to one row of heights.
    Checked takeLine()
    {
        if (grid.columns != 2 || grid.rows < 3) return {};
        for (int i = 1; i < grid.rows; ++i)
            if (! (grid (i, 0) > grid (i - 1, 0))) return {};   // not positions, so both columns are heights

        const double start = grid (0, 0), step = (grid (grid.rows - 1, 0) - start) / (grid.rows - 1);
        std::vector<double> heights;
        for (int i = 0; i < grid.rows; ++i)
        {
            if (! (std::abs (grid (i, 0) - (start + i * step)) < step))
                return failAt (first_row, "table/uneven",
                               "it has positions and heights, but the positions are not evenly spaced: no. " + std::to_string (i + 1) + " is "
                                   + numberText (grid (i, 0))
                                   + "; with even spacing it would be " + numberText (start + i * step),
                               "interpolate the heights at even positions, and save these");
        }
        // Positions that jitter, as in a recording, are not even: the heights are interpolated between them.
        // Even positions stay even if they are rounded when they are written.
        const double exact = std::max (1e-6 * step, 0.501 * lastDigit());
        for (int i = 0, next = 1; i < grid.rows; ++i)
        {
            const double x = start + i * step;
            if (std::abs (grid (i, 0) - x) <= exact)
            {
                heights.push_back (grid (i, 1));
                continue;
            }
            while (next + 1 < grid.rows && grid (next, 0) < x)
                ++next;
            const double share = (x - grid (next - 1, 0)) / (grid (next, 0) - grid (next - 1, 0));
            heights.push_back (std::lerp (grid (next - 1, 1), grid (next, 1), std::clamp (share, 0.0, 1.0)));
        }
        grid = { .rows = 1, .columns = grid.rows, .values = std::move (heights) };
        return {};
    }
};
}   // namespace

Result<Grid> readGrid (std::string_view bytes, std::string_view name)
{
    const auto text = asUtf8 (bytes);
    return Reader (text, name).read();
}

}   // namespace tactus::readers
