// SPDX-License-Identifier: GPL-3.0-or-later
#include "quantity_text.hpp"

#include <framework/number_text.hpp>
#include <framework/plan/values.hpp>
#include <framework/units.hpp>

#include <cmath>
#include <cstdlib>

namespace tactus::host
{

namespace
{
double rounded (double v, int digits)
{
    if (v == 0.0 || ! std::isfinite (v)) return v;
    char text[40];
    std::snprintf (text, sizeof text, "%.*e", digits - 1, v);
    return std::strtod (text, nullptr);
}
}   // namespace

QuantityText QuantityText::moved (double to_si) const
{
    auto other = *this;
    other.number = rounded (to_si / scale, 3);
    return other;
}

Json QuantityText::toJson() const { return unit.empty() ? Json (number) : Json (toText()); }

std::string QuantityText::toText() const { return unit.empty() ? numberText (number) : numberText (number) + ' ' + unit; }

std::variant<QuantityText, std::string> readQuantity (const Json& value, const PortSheet& sheet)
{
    const auto read = plan::readNumber (value);
    if (const auto* problem = std::get_if<std::string> (&read)) return *problem;
    const auto& n = std::get<plan::Number> (read);
    if (n.dimension && sheet.unit.kind == UnitRule::Kind::fixed && *n.dimension != sheet.unit.unit.dimension)
        return symbolOf (*n.dimension) + " is no unit of " + std::string (sheet.id) + ", which is in " + std::string (sheet.unit.unit.symbol);
    if (plan::miscounts (n, sheet.unit)) return plan::miscount (value, sheet.unit);
    if (! sheet.limits.hard.contains (n.value)) return std::string (sheet.id) + " is " + plan::rangeText (sheet.limits.hard);

    QuantityText text { n.value, {}, 1.0 };
    if (value.is_string())
    {
        const auto written = value.get<std::string>();
        char* rest = nullptr;
        const double number = std::strtod (written.c_str(), &rest);
        std::string unit = rest;
        unit.erase (0, unit.find_first_not_of (' '));
        const auto one = parseMeasure ("1 " + unit);
        if (const auto* measure = std::get_if<Measure> (&one); ! unit.empty() && measure != nullptr) text = { number, unit, measure->value };
    }
    return text;
}

}   // namespace tactus::host
