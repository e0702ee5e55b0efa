// SPDX-License-Identifier: GPL-3.0-or-later
#include "quantity_text.hpp"

#include <tactus/plan/values.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/units.hpp>

#include <cmath>
#include <cstdlib>

namespace tactus::host
{

double rounded (double v, int digits)
{
    if (v == 0.0 || ! std::isfinite (v)) return v;
    char text[40];
    std::snprintf (text, sizeof text, "%.*e", digits - 1, v);
    return std::strtod (text, nullptr);
}

QuantityText QuantityText::moved (double to_si) const
{
    auto other = *this;
    other.number = rounded (to_si / scale);
    return other;
}

Json QuantityText::toJson() const { return unit.empty() ? Json (number) : Json (toText()); }

std::string QuantityText::toText() const { return unit.empty() ? numberText (number) : numberText (number) + ' ' + unit; }

Result<QuantityText> readQuantity (const Json& value, const PortSheet& sheet)
{
    const auto read = plan::readNumber (value);
    if (! read) return read.error();
    const auto& n = *read;
    const std::string id (sheet.id);
    if (n.dimension && sheet.unit.kind == UnitRule::Kind::fixed && *n.dimension != sheet.unit.unit.dimension)
        return Message::error ("param/unit", {}, symbolOf (*n.dimension) + " does not fit " + id + ", which is in " + std::string (sheet.unit.unit.symbol));
    if (plan::miscounts (n, sheet.unit)) return Message::error ("param/unit", {}, plan::miscount (value, sheet.unit));
    if (! sheet.limits.hard.contains (n.value)) return Message::error ("param/out_of_range", {}, id + " must be " + plan::rangeText (sheet.limits.hard));

    QuantityText text { n.value, {}, 1.0 };
    if (value.is_string())
    {
        const auto written = value.get<std::string>();
        char* rest = nullptr;
        const double number = std::strtod (written.c_str(), &rest);
        std::string unit = rest;
        unit.erase (0, unit.find_first_not_of (' '));
        const auto one = parseMeasure ("1 " + unit);
        if (! unit.empty() && one) text = { number, unit, one->value };
    }
    return text;
}

double siOf (const Json& value, const PortSheet& sheet, double fallback)
{
    const auto read = readQuantity (value, sheet);
    return read ? read->si() : fallback;
}

}   // namespace tactus::host
