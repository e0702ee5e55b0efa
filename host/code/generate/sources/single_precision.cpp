// SPDX-License-Identifier: MIT
#include "single_precision.hpp"
#include "adapted_source.hpp"
#include "sources.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr std::pair<std::string_view, std::string_view> names[] {
    { "double", "float" },
    { "Vector2d", "Vector2f" },
    { "Vector3d", "Vector3f" },
    { "Matrix2d", "Matrix2f" },
    { "Matrix3d", "Matrix3f" },
    { "Quaterniond", "Quaternionf" },
    { "__SSE2__", "TACTUS_NO_DOUBLE" },
};

bool isPart (char c) { return std::isalnum (static_cast<unsigned char> (c)) != 0 || c == '_'; }
bool isDigit (char c) { return c >= '0' && c <= '9'; }

/// Reads C++ code piece by piece.
class Translation
{
public:
    Translation (std::string_view text, std::vector<std::string>* list) : code (text), outside (list) {}

    std::string run()
    {
        while (at < code.size())
            piece();
        return std::move (done);
    }

private:
    std::string_view code;
    std::vector<std::string>* outside;
    std::string done;
    std::size_t at = 0;

    char next (std::size_t by = 0) const { return at + by < code.size() ? code[at + by] : '\0'; }

    void copyTo (std::size_t end)
    {
        end = std::min (end, code.size());
        done += code.substr (at, end - at);
        at = end;
    }

    std::size_t endOf (std::string_view mark, std::size_t from) const
    {
        const auto found = code.find (mark, from);
        return found == code.npos ? code.size() : found + mark.size();
    }

    void piece()
    {
        if (code.substr (at).starts_with ("//") || code.substr (at).starts_with ("#include"))
            copyTo (endOf ("\n", at));
        else if (code.substr (at).starts_with ("/*"))
            copyTo (endOf ("*/", at));
        else if (code.substr (at).starts_with ("R\"("))
            copyTo (endOf (")\"", at));
        else if (next() == '"' || next() == '\'')
            quoted (next());
        else if (isDigit (next()) || (next() == '.' && isDigit (next (1))))
            number();
        else if (isPart (next()))
            name();
        else
            copyTo (at + 1);
    }

    void quoted (char mark)
    {
        auto end = at + 1;
        while (end < code.size() && code[end] != mark)
            end += code[end] == '\\' ? 2 : 1;
        copyTo (end + 1);
    }

    void name()
    {
        auto end = at;
        while (end < code.size() && isPart (code[end]))
            ++end;
        const auto word = code.substr (at, end - at);
        at = end;
        const auto* const other = std::ranges::find (names, word, &std::pair<std::string_view, std::string_view>::first);
        done += other != std::end (names) ? other->second : word;
        if (word != "numbers" || ! code.substr (at).starts_with ("::")) return;
        copyTo (at + 2);
        end = at;
        while (end < code.size() && isPart (code[end]))
            ++end;
        copyTo (end);
        done += "_v<float>";
    }

    void number()
    {
        auto end = at;
        const bool is_hex = next() == '0' && (next (1) == 'x' || next (1) == 'X');
        bool has_power = false, has_point = false;
        for (; end < code.size(); ++end)
        {
            const char c = code[end], small = static_cast<char> (c | 0x20), before = end > at ? static_cast<char> (code[end - 1] | 0x20) : '\0';
            const bool is_power = small == (is_hex ? 'p' : 'e'), is_sign = (c == '+' || c == '-') && before == (is_hex ? 'p' : 'e');
            has_power = has_power || is_power;
            has_point = has_point || c == '.';
            if (! isPart (c) && c != '.' && c != '\'' && ! is_sign) break;
        }
        const auto text = code.substr (at, end - at);
        at = end;
        const bool has_suffix = ! is_hex && (text.back() == 'f' || text.back() == 'F');
        done += (has_power || has_point) && ! has_suffix && (! is_hex || (text.back() | 0x20) != 'f') ? withinRange (text) + "f" : std::string (text);
    }

    std::string withinRange (std::string_view given)
    {
        using Float = std::numeric_limits<float>;
        std::string text (given);
        std::erase (text, '\'');
        const double size = std::abs (std::strtod (text.c_str(), nullptr));
        if (size == 0.0 || (size >= static_cast<double> (Float::min()) && size <= static_cast<double> (Float::max()))) return std::string (given);
        if (outside != nullptr)
        {
            outside->push_back (text);
            return "0.0";
        }
        constexpr int range = 8;   // how many times longer the exponents of double are
        return "1e" + std::to_string (static_cast<int> (std::log10 (size)) / range);
    }
};
}   // namespace

std::string inSinglePrecision (std::string_view code, std::vector<std::string>* outside) { return Translation (code, outside).run(); }

namespace
{
constexpr std::string_view own = "tactus/kit/single/";
constexpr std::string_view positions = "tactus/kit/fine.hpp", math_functions = "tactus/kit/math/math.hpp";
}   // namespace

std::set<std::string> inSinglePrecision (const std::set<std::string>& paths)
{
    std::set<std::string> all { std::string (own) + "extended.hpp", std::string (own) + "math.hpp" };
    for (const auto& path : paths)
        if (path == math_functions || ! path.starts_with ("tactus/kit/math/")) all.insert (path);
    return all;
}

std::string adaptedSingle (const std::string& path)
{
    if (path == positions) return std::string (findSource (std::string (own) + "fine.hpp")->text);
    if (path == math_functions) return std::string (findSource (std::string (own) + "math_names.hpp")->text);
    return adaptedSingle (*findSource (path));
}

std::string adaptedSingle (const SourceFile& file) { return file.path.starts_with (own) ? std::string (file.text) : inSinglePrecision (adapted (file)); }

}   // namespace tactus::host
