// SPDX-License-Identifier: MIT
#include "json_writer.hpp"

#include "utf8.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace tactus
{
namespace
{
constexpr std::size_t widest_line = 120;
constexpr std::size_t step = 2;

bool isContainer (const Json& value) { return (value.is_object() || value.is_array()) && ! value.empty(); }

/// Text that did not come from a file may contain anything. Bytes that are not UTF-8 are replaced, because JSON is UTF-8.
void appendText (std::string& out, std::string_view text)
{
    static constexpr std::string_view names = "\"\\bfnrt", meanings = "\"\\\b\f\n\r\t", hex = "0123456789abcdef";
    out += '"';
    while (! text.empty())
    {
        const auto size = std::max (characterSize (text), std::size_t { 1 });
        const auto c = static_cast<unsigned char> (text.front());
        if (const auto which = meanings.find (text.front()); which != std::string_view::npos)
            out.append ({ '\\', names[which] });
        else if (c < 0x20)
            out.append ("\\u00").append ({ hex[c >> 4u], hex[c & 15u] });
        else if (characterSize (text) == 0)
            out += "\xEF\xBF\xBD";
        else
            out += text.substr (0, size);
        text.remove_prefix (size);
    }
    out += '"';
}

/// Plain digits from 0.0001 up to 1e15, below which doubles hold every integer; an exponent outside that range. JSON has no nan and no inf.
std::string shortestNumber (double value)
{
    if (! std::isfinite (value)) return "null";
    constexpr double least = 1e-4, most = 1e15;
    const double size = std::abs (value);
    const bool plain = value == 0.0 || (size >= least && size < most);
    char digits[40];
    const auto end = std::to_chars (std::begin (digits), std::end (digits), value, plain ? std::chars_format::fixed : std::chars_format::scientific).ptr;
    std::string text (digits, end);
    return plain && text.find ('.') == std::string::npos ? text + ".0" : text;
}

void appendScalar (std::string& out, const Json& value)
{
    if (value.is_string())
        appendText (out, value.asString());
    else if (value.is_number_float())
        out += shortestNumber (value.get<double>());
    else if (value.is_number_unsigned())
        out += std::to_string (value.get<std::uint64_t>());
    else if (value.is_number())
        out += std::to_string (value.get<std::int64_t>());
    else if (value.is_boolean())
        out += value.get<bool>() ? "true" : "false";
    else
        out += value.is_object() ? "{}" : value.is_array() ? "[]"
                                                           : "null";
}

std::string scalarText (const Json& value)
{
    if (value.is_number_float()) return jsonNumber (value.get<double>());
    std::string text;
    appendScalar (text, value);
    return text;
}

std::string scalarText (const std::string& key)
{
    std::string text;
    appendText (text, key);
    return text;
}

/// For programs: each entry on a line, or everything on one line if `per_level` is negative.
void dumpTo (std::string& out, const Json& value, int per_level, int indent)
{
    if (! isContainer (value)) return appendScalar (out, value);
    const auto newLine = [&] (int columns) {
        if (per_level >= 0) out.append (1, '\n').append (static_cast<std::size_t> (columns), ' ');
    };
    bool first = true;
    const auto begin = [&] {
        if (! std::exchange (first, false)) out += ',';
        newLine (indent + per_level);
    };
    out += value.is_array() ? '[' : '{';
    if (value.is_array())
        for (const auto& element : value.asArray())
        {
            begin();
            dumpTo (out, element, per_level, indent + per_level);
        }
    else
        for (const auto& [key, member] : value.asObject())
        {
            begin();
            appendText (out, key);
            out += per_level >= 0 ? ": " : ":";
            dumpTo (out, member, per_level, indent + per_level);
        }
    newLine (indent);
    out += value.is_array() ? ']' : '}';
}

class Writer
{
public:
    explicit Writer (std::span<const std::string_view> keys) : one_a_line (keys) {}

    /// Writes a value after its indentation and key. `tail` more characters (a comma) must fit after it.
    void value (const Json& v, std::size_t indent, bool broken, std::size_t tail)
    {
        if (! isContainer (v))
            out += scalarText (v);
        else if (broken || ! onOneLine (v, tail))
            onLines (v, indent);
    }

    std::string out;

private:
    bool isBroken (std::string_view key) const { return std::ranges::find (one_a_line, key) != one_a_line.end(); }
    std::size_t column() const { return out.size() - line_start; }

    void newLine (std::size_t indent)
    {
        out += '\n';
        line_start = out.size();
        out.append (indent, ' ');
    }

    bool onOneLine (const Json& v, std::size_t tail)
    {
        const auto before = out.size();
        if (inlined (v) && column() + tail <= widest_line) return true;
        out.resize (before);
        return false;
    }

    /// Stops as soon as the line is too long, so a failed attempt costs no more than a line.
    bool inlined (const Json& v)
    {
        if (! isContainer (v))
        {
            out += scalarText (v);
            return column() <= widest_line;
        }
        bool first = true;
        const auto separate = [&] {
            if (! first) out += ", ";
            first = false;
        };
        if (v.is_array())
        {
            out += '[';
            for (const auto& element : v)
            {
                separate();
                if (! inlined (element)) return false;
            }
            out += ']';
        }
        else
        {
            out += "{ ";
            for (const auto& [key, member] : v.asObject())
            {
                if (isContainer (member) && isBroken (key)) return false;
                separate();
                out += scalarText (key) + ": ";
                if (! inlined (member)) return false;
            }
            out += " }";
        }
        return column() <= widest_line;
    }

    void onLines (const Json& v, std::size_t indent)
    {
        const bool list = v.is_array();
        const bool numbers = list && std::ranges::all_of (v, [] (const Json& e) { return e.is_number(); });
        const auto inner = indent + step;
        auto left = v.size();
        out += list ? '[' : '{';
        if (numbers)
            packed (v, inner);
        else if (list)
            for (const auto& element : v)
            {
                newLine (inner);
                value (element, inner, false, 1);
                if (--left > 0) out += ',';
            }
        else
            for (const auto& [key, member] : v.asObject())
            {
                newLine (inner);
                out += scalarText (key) + ": ";
                value (member, inner, isBroken (key), 1);
                if (--left > 0) out += ',';
            }
        newLine (indent);
        out += list ? ']' : '}';
    }

    /// Writes as many numbers per line as fit.
    void packed (const Json& numbers, std::size_t indent)
    {
        newLine (indent);
        bool first = true;
        auto left = numbers.size();
        for (const auto& number : numbers)
        {
            const auto text = scalarText (number) + (--left > 0 ? "," : "");
            if (! first && column() + 1 + text.size() > widest_line)
                newLine (indent);
            else if (! first)
                out += ' ';
            out += text;
            first = false;
        }
    }

    std::span<const std::string_view> one_a_line;
    std::size_t line_start = 0;
};
}   // namespace

std::string writeJson (const Json& json, std::span<const std::string_view> one_a_line)
{
    Writer writer (one_a_line);
    writer.value (json, 0, true, 0);
    return writer.out + '\n';
}

std::string jsonNumber (double value)
{
    auto text = shortestNumber (value);
    auto e = text.find ('e') + 1;
    if (e == 0) return text;
    // "1e-05" and "1e+22" are written 1e-5 and 1e22.
    if (text[e] == '+')
        text.erase (e, 1);
    else
        ++e;
    while (text[e] == '0')
        text.erase (e, 1);
    return text;
}

std::string Json::dump (int indent) const
{
    std::string out;
    dumpTo (out, *this, indent, 0);
    return out;
}

}   // namespace tactus
