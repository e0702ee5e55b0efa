// SPDX-License-Identifier: MIT
#include "axis.hpp"

#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace tactus::host
{

namespace
{
constexpr double largest = 1e300;
constexpr double smallest = 1e-300;   // smaller values are treated as zero

struct Prefix
{
    std::string_view text;
    double factor;
};
constexpr std::array prefixes {
    Prefix { "G", 1e9 },
    Prefix { "M", 1e6 },
    Prefix { "k", 1e3 },
    Prefix { "", 1.0 },
    Prefix { "m", 1e-3 },
    Prefix { "µ", 1e-6 },
    Prefix { "n", 1e-9 },
};

/// A unit that takes an SI prefix, and how many such units make one SI unit.
struct Base
{
    std::string unit;
    double per_si_unit;
    double largest_factor;
};

/// Empty for units that take no prefix: 1/m, m2 (a mm2 is not a thousandth of an m2), ratios.
std::optional<Base> baseOf (std::string_view unit)
{
    const auto first = unit.substr (0, unit.find_first_of ("*/"));
    const auto is = [&] (std::string_view symbol) { return first == symbol; };

    if (is ("kg"))
        return Base { std::string (unit.substr (1)), 1e3, 1e3 };
    if (is ("m") || is ("s") || is ("rad"))
        return Base { std::string (unit), 1.0, 1.0 };   // ks and krad are unusual
    if (is ("N") || is ("Hz") || is ("J") || is ("W") || is ("Pa") || is ("V") || is ("A"))
        return Base { std::string (unit), 1.0, 1e9 };
    return std::nullopt;
}

std::string superscript (std::string_view digits)
{
    constexpr std::array<std::string_view, 10> raised { "⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹" };

    std::string text;
    for (const char c : digits)
        text += c == '-' ? std::string_view ("⁻") : raised[static_cast<std::size_t> (c - '0')];
    return text;
}

/// Formatted for print: N*s/m2 becomes N·s/m².
std::string typeset (std::string_view unit)
{
    std::string text;
    for (std::size_t i = 0; i < unit.size(); ++i)
    {
        const bool is_power = i > 0 && unit[i] >= '0' && unit[i] <= '9' && unit[i - 1] != '/' && unit[i - 1] != '*';
        if (unit[i] == '*')
            text += "·";
        else if (is_power)
            text += superscript (unit.substr (i, 1));
        else
            text += unit[i];
    }
    return text;
}

std::string withTrueMinus (std::string text)
{
    if (text.starts_with ('-'))
        text.replace (0, 1, "−");
    return text;
}

std::string inWords (double number)
{
    return withTrueMinus (roundedText (number, 12));
}

double magnitude (const Extent& extent) noexcept
{
    return extent.isEmpty() ? 0.0 : std::max (std::abs (extent.low), std::abs (extent.high));
}

bool isConstant (const Extent& extent) noexcept
{
    return magnitude (extent) < smallest || extent.size() <= 1e-9 * magnitude (extent);
}

struct ScaledUnit
{
    double factor = 1.0;
    std::string text;
};

/// The unit that makes a value of this size a short number.
ScaledUnit unitFor (double size, std::string_view unit)
{
    constexpr double too_long = 1e5, too_short = 1e-2;

    if (const auto base = baseOf (unit))
    {
        const double count = size * base->per_si_unit;
        for (const auto& [prefix, factor] : prefixes)
        {
            // 0.3 mm rather than 300 µm, but 300 Hz rather than 0.3 kHz.
            const bool fits = factor <= base->largest_factor && count / factor >= (factor > 1.0 ? 1.0 : 0.1);
            if (fits && count / factor < too_long)
                return { factor / base->per_si_unit, std::string (prefix) + typeset (base->unit) };
        }
    }

    const auto plain = unit == "1" ? std::string {} : typeset (unit);
    if (size < smallest || (size >= too_short && size < too_long))
        return { 1.0, plain };

    const int exponent = 3 * static_cast<int> (std::floor (std::log10 (size) / 3.0));
    const auto power = "×10" + superscript (std::to_string (exponent));
    return { std::pow (10.0, exponent), plain.empty() ? power : power + " " + plain };
}

/// The finest of the steps 1, 2, 5, 10, … that gives no more ticks than requested.
double stepFor (const Extent& extent, int at_most) noexcept
{
    const double wanted = extent.size() / std::max (1, at_most);
    const double power = std::pow (10.0, std::floor (std::log10 (wanted)));

    double step = 10.0 * power;
    for (const double multiple : { 5.0, 2.0, 1.0 })
        if (multiple * power >= wanted * (1.0 - 1e-9))
            step = multiple * power;
    return step;
}
}   // namespace

bool isPlottable (double value) noexcept
{
    return std::abs (value) < largest;   // false for nan
}

void Extent::include (double value) noexcept
{
    low = std::min (low, value);
    high = std::max (high, value);
}

void Extent::include (const Extent& other) noexcept
{
    low = std::min (low, other.low);
    high = std::max (high, other.high);
}

Extent widened (const Extent& extent, double fraction) noexcept
{
    if (extent.isEmpty() || magnitude (extent) < smallest)
        return { -1.0, 1.0 };

    const double air = isConstant (extent) ? 0.1 * magnitude (extent) : fraction * extent.size();
    return { extent.low - air, extent.high + air };
}

Extent roundedOutwards (const Extent& extent, int ticks) noexcept
{
    constexpr double near = 0.02;   // as a fraction of the extent

    const double step = stepFor (extent, ticks);
    const Extent beyond { std::floor (extent.low / step) * step, std::ceil (extent.high / step) * step };
    return { extent.low - beyond.low < near * extent.size() ? beyond.low : extent.low,
             beyond.high - extent.high < near * extent.size() ? beyond.high : extent.high };
}

AxisScale axisScale (const Extent& values, std::string_view name, std::string_view unit)
{
    AxisScale scale;
    scale.label = name;
    double size = magnitude (values);

    if (! isConstant (values) && values.size() < 1e-4 * size)
    {
        // Ticks such as 1.200003 and 1.200004 are hard to read, so the next lower round number is subtracted.
        const double step = std::pow (10.0, std::ceil (std::log10 (values.size())));
        scale.origin = std::floor (values.low / step) * step;
        size = std::max (std::abs (values.low - scale.origin), std::abs (values.high - scale.origin));

        const auto origin_unit = unitFor (std::abs (scale.origin), unit);
        scale.label += (scale.origin < 0.0 ? " + " : " − ") + inWords (std::abs (scale.origin) / origin_unit.factor);
        if (! origin_unit.text.empty())
            scale.label += " " + origin_unit.text;
    }

    const auto chosen = unitFor (size, unit);
    scale.unit = chosen.factor;
    if (! chosen.text.empty())
        scale.label += (scale.label.empty() ? "(" : " (") + chosen.text + ")";
    return scale;
}

std::vector<Tick> ticksWithin (const Extent& extent, int at_most, double least_step)
{
    const double step = std::max (stepFor (extent, at_most), least_step);
    const int decimals = std::max (0, -static_cast<int> (std::floor (std::log10 (step) + 1e-9)));
    constexpr double slack = 1e-9;   // a tick at the very end counts as inside

    std::vector<Tick> ticks;
    const auto first = static_cast<long long> (std::ceil (extent.low / step - slack));
    const auto last = static_cast<long long> (std::floor (extent.high / step + slack));
    for (auto k = first; k <= last; ++k)
    {
        const double at = static_cast<double> (k) * step;   // k = 0 gives 0, never -0
        std::array<char, 400> text;
        const auto end = std::to_chars (text.data(), text.data() + text.size(), at, std::chars_format::fixed, decimals).ptr;
        ticks.push_back ({ .at = at, .text = withTrueMinus ({ text.data(), end }) });
    }
    return ticks;
}

}   // namespace tactus::host
