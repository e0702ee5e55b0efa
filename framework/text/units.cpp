// SPDX-License-Identifier: MIT
#include "units.hpp"

#include "is_digit.hpp"
#include "quote.hpp"
#include "read_number.hpp"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <numbers>

namespace tactus
{
namespace
{
struct Known
{
    std::string_view symbol;
    Dimension dimension;
    int decimals = 0;       ///< decimal exponent relative to SI
    double factor = 1.0;    ///< factor to SI, apart from the power of ten
    bool prefixed = true;   ///< may carry a prefix
    bool angle = false;
};

constexpr Known known[] = {
    { "m", { 1, 0, 0 } },
    { "g", { 0, 1, 0 }, -3 },
    { "s", { 0, 0, 1 } },
    { "N", { 1, 1, -2 } },
    { "J", { 2, 1, -2 } },
    { "W", { 2, 1, -3 } },
    { "Pa", { -1, 1, -2 } },
    { "Hz", { 0, 0, -1 } },
    { "rad", {}, 0, 1.0, true, true },
    { "deg", {}, 0, std::numbers::pi / 180.0, false, true },
    { "%", {}, -2, 1.0, false },
};

struct Prefix
{
    std::string_view symbol;
    int decimals;
};

constexpr Prefix prefixes[] = {
    { "p", -12 },
    { "n", -9 },
    { "u", -6 },
    { "\u00B5", -6 },   // micro sign
    { "\u03BC", -6 },   // Greek mu, which looks the same
    { "m", -3 },
    { "c", -2 },
    { "d", -1 },
    { "k", 3 },
    { "M", 6 },
    { "G", 9 },
};

constexpr int highest_power = 12;   // of a single factor and of the whole unit: far beyond physics, well within a signed char

/// Looks a unit up by its symbol and applies its prefix.
std::optional<Known> lookUp (std::string_view symbol)
{
    for (const auto& unit : known)
        if (symbol == unit.symbol) return unit;
    for (const auto& prefix : prefixes)
        if (symbol.starts_with (prefix.symbol))
            for (auto unit : known)
                if (unit.prefixed && symbol.substr (prefix.symbol.size()) == unit.symbol)
                {
                    unit.decimals += prefix.decimals;
                    return unit;
                }
    return std::nullopt;
}

std::string unknownUnit (std::string_view symbol)
{
    if (symbol == "dB") return "'dB' is not a unit here; write decibels as a bare number";
    std::string text = "unknown unit " + quote (symbol) + "; the known units are ";
    for (const auto& unit : known)
        text.append (unit.symbol).append (&unit == &known[std::size (known) - 1] ? "" : ", ");
    return text + ", with the prefixes p n u m c d k M G";
}

constexpr bool isBlank (char c) noexcept { return c == ' ' || c == '\t'; }

/// Every character that cannot be part of a unit ends it, so that a message quotes the whole of an unknown unit.
constexpr bool endsUnit (char c) noexcept { return isBlank (c) || isDigit (c) || c == '*' || c == '/' || c == '^' || c == '-' || c == '+'; }

/// The unread rest of the text.
struct Reader
{
    std::string_view text;

    char peek() const { return text.empty() ? '\0' : text.front(); }

    bool skipSpace()
    {
        const auto before = text.size();
        while (isBlank (peek()))
            text.remove_prefix (1);
        return text.size() != before;
    }

    bool take (char c)
    {
        if (text.empty() || text.front() != c) return false;
        text.remove_prefix (1);
        return true;
    }

    /// Takes the symbol of a unit; "" if the text does not continue with one.
    std::string_view symbol()
    {
        std::size_t size = 0;
        while (size < text.size() && ! endsUnit (text[size]))
            ++size;
        const auto taken = text.substr (0, size);
        text.remove_prefix (size);
        return taken;
    }

    /// The power after a unit: 1 if there is none, empty if it is not an integer of a sensible size.
    std::optional<int> power()
    {
        const bool marked = take ('^');
        if (! marked && ! isDigit (peek()) && peek() != '-') return 1;
        int p = 0;
        const auto [end, error] = std::from_chars (text.data(), text.data() + text.size(), p);
        if (error != std::errc {} || std::abs (p) > highest_power) return std::nullopt;
        text.remove_prefix (static_cast<std::size_t> (end - text.data()));
        return p;
    }
};

/// The product of the factors read so far.
struct Product
{
    int m = 0, kg = 0, s = 0, decimals = 0;
    double factor = 1.0;
    bool angular = false;

    void multiply (const Known& unit, int power)
    {
        m += unit.dimension.m * power;
        kg += unit.dimension.kg * power;
        s += unit.dimension.s * power;
        decimals += unit.decimals * power;
        angular = angular || (unit.angle && power != 0);
        if (unit.factor != 1.0) factor *= std::pow (unit.factor, power);
    }

    /// Reads the factors up to the end of the text. Returns what is wrong, or "".
    std::string read (Reader& in)
    {
        bool spaced = in.skipSpace();
        for (bool first = true; ! in.text.empty(); first = false)
        {
            // A slash, a star or a space precedes each factor; before the first one it is optional.
            const bool divide = in.take ('/');
            const bool joined = divide || in.take ('*');
            if (joined) in.skipSpace();
            if (! joined && ! spaced && ! first) return "units side by side; write a *, a / or a space between them";

            const auto symbol = in.symbol();
            if (! symbol.empty())
            {
                const auto unit = lookUp (symbol);
                if (! unit) return unknownUnit (symbol);
                const auto power = in.power();
                if (! power) return "the power of " + quote (symbol) + " must be an integer from -12 to 12";
                multiply (*unit, divide ? -*power : *power);
                if (tooHigh()) return "the powers of the units are higher than in any physical quantity";
            }
            else if (! (in.take ('1') && ! isDigit (in.peek())))   // the 1 of "1/m" is a factor too
                return in.text.empty() ? "a unit is missing at the end" : "a unit is missing before " + quote (in.text);
            spaced = in.skipSpace();
        }
        return {};
    }

    bool tooHigh() const
    {
        return std::abs (m) > highest_power || std::abs (kg) > highest_power || std::abs (s) > highest_power
               || std::abs (decimals) > 300;
    }
};

/// The number with its decimal point shifted. It is parsed again, so that it is rounded once: "0.4 mm" is exactly the double 0.0004.
double shifted (std::string_view digits, double value, int decimals)
{
    if (decimals == 0 || value == 0.0) return value;
    int exponent = 0;
    if (const auto e = digits.find_first_of ("eE"); e != std::string_view::npos)
    {
        auto first = digits.data() + e + 1;
        if (*first == '+') ++first;
        std::from_chars (first, digits.data() + digits.size(), exponent);
        digits = digits.substr (0, e);
    }
    const auto text = std::string (digits) + "e" + std::to_string (exponent + decimals);
    return wholeNumber (text).value_or (std::numeric_limits<double>::infinity());
}
}   // namespace

Result<Measure> parseMeasure (std::string_view text)
{
    const auto wrong = [text] (const std::string& what) { return Message::error ("unit/syntax", {}, quote (text) + ": " + what); };
    constexpr auto too_large = "the number is too large for a double";

    if (text.size() > 200) return wrong ("too long for a number with a unit");

    Reader in { text };
    in.skipSpace();
    if (in.text.empty()) return Message::error ("unit/syntax", {}, "the text is empty; a number with a unit is missing");

    const auto number = readNumber (in.text);
    if (number.size == 0) return wrong ("does not begin with a number; write, for example, '0.4 mm'");
    if (! number.is_in_range) return wrong (too_large);
    double value = number.value;
    if (! std::isfinite (value)) return wrong ("nan and inf are not allowed; write a finite number");
    const auto digits = in.text.substr (0, number.size);
    in.text.remove_prefix (digits.size());
    if (in.peek() == ',') return wrong ("a comma in a number; write a decimal point, for example '0.4 mm'");

    Product product;
    if (const auto problem = product.read (in); ! problem.empty()) return wrong (problem);

    value = shifted (digits, value, product.decimals) * product.factor;
    if (! std::isfinite (value)) return wrong (too_large);
    const auto narrow = [] (int p) { return static_cast<signed char> (p); };
    return Measure { value, { narrow (product.m), narrow (product.kg), narrow (product.s) }, product.angular };
}

std::string symbolOf (Dimension d)
{
    struct Named
    {
        Dimension dimension;
        std::string_view symbol;
    };
    constexpr Named named[] = {
        { { 1, 1, -2 }, "N" },
        { { 2, 1, -2 }, "J" },
        { { 2, 1, -3 }, "W" },
        { { -1, 1, -2 }, "Pa" },
        { { 0, 1, -2 }, "N/m" },
        { { 0, 1, -1 }, "N*s/m" },
        { { -1, 0, 1 }, "s/m" },
    };
    for (const auto& n : named)
        if (d == n.dimension) return std::string (n.symbol);

    struct Base
    {
        std::string_view symbol;
        int power;
    };
    const Base bases[] = { { "kg", d.kg }, { "m", d.m }, { "s", d.s } };
    std::string above, below;
    for (const auto& [symbol, power] : bases)
    {
        if (power == 0) continue;
        auto& part = power > 0 ? above : below;
        if (power < 0)
            part += "/";
        else if (! part.empty())
            part += "*";
        part += symbol;
        if (std::abs (power) != 1) part += std::to_string (std::abs (power));
    }
    return (above.empty() ? "1" : above) + below;
}

}   // namespace tactus
