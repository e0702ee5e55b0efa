// SPDX-License-Identifier: MIT
#include "setting_parts.hpp"
#include <tactus/plan/flat/directory.hpp>

#include <tactus/text/closest_match.hpp>
#include <tactus/text/number_text.hpp>

#include <cmath>
#include <limits>

namespace tactus::plan
{

std::string under (const std::string& key, std::size_t index) { return key + "/" + std::to_string (index); }
std::string under (const std::string& key, std::string_view name) { return key + "/" + std::string (name); }

double numberFrom (const Json& json, const UnitRule& unit, const std::string& key)
{
    const auto read = readNumber (json);
    if (! read) throw Problem { read.error().text, key };
    const auto& n = *read;
    if (unit.kind == UnitRule::Kind::fixed && n.dimension && *n.dimension != unit.unit.dimension)
        throw Problem { "its unit is " + symbolOf (*n.dimension) + ", but it must be " + std::string (unit.unit.symbol), key };
    if (miscounts (n, unit)) throw Problem { miscount (json, unit), key };
    return n.value;
}

double wholeNumberFrom (const Json& json, const UnitRule& unit, const std::string& key)
{
    const double v = numberFrom (json, unit, key);
    if (v != std::floor (v) || std::abs (v) > std::numeric_limits<int>::max()) throw Problem { numberText (v) + " is not a whole number", key };
    return v;
}

double inRange (double v, const Interval& hard, const std::string& key)
{
    if (! hard.contains (v)) throw Problem { numberText (v) + " is out of range: it must be " + rangeText (hard), key };
    return v;
}

Vec3 vectorFrom (const Json& json, const UnitRule& unit, const std::string& key)
{
    listFrom (json, 3, "three numbers, such as [0, 0, 1]", key);
    Vec3 v;
    for (int i = 0; i < 3; ++i)
        v[i] = numberFrom (json[at (i)], unit, under (key, at (i)));
    return v;
}

Curve curveFrom (const Json& json, const UnitRule& x, const UnitRule& y, const std::string& key)
{
    if (! json.is_array() || json.size() != 2 || ! json[0].is_array() || ! json[1].is_array())
        throw Problem { "it must be [[x…], [y…]]", key };
    if (json[0].size() != json[1].size() || json[0].empty())
        throw Problem { "both lists need the same length, at least 1; they have " + std::to_string (json[0].size()) + " and " + std::to_string (json[1].size()),
                        key };

    Curve c;
    for (std::size_t i = 0; i < json[0].size(); ++i)
    {
        c.x.push_back (numberFrom (json[0][i], x, under (key + "/0", i)));
        c.y.push_back (numberFrom (json[1][i], y, under (key + "/1", i)));
        if (i > 0 && ! (c.x[i] > c.x[i - 1]))
            throw Problem { "x must increase, but " + numberText (c.x[i]) + " follows " + numberText (c.x[i - 1]), under (key + "/0", i) };
    }
    return c;
}

Law lawFrom (const Json& json, const UnitRule& x, const UnitRule& y, const std::string& key)
{
    const bool damps = y.kind == UnitRule::Kind::fixed && y.unit.quantity == Quantity::damping;
    const auto shapes =
        std::string ("it must be ") + (damps ? "{\"dissipation\": a}, " : "")
        + "{\"power\": [k, n]}, {\"exponential\": [a, b]} or {\"table\": [[e…], [f…]]}";
    if (! json.is_object() || json.size() != 1) throw Problem { shapes, key };

    const auto& kind = json.begin().key();
    const auto& value = json.begin().value();
    const auto inner = under (key, kind);
    if (kind == "table")
    {
        auto table = curveFrom (value, x, y, inner);
        if (table.x.front() < 0.0) throw Problem { "its first point has a negative deflection", inner + "/0/0" };
        if (table.x.front() == 0.0 && table.y.front() != 0.0) throw Problem { "a law must start at (0, 0)", inner + "/1/0" };
        if (table.x.back() == 0.0) throw Problem { "it needs a point with a deflection above 0", inner };
        return { .kind = Law::Kind::table, .table = std::move (table) };
    }
    if (kind == "dissipation" && damps)
        return { .kind = Law::Kind::dissipation, .a = inRange (numberFrom (value, unit::second_per_metre, inner), { 0.0, inf }, inner) };
    if (kind != "power" && kind != "exponential") throw Problem { shapes, inner };
    if (! value.is_array() || value.size() != 2) throw Problem { "it must be a list of two numbers", inner };

    const UnitRule plain = any_unit;
    Law l { .kind = kind == "power" ? Law::Kind::power : Law::Kind::exponential,
            .a = numberFrom (value[0], plain, inner + "/0"),
            .b = numberFrom (value[1], plain, inner + "/1") };
    inRange (l.a, { 0.0, inf }, inner + "/0");
    inRange (l.b, { 1e-12, inf }, inner + "/1");
    return l;
}

const Json& listFrom (const Json& json, std::size_t size, const std::string& what, const std::string& key)
{
    if (! json.is_array() || (size != 0 && json.size() != size)) throw Problem { "it must be " + what + ", but it is " + shown (json), key };
    return json;
}

const Json& objectFrom (const Json& json, const std::vector<std::string>& members, const std::string& what, const std::string& key)
{
    if (! json.is_object()) throw Problem { what + " must be an object with " + listed (members), key };
    for (const auto& [name, value] : json.items())
        if (std::ranges::find (members, name) == members.end())
            throw Problem { what + " has no '" + name + "'" + didYouMean (name, members) + "; it takes " + listed (members), under (key, name) };
    return json;
}

}   // namespace tactus::plan
