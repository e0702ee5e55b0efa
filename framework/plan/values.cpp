// SPDX-License-Identifier: MIT
#include "values.hpp"

#include <framework/near_miss.hpp>
#include <framework/number_text.hpp>

#include <cmath>
#include <limits>

namespace tactus::plan
{

namespace
{
/// "at least 1e-9", "from 0 to 1".
std::string rangeText (const Interval& i)
{
    if (i.min == -inf) return "at most " + numberText (i.max);
    if (i.max == inf) return "at least " + numberText (i.min);
    return "from " + numberText (i.min) + " to " + numberText (i.max);
}

std::string joined (const std::vector<std::string>& parts)
{
    std::string all;
    for (const auto& p : parts)
        all += (all.empty() ? "" : ", ") + p;
    return all;
}

struct Problem
{
    std::string what;
    std::string key;   // appended to the pointer
};

/// Reads the parts of settings; the first problem is thrown to readSetting, which returns it.
struct SettingReader
{
    static double number (const Json& json, const std::optional<Dimension>& dimension, std::string_view symbol, const std::string& key)
    {
        const auto read = readNumber (json);
        if (const auto* what = std::get_if<std::string> (&read)) throw Problem { *what, key };
        const auto& n = std::get<Number> (read);
        if (dimension && n.dimension && *n.dimension != *dimension)
            throw Problem { "its unit is " + symbolOf (*n.dimension) + ", but " + std::string (symbol) + " belongs here", key };
        return n.value;
    }

    static double number (const Json& json, const UnitRule& unit, const std::string& key)
    {
        return unit.kind == UnitRule::Kind::fixed ? number (json, unit.unit.dimension, unit.unit.symbol, key) : number (json, {}, "", key);
    }

    static double inRange (double v, const Interval& hard, const std::string& key)
    {
        if (! hard.contains (v)) throw Problem { numberText (v) + " is out of range: it must be " + rangeText (hard), key };
        return v;
    }

    static Curve curve (const Json& json, const UnitRule& x, const UnitRule& y, const std::string& key)
    {
        if (! json.is_array() || json.size() != 2 || ! json[0].is_array() || ! json[1].is_array())
            throw Problem { "it must be [[x…], [y…]]", key };
        if (json[0].size() != json[1].size() || json[0].empty())
            throw Problem { "both lists need the same length, at least 1; they have " + std::to_string (json[0].size()) + " and " + std::to_string (json[1].size()), key };

        Curve c;
        for (std::size_t i = 0; i < json[0].size(); ++i)
        {
            const auto index = std::to_string (i);
            c.x.push_back (number (json[0][i], x, key + "/0/" + index));
            c.y.push_back (number (json[1][i], y, key + "/1/" + index));
            if (i > 0 && ! (c.x[i] > c.x[i - 1])) throw Problem { "x must increase, but " + numberText (c.x[i]) + " follows " + numberText (c.x[i - 1]), key + "/0/" + index };
        }
        return c;
    }

    static Law law (const Json& json, const SettingSheet& sheet)
    {
        const bool damps = sheet.unit.kind == UnitRule::Kind::fixed && sheet.unit.unit.quantity == Quantity::damping;
        const auto shapes = std::string ("it must be ") + (damps ? "{\"dissipation\": a}, " : "") + "{\"power\": [k, n]}, {\"exponential\": [a, b]} or {\"table\": [[e…], [f…]]}";
        if (! json.is_object() || json.size() != 1) throw Problem { shapes, "" };

        const auto& kind = json.begin().key();
        const auto& value = json.begin().value();
        const auto key = "/" + kind;
        if (kind == "table")
        {
            auto table = curve (value, sheet.x_unit, sheet.unit, key);
            if (table.x.front() < 0.0) throw Problem { "its first point lies at a negative deflection", key + "/0/0" };
            if (table.x.front() == 0.0 && table.y.front() != 0.0) throw Problem { "a law starts from (0, 0)", key + "/1/0" };
            if (table.x.back() == 0.0) throw Problem { "it needs a point beyond 0", key };
            return { .kind = Law::Kind::table, .table = std::move (table) };
        }
        if (kind == "dissipation" && damps)
            return { .kind = Law::Kind::dissipation, .a = inRange (number (value, unit::second_per_metre, key), { 0.0, inf }, key) };
        if (kind != "power" && kind != "exponential") throw Problem { shapes, key };
        if (! value.is_array() || value.size() != 2) throw Problem { "it must be a list of two numbers", key };

        Law l { .kind = kind == "power" ? Law::Kind::power : Law::Kind::exponential, .a = number (value[0], {}, "", key + "/0"), .b = number (value[1], {}, "", key + "/1") };
        inRange (l.a, { 0.0, inf }, key + "/0");
        inRange (l.b, { 1e-12, inf }, key + "/1");
        return l;
    }

    static Records records (const Json& json, const SettingSheet& sheet)
    {
        std::vector<std::string> ids;
        for (const auto& f : sheet.fields)
            ids.emplace_back (f.id);
        if (! json.is_array()) throw Problem { "it must be a list of records with " + joined (ids), "" };

        Records rows;
        for (std::size_t i = 0; i < json.size(); ++i)
        {
            const auto key = "/" + std::to_string (i);
            if (! json[i].is_object()) throw Problem { "record " + std::to_string (i) + " must be an object with " + joined (ids), key };
            for (const auto& [name, value] : json[i].items())
                if (std::ranges::find (ids, name) == ids.end())
                    throw Problem { "a record has no field '" + name + "'" + didYouMean (name, ids) + "; its fields are " + joined (ids), key + "/" + name };

            auto& row = rows.emplace_back();
            for (const auto& f : sheet.fields)
            {
                const auto found = json[i].find (f.id);
                row.push_back (found == json[i].end() ? f.initial : inRange (number (*found, f.unit, key + "/" + std::string (f.id)), f.limits.hard, key + "/" + std::string (f.id)));
            }
        }
        return rows;
    }

    static SettingValue read (const Json& json, const SettingSheet& sheet)
    {
        using Kind = SettingSheet::Kind;
        switch (sheet.kind)
        {
        case Kind::number:
            return inRange (number (json, sheet.unit, ""), sheet.limits.hard, "");
        case Kind::integer:
        {
            const double v = inRange (number (json, sheet.unit, ""), sheet.limits.hard, "");
            if (v != std::floor (v) || std::abs (v) > std::numeric_limits<int>::max()) throw Problem { numberText (v) + " is not a whole number", "" };
            return v;
        }
        case Kind::text:
            if (! json.is_string()) throw Problem { "it must be text", "" };
            return json.get<std::string>();
        case Kind::curve:
            return curve (json, sheet.x_unit, sheet.unit, "");
        case Kind::law:
            return law (json, sheet);
        case Kind::records:
            break;
        }
        return records (json, sheet);
    }
};

class ParamReader
{
public:
    explicit ParamReader (Flat& f) : flat (f) {}

    void read (const Assignment& a)
    {
        const auto& sheet = flat.sheet (a.to);
        auto& values = flat.nodes[static_cast<std::size_t> (a.to.node)].params[static_cast<std::size_t> (a.to.port)];

        if (! sheet.choices.empty())
            readChoice (a, sheet, values[0]);
        else if (a.to.index >= 0)
            set (a, a.low, a.high, sheet, values[static_cast<std::size_t> (a.to.index)]);
        else if (a.to.component >= 0)
            set (a, a.low, a.high, sheet, values[static_cast<std::size_t> (a.to.component)]);
        else if (sheet.list && ! a.low.is_array())
            for (auto& v : values)
                set (a, a.low, a.high, sheet, v);
        else if (sheet.list || sheet.width == 3)
            readEach (a, sheet, values);
        else
            set (a, a.low, a.high, sheet, values[0]);
    }

private:
    Flat& flat;

    void readChoice (const Assignment& a, const PortSheet& sheet, double& value)
    {
        std::vector<std::string> names (sheet.choices.begin(), sheet.choices.end());
        const auto chosen = a.low.is_string() ? std::ranges::find (names, a.low.get_ref<const std::string&>()) : names.end();
        if (chosen == names.end())
            flat.error ("param/unknown_choice", a.origin, "'" + flat.nameOf (a.to) + "' cannot be " + shown (a.low) + (a.low.is_string() ? didYouMean (a.low.get<std::string>(), names) : ""), "one of: " + joined (names));
        else
            value = static_cast<double> (chosen - names.begin());
    }

    void readEach (const Assignment& a, const PortSheet& sheet, std::vector<double>& values)
    {
        const bool lists = a.low.is_array() && a.high.is_array();
        if (! lists || a.low.size() != a.high.size() || (sheet.list ? a.low.size() > values.size() : a.low.size() != 3))
        {
            flat.error ("param/shape", a.origin, "'" + flat.nameOf (a.to) + "' cannot be " + shown (a.low),
                        sheet.list ? "a list of at most " + std::to_string (values.size()) + " numbers" : "three numbers, as in [0, 0, 1]");
            return;
        }
        for (std::size_t i = 0; i < a.low.size(); ++i)
            set (a, a.low[i], a.high[i], sheet, values[i]);
    }

    void set (const Assignment& a, const Json& low, const Json& high, const PortSheet& sheet, double& value)
    {
        double ends[2];
        for (int i = 0; i < 2; ++i)
        {
            const auto read = readNumber (i == 0 ? low : high);
            if (const auto* problem = std::get_if<std::string> (&read))
            {
                const std::string symbol (sheet.unit.kind == UnitRule::Kind::fixed ? sheet.unit.unit.symbol : "1");
                flat.error (a.low.is_string() ? "unit/syntax" : "param/value", a.origin, "'" + flat.nameOf (a.to) + "': " + *problem,
                            "give a plain number" + (symbol == "1" ? "" : " in " + symbol) + ", or text with a unit");
                return;
            }
            ends[i] = std::get<Number> (read).value;
            if (! sheet.limits.hard.contains (ends[i]))
            {
                flat.error ("param/out_of_range", a.origin, "'" + flat.nameOf (a.to) + "' is " + numberText (ends[i]) + ", where the model has no meaning", "it must be " + rangeText (sheet.limits.hard) + (sheet.unit.unit.symbol == "1" ? "" : " " + std::string (sheet.unit.unit.symbol)));
                return;
            }
        }
        value = a.amount == 0.0 ? ends[0] : ends[0] + a.amount * (ends[1] - ends[0]);
    }
};
}   // namespace

std::string shown (const Json& json)
{
    if (json.is_structured()) return json.is_array() ? "a list of " + std::to_string (json.size()) : "an object";
    return json.dump (-1, ' ', false, Json::error_handler_t::replace).substr (0, 60);
}

std::variant<Number, std::string> readNumber (const Json& json)
{
    if (json.is_number())
    {
        const auto v = json.get<double>();
        if (! isFinite (v)) return "it is not a finite number";
        return Number { v, {} };
    }
    if (! json.is_string()) return shown (json) + " is not a number, nor text with a unit";

    const auto parsed = parseMeasure (json.get_ref<const std::string&>());
    if (const auto* problem = std::get_if<std::string> (&parsed)) return *problem;
    const auto& m = std::get<Measure> (parsed);
    return Number { m.value, m.dimension };
}

std::variant<SettingValue, std::string> readSetting (const Json& json, const SettingSheet& sheet, std::string& where)
{
    try
    {
        return SettingReader::read (json, sheet);
    }
    catch (const Problem& p)
    {
        where += p.key;
        return p.what;
    }
}

void readParams (Flat& flat)
{
    ParamReader reader { flat };
    for (const auto& a : flat.assignments)
        reader.read (a);
}

}   // namespace tactus::plan
