// SPDX-License-Identifier: GPL-3.0-or-later
#include "with_prefix.hpp"
#include "quantity_text.hpp"

#include <cmath>
#include <cstdio>

namespace tactus::host
{

SiPrefix prefixFor (double value, std::string_view unit) noexcept
{
    static constexpr SiPrefix prefixes[] = { { "k", 1e3 }, { "", 1.0 }, { "m", 1e-3 }, { "u", 1e-6 }, { "n", 1e-9 } };
    const bool takes_one = unit == "m" || unit == "s" || unit == "N" || unit == "J" || unit == "Hz" || unit == "m/s";
    const auto* chosen = &prefixes[1];
    if (! takes_one || value == 0.0 || ! std::isfinite (value)) return *chosen;
    for (const auto& p : prefixes)
    {
        chosen = &p;
        if (std::abs (value) >= 0.9995 * p.factor && (p.factor < 1e3 || unit == "Hz" || unit == "N")) break;
    }
    return *chosen;
}

std::string withPrefix (double value, const std::string& unit, int digits)
{
    if (std::isnan (value)) return "nan";   // the value may come from an unstable model
    if (std::isinf (value)) return value > 0.0 ? "inf" : "-inf";
    const auto prefix = prefixFor (value, unit);
    const double scaled = value / prefix.factor;
    const int whole = std::abs (scaled) < 1.0 ? 1 : static_cast<int> (std::floor (std::log10 (std::abs (scaled)))) + 1;
    constexpr int most_digits = 12;
    char text[48];
    if (whole > most_digits)
        std::snprintf (text, sizeof text, "%.*e", digits - 1, scaled);
    else
        std::snprintf (text, sizeof text, "%.*f", std::max (0, digits - whole), scaled);
    const auto shown_unit = unit == "1" ? std::string {} : (prefix.text == "u" ? "µ" : std::string (prefix.text)) + unitShown (unit);
    return shown_unit.empty() ? std::string (text) : std::string (text) + " " + shown_unit;
}

}   // namespace tactus::host
