// SPDX-License-Identifier: MIT
#include "values.hpp"
#include <tactus/plan/flat/directory.hpp>

#include <tactus/text/closest_match.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::plan
{

namespace
{
class ParamReader
{
public:
    explicit ParamReader (Flat& f) : flat (f) {}

    void read (const Assignment& a)
    {
        const auto& sheet = flat.sheet (a.to);
        const auto values = flat.param (a.to.node, at (a.to.port));

        if (! sheet.choices.empty())
            readChoice (a, sheet, values[0]);
        else if (a.to.index >= 0)
            set (a, *a.low, *a.high, sheet, values[at (a.to.index)]);
        else if (a.to.component >= 0)
            set (a, *a.low, *a.high, sheet, values[at (a.to.component)]);
        else if (sheet.list && ! a.low->is_array())
            for (auto& v : values)
                set (a, *a.low, *a.high, sheet, v);
        else if (sheet.list || sheet.width == 3)
            readEach (a, sheet, values);
        else
            set (a, *a.low, *a.high, sheet, values[0]);
    }

private:
    Flat& flat;

    /// Values outside the usual range are fine. One that is far outside is mostly a slip in the unit: 0.3 for 0.3 mm.
    void warnIfFarFromUsual (const Assignment& a, const PortSheet& sheet, double v)
    {
        if (! isFarFromUsual (sheet, v)) return;
        const auto unit = sheet.unit.unit.symbol == "1" ? std::string() : " " + std::string (sheet.unit.unit.symbol);
        const auto usual = rangeText (sheet.limits.usual) + unit;
        flat.warn ("param/unusual", a.origin, "'" + flat.nameOf (a.to) + "' is " + numberText (v) + unit + ", far outside the usual range, which is " + usual,
                   std::string ("fine if intended; if not, check its unit") + (unit == " m" ? ": 0.3 mm is \"0.3 mm\", or 0.0003 in a file" : ""));
    }

    void readChoice (const Assignment& a, const PortSheet& sheet, double& value)
    {
        std::vector<std::string> names (sheet.choices.begin(), sheet.choices.end());
        const auto chosen = a.low->is_string() ? std::ranges::find (names, a.low->asString()) : names.end();
        if (chosen == names.end())
            flat.error ("param/unknown_choice", a.origin,
                        "'" + flat.nameOf (a.to) + "' cannot be " + shown (*a.low) + (a.low->is_string() ? didYouMean (a.low->get<std::string>(), names) : ""),
                        "use one of: " + listed (names));
        else
            value = static_cast<double> (chosen - names.begin());
    }

    void readEach (const Assignment& a, const PortSheet& sheet, std::span<double> values)
    {
        const bool lists = a.low->is_array() && a.high->is_array();
        if (! lists || a.low->size() != a.high->size() || (sheet.list ? a.low->size() > values.size() : a.low->size() != 3))
        {
            flat.error ("param/shape", a.origin, "'" + flat.nameOf (a.to) + "' cannot be " + shown (*a.low),
                        sheet.list ? "give a list of at most " + std::to_string (values.size()) + " numbers" : "give three numbers, such as [0, 0, 1]");
            return;
        }
        for (std::size_t i = 0; i < a.low->size(); ++i)
            set (a, (*a.low)[i], (*a.high)[i], sheet, values[i]);
    }

    void set (const Assignment& a, const Json& low, const Json& high, const PortSheet& sheet, double& value)
    {
        double ends[2];
        for (int i = 0; i < (&high == &low ? 1 : 2); ++i)
        {
            const auto read = readNumber (i == 0 ? low : high);
            if (! read)
            {
                const std::string symbol (sheet.unit.kind == UnitRule::Kind::fixed ? sheet.unit.unit.symbol : "1");
                flat.error (a.low->is_string() ? "unit/syntax" : "param/value", a.origin, "'" + flat.nameOf (a.to) + "': " + read.error().text,
                            "give a plain number" + (symbol == "1" ? "" : " in " + symbol) + ", or text with a unit");
                return;
            }
            ends[i] = read->value;
            if (! sheet.limits.hard.contains (ends[i]))
            {
                flat.error ("param/out_of_range", a.origin, "'" + flat.nameOf (a.to) + "' is " + numberText (ends[i]) + ", which is out of range for the model",
                            "it must be " + rangeText (sheet.limits.hard) + (sheet.unit.unit.symbol == "1" ? "" : " " + std::string (sheet.unit.unit.symbol)));
                return;
            }
            warnIfFarFromUsual (a, sheet, ends[i]);
        }
        value = a.amount == 0.0 ? ends[0] : ends[0] + a.amount * (ends[1] - ends[0]);
    }
};
}   // namespace

std::string rangeText (const Interval& i)
{
    if (i.min == -inf) return "at most " + numberText (i.max);
    if (i.max == inf) return "at least " + numberText (i.min);
    return "from " + numberText (i.min) + " to " + numberText (i.max);
}

bool isFarFromUsual (const PortSheet& sheet, double v) noexcept
{
    constexpr double far = 10.0;
    const auto& [min, max] = sheet.limits.usual;
    if (sheet.unit.kind != UnitRule::Kind::fixed || sheet.unit.unit.symbol == "1" || v == 0.0) return false;
    return std::abs (v) > far * std::max (std::abs (min), std::abs (max)) || (min > 0.0 && v < min / far);
}

std::string shown (const Json& json)
{
    if (json.is_structured()) return json.is_array() ? "a list of " + std::to_string (json.size()) : "an object";
    return json.dump().substr (0, 60);
}

Result<Number> readNumber (const Json& json)
{
    const auto problem = [] (std::string text) { return Message::error ("param/value", {}, std::move (text)); };
    if (json.is_number())
    {
        const auto v = json.get<double>();
        if (! isFinite (v)) return problem ("it is not a finite number");
        return Number { .value = v, .dimension = {} };
    }
    if (! json.is_string()) return problem (shown (json) + " is neither a number nor text with a unit");

    const auto parsed = parseMeasure (json.asString());
    if (! parsed) return problem (parsed.error().text);
    return Number { parsed->value, parsed->dimension, parsed->angular };
}

bool miscounts (const Number& n, const UnitRule& unit) noexcept
{
    const auto q = unit.unit.quantity;
    return n.angular && unit.kind == UnitRule::Kind::fixed && (q == Quantity::frequency || q == Quantity::spatial_frequency || q == Quantity::rate);
}

std::string miscount (const Json& json, const UnitRule& unit)
{
    return shown (json) + " counts radians or degrees, but " + std::string (unit.unit.symbol) + " counts whole cycles of 2 pi rad or 360 deg";
}

void addValues (FlatNode& made, Flat& flat)
{
    made.values = flat.values.size();
    for (const auto& row : made.type->params)
        for (int k = 0; k < made.slots (row); ++k)
            flat.values.push_back (row.initial[row.list ? 0 : k]);
}

void readParams (Flat& flat)
{
    ParamReader reader { flat };
    for (const auto& a : flat.assignments)
        reader.read (a);
}

}   // namespace tactus::plan
