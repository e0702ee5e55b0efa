// SPDX-License-Identifier: MIT
#include "relaxed_json.hpp"

#include <tactus/text/is_digit.hpp>

#include <algorithm>

namespace tactus::readers
{

namespace
{
constexpr bool isSpace (char c) noexcept { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
constexpr bool startsWord (char c) noexcept { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$'; }

/// Rewrites relaxed JSON as JSON, token by token. What is left out becomes spaces, so most positions stay; what is put in is remembered.
class Rewriter
{
public:
    explicit Rewriter (std::string_view t) : text (t) { out.reserve (text.size() + text.size() / 16); }

    std::string take()
    {
        if (text.starts_with ("\xEF\xBB\xBF")) copy (3, 0);
        while (at < text.size())
            token();
        return std::move (out);
    }

    std::vector<Habit> habits;

    /// A place in the output, and by how many columns the rest of its line has moved to the right.
    struct Shift
    {
        TextPosition at;
        int total;   // of all lines so far
    };
    std::vector<Shift> shifts;

private:
    char peek (std::size_t ahead = 0) const { return at + ahead < text.size() ? text[at + ahead] : '\0'; }

    void step (char c)
    {
        if (c == '\n')
        {
            ++line;
            column = 1;
        }
        else if ((static_cast<unsigned char> (c) & 0xC0u) != 0x80u)
            ++column;
    }

    /// Copies bytes, and counts them as `columns` columns, unless that is negative.
    void copy (std::size_t bytes, int columns = -1)
    {
        const int before = column;
        for (; bytes > 0 && at < text.size(); --bytes, ++at)
        {
            out += text[at];
            step (text[at]);
        }
        if (columns >= 0) column = before + columns;
    }

    void put (char c)
    {
        out += c;
        shift (1);
        ++column;
    }

    void shift (int by) { shifts.push_back ({ here(), (shifts.empty() ? 0 : shifts.back().total) + by }); }

    /// Replaces bytes by spaces; line ends stay.
    void blank (std::size_t bytes)
    {
        for (; bytes > 0 && at < text.size(); --bytes, ++at)
        {
            if ((static_cast<unsigned char> (text[at]) & 0xC0u) == 0x80u) continue;
            out += isSpace (text[at]) ? text[at] : ' ';
            step (text[at]);
        }
    }

    void note (const char* what, TextPosition where)
    {
        const auto known = std::ranges::find (habits, what, &Habit::what);
        if (known == habits.end())
            habits.push_back ({ what, 1, where });
        else
            ++known->count;
    }
    TextPosition here() const { return { line, column }; }

    void token()
    {
        const char c = peek();
        if (isSpace (c)) return copy (1);
        if (c == '/' && (peek (1) == '/' || peek (1) == '*')) return comment();
        const bool closes = c == '}' || c == ']';
        if (closes && comma != none)
        {
            out[comma] = ' ';
            note ("commas before a closing bracket", comma_place);
        }
        comma = c == ',' && may_close ? out.size() : none;
        if (c == ',') comma_place = here();
        may_close = c != ',' && c != '{' && c != '[' && c != ':';
        if (c == '"' || c == '\'') return quoted (c);
        if (startsWord (c)) return word();
        if (isDigit (c) || c == '-' || c == '+' || c == '.') return number();
        copy (1);
    }

    void comment()
    {
        note ("comments", here());
        if (peek (1) == '/') return blank (std::min (text.find ('\n', at), text.size()) - at);
        const auto end = text.find ("*/", at + 2);
        blank ((end == text.npos ? text.size() : end + 2) - at);
    }

    void quoted (char mark)
    {
        if (mark == '\'') note ("text in single quotes", here());
        replace ('"');
        while (at < text.size() && peek() != mark && peek() != '\n')
        {
            if (mark == '\'' && peek() == '"') put ('\\');
            if (mark == '\'' && peek() == '\\' && peek (1) == '\'')
            {
                ++at;
                shift (-1);
                copy (1);
            }
            else
                copy (peek() == '\\' ? 2 : 1);
        }
        if (peek() == mark && at < text.size()) replace ('"');
    }

    void replace (char by)
    {
        out += by;
        step (text[at]);
        ++at;
    }

    void word()
    {
        std::size_t size = 1;
        while (startsWord (peek (size)) || isDigit (peek (size)))
            ++size;
        std::size_t after = size;
        while (isSpace (peek (after)))
            ++after;
        const bool is_key = peek (after) == ':';
        if (is_key)
        {
            note ("keys without quotation marks", here());
            put ('"');
        }
        copy (size);
        if (is_key) put ('"');
    }

    void number()
    {
        if (peek() == '+')
        {
            note ("plus signs", here());
            blank (1);
        }
        else if (peek() == '-')
            copy (1);
        if (peek() == '.')
        {
            note ("numbers that begin or end with a point", here());
            put ('0');
        }
        while (isDigit (peek()))
            copy (1);
        if (peek() != '.') return exponent();
        const bool bare = ! isDigit (peek (1));
        if (bare) note ("numbers that begin or end with a point", here());
        copy (1);
        if (bare) put ('0');
        while (isDigit (peek()))
            copy (1);
        exponent();
    }

    void exponent()
    {
        if (peek() != 'e' && peek() != 'E') return;
        copy (1);
        if (peek() == '+' || peek() == '-') copy (1);
        while (isDigit (peek()))
            copy (1);
    }

    static constexpr std::size_t none = static_cast<std::size_t> (-1);
    std::string_view text;
    std::string out;
    std::size_t at = 0, comma = none;   // comma: the last one in the output, which is superfluous if a bracket follows
    TextPosition comma_place;
    bool may_close = false;
    int line = 1, column = 1;   // in the output
};

/// Turns a column of the rewritten text into one of the given text.
void moveBack (int line, int& column, const std::vector<Rewriter::Shift>& shifts)
{
    const auto before = [] (const Rewriter::Shift& a, const TextPosition& b) { return a.at.line != b.line ? a.at.line < b.line : a.at.column < b.column; };
    const auto total = [&] (auto shift) { return shift == shifts.begin() ? 0 : (shift - 1)->total; };
    const auto first = std::lower_bound (shifts.begin(), shifts.end(), TextPosition { line, 0 }, before);
    const auto last = std::lower_bound (first, shifts.end(), TextPosition { line, column }, before);
    column -= total (last) - total (first);
}
}   // namespace

RelaxedJson readRelaxedJson (std::string_view text)
{
    RelaxedJson read;
    if (static_cast<double> (text.size()) > budgets().file)   // readJson refuses it
    {
        read.json = readJson (text);
        return read;
    }
    Rewriter rewriter (text);
    const auto plain = rewriter.take();
    read.habits = std::move (rewriter.habits);
    for (auto& habit : read.habits)
        moveBack (habit.first.line, habit.first.column, rewriter.shifts);
    read.json = readJson (plain);
    if (rewriter.shifts.empty()) return read;
    read.json.positions.changeAll ([&] (TextPosition& p) { moveBack (p.line, p.column, rewriter.shifts); });
    for (auto& m : read.json.messages)
        moveBack (m.line, m.column, rewriter.shifts);
    return read;
}

}   // namespace tactus::readers
