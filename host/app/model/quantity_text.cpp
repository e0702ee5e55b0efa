// SPDX-License-Identifier: GPL-3.0-or-later
#include "quantity_text.hpp"
#include "with_prefix.hpp"

#include <host/app/text/filled.hpp>

#include <tactus/plan/values.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/read_number.hpp>
#include <tactus/text/units.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace tactus::host
{

double rounded (double v, int digits)
{
    if (v == 0.0 || ! std::isfinite (v)) return v;
    return wholeNumber (roundedText (v, digits)).value_or (v);
}

QuantityText QuantityText::moved (double to_si) const
{
    auto other = *this;
    other.number = rounded (to_si / scale);
    return other;
}

QuantityText QuantityText::exactly (double to_si) const
{
    auto other = *this;
    other.number = unit.empty() ? to_si : rounded (to_si / scale, 12);
    return other;
}

Json QuantityText::toJson() const { return unit.empty() ? Json (number) : Json (toText()); }

std::string QuantityText::toText() const { return unit.empty() ? numberText (number) : numberText (number) + ' ' + unit; }

QuantityText withBestPrefix (QuantityText q, const PortSheet& sheet)
{
    if (! q.unit.empty() || q.scale != 1.0 || sheet.unit.kind != UnitRule::Kind::fixed) return q;
    const auto symbol = std::string (sheet.unit.unit.symbol);
    const auto prefix = prefixFor (q.number, symbol);
    if (prefix.factor >= 1.0) return q;   // next to 8 kHz, a typed 4000 would be ambiguous
    q.unit = std::string (prefix.text) + symbol;
    q.scale = prefix.factor;
    q.number = rounded (q.number / prefix.factor, 12);   // without the last bits that the quotient adds
    return q;
}

std::string shownQuantity (double si, std::string_view symbol)
{
    constexpr int digits = 6;
    const auto prefix = prefixFor (si, symbol);
    const double number = si / prefix.factor;
    const auto text = numberText (number == std::round (number) ? number : rounded (number, digits));
    return symbol.empty() || symbol == "1" ? text : text + ' ' + unitShown (std::string (prefix.text) + std::string (symbol));
}

std::string unitShown (const std::string& unit)
{
    static const std::set<std::string> with_prefix { "um", "us", "uN", "uJ", "um/s", "ug", "uW" };
    std::string shown;
    for (const char c : unit)
        shown += c == '*' ? std::string ("·") : std::string (1, c);
    return with_prefix.contains (unit) ? "µ" + shown.substr (1) : shown;
}

std::string unitWritten (std::string text)
{
    for (const auto& [shown, written] : { std::pair<std::string_view, const char*> { "·", "*" }, { "µ", "u" } })
        for (auto at = text.find (shown); at != text.npos; at = text.find (shown, at))
            text.replace (at, shown.size(), written);
    return text;
}

namespace
{
/// Files have decibels as bare numbers.
Json asFilesHaveIt (const std::string& typed, const PortSheet& sheet)
{
    auto text = unitWritten (typed);
    const bool is_decibels = sheet.unit.kind == UnitRule::Kind::fixed && sheet.unit.unit.symbol == "dB" && text.ends_with ("dB");
    if (! is_decibels) return text;
    text.resize (text.find_last_not_of (' ', text.size() - 3) + 1);
    const auto number = wholeNumber (text);
    return number ? Json (*number) : Json (typed);
}
}   // namespace

Result<QuantityText> readQuantity (const Json& typed, const PortSheet& sheet)
{
    const auto value = typed.is_string() ? asFilesHaveIt (typed.get<std::string>(), sheet) : typed;
    const auto read = plan::readNumber (value);
    if (! read) return read.error();
    const auto& n = *read;
    const std::string id (sheet.id);
    if (n.dimension && sheet.unit.kind == UnitRule::Kind::fixed && *n.dimension != sheet.unit.unit.dimension)
        return Message::error ("param/unit", {},
                               filled (TRANS ("%1 does not fit %2, which is in %3"),
                                       typed.is_string() ? typed.asString() : unitShown (symbolOf (*n.dimension)), id,
                                       unitShown (std::string (sheet.unit.unit.symbol)))
                                   .toStdString());
    if (plan::miscounts (n, sheet.unit)) return Message::error ("param/unit", {}, plan::miscount (value, sheet.unit));
    if (! sheet.limits.hard.contains (n.value))
        return Message::error ("param/out_of_range", {}, filled (TRANS ("%1 must be %2"), id, plan::rangeText (sheet.limits.hard)).toStdString());

    QuantityText text { n.value, {}, 1.0 };
    if (value.is_string())
    {
        const auto written = value.get<std::string>();
        const auto start = std::min (written.find_first_not_of (' '), written.size());
        const auto [number, size, is_in_range] = readNumber (std::string_view (written).substr (start));
        auto unit = written.substr (start + size);
        unit.erase (0, unit.find_first_not_of (' '));
        const auto one = parseMeasure ("1 " + unit);
        if (! unit.empty() && one) text = { number, unit, one->value };
    }
    return text;
}

Result<QuantityText> readTyped (const std::string& typed, const QuantityText& shown, const PortSheet& sheet)
{
    const auto plain = wholeNumber (typed);
    return readQuantity (plain ? QuantityText { *plain, shown.unit, shown.scale }.toJson() : Json (typed), sheet);
}

double siOf (const Json& value, const PortSheet& sheet, double fallback)
{
    const auto read = readQuantity (value, sheet);
    return read ? read->si() : fallback;
}

}   // namespace tactus::host
