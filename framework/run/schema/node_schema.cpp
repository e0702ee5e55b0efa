// SPDX-License-Identifier: MIT
#include "schema_parts.hpp"

#include <tactus/node/datasheet_json.hpp>
#include <tactus/text/number_text.hpp>

namespace tactus::schema
{

namespace
{
const Unit* unitOf (const UnitRule& rule) noexcept { return rule.kind == UnitRule::Kind::fixed ? &rule.unit : nullptr; }

/// "tool position, in m; usually from 0 to 2; latched at onset".
std::string aboutRow (std::string_view about, const UnitRule& unit, const Limits& limits)
{
    std::string text (about);
    if (const auto symbol = unitText (unit); symbol != "1") text += (unitOf (unit) ? ", in " : ", ") + symbol;
    if (const auto& [min, max] = limits.usual; ! (limits.usual == Interval {}))
        text += "; usually " + (min == -inf ? "up to " + numberText (max) : max == inf ? "from " + numberText (min)
                                                                                       : numberText (min) + " … " + numberText (max));
    return text + (limits.latch ? "; latched at onset" : "");
}

void addDefault (Json& schema, const PortSheet& row)
{
    const double* v = row.initial;
    if (! isFinite (v[0])) return;
    schema["default"] = row.width == 3 ? Json::array ({ v[0], v[1], v[2] }) : Json (v[0]);
}

Json param (const PortSheet& row, Quantities& quantities)
{
    Json schema;
    if (! row.choices.empty())
    {
        schema["enum"] = std::vector<std::string> (row.choices.begin(), row.choices.end());
        schema["default"] = std::string (row.choices[static_cast<std::size_t> (row.initial[0])]);
        schema["description"] = row.about;
        return schema;
    }
    auto one = quantities.of (unitOf (row.unit), row.limits.hard);
    if (row.width == 3) one = listOf (std::move (one), 3, 3);
    if (row.list)
        schema["anyOf"] = Json::array ({ one, listOf (one, 0, -1) });
    else
        schema = std::move (one);
    addDefault (schema, row);
    schema["description"] = aboutRow (row.about, row.unit, row.limits);
    return schema;
}

/// [[x…], [y…]].
Json curve (const Unit* x, const Unit* y, Quantities& quantities)
{
    auto lists = listOf (true, 2, 2);
    lists["prefixItems"] = Json::array ({ listOf (quantities.of (x), 1, -1), listOf (quantities.of (y), 1, -1) });
    return lists;
}

Json law (const Unit* x, const Unit* y, Quantities& quantities)
{
    const auto pair = listOf (quantities.of (nullptr, { 0.0, inf }), 2, 2);
    Json shapes { { "power", pair }, { "exponential", pair }, { "table", curve (x, y, quantities) } };
    if (y != nullptr && y->quantity == Quantity::damping) shapes["dissipation"] = quantities.of (&unit::second_per_metre, { 0.0, inf });
    return { { "type", "object" }, { "properties", std::move (shapes) }, { "additionalProperties", false }, { "minProperties", 1 }, { "maxProperties", 1 } };
}

Json surface()
{
    Json keys;
    for (const auto* key : { "nodes", "triangles", "frames", "mesh", "curves", "mu", "weights" })
        keys[key] = true;
    return { { "type", "object" }, { "properties", std::move (keys) }, { "additionalProperties", false }, { "required", Json::array ({ "curves", "mu" }) } };
}

Json setting (const SettingSheet&, Quantities&);

Json record (const SettingSheet& sheet, Quantities& quantities)
{
    auto fields = Json::object();
    for (const auto& f : sheet.fields)
        fields[std::string (f.id)] = setting (f, quantities);
    return { { "type", "object" }, { "properties", std::move (fields) }, { "additionalProperties", false } };
}

Json settingValue (const SettingSheet& sheet, Quantities& quantities)
{
    using Kind = SettingSheet::Kind;
    const auto* y = unitOf (sheet.unit);
    switch (sheet.kind)
    {
    case Kind::number:
        return quantities.of (y, sheet.limits.hard);
    case Kind::integer:
    {
        auto schema = quantities.of (y, sheet.limits.hard);
        schema["type"] = Json::array ({ "integer", "string" });
        return schema;
    }
    case Kind::vector:
        return listOf (quantities.of (y), 3, 3);
    case Kind::numbers:
        return listOf (quantities.of (y, sheet.limits.hard), 0, -1);
    case Kind::curve:
        return curve (unitOf (sheet.x_unit), y, quantities);
    case Kind::law:
        return law (unitOf (sheet.x_unit), y, quantities);
    case Kind::record:
        return record (sheet, quantities);
    case Kind::records:
        return listOf (record (sheet, quantities), 0, -1);
    case Kind::surface:
        return surface();
    case Kind::text:
        return { { "type", "string" } };
    case Kind::signal:
    case Kind::image:
    case Kind::table:
        break;
    }
    return { { "type", "string" }, { "minLength", 1 } };
}

Json setting (const SettingSheet& sheet, Quantities& quantities)
{
    auto schema = settingValue (sheet, quantities);
    if (const auto* v = std::get_if<double> (&sheet.initial); v != nullptr && isFinite (*v))
        schema["default"] = sheet.kind == SettingSheet::Kind::integer ? Json (static_cast<std::int64_t> (*v)) : Json (*v);
    schema["description"] = aboutRow (sheet.about, sheet.unit, sheet.limits);
    return schema;
}

Json onlyThese (Json properties) { return { { "properties", std::move (properties) }, { "additionalProperties", false } }; }
}   // namespace

Json nodeOf (const NodeType& type, Quantities& quantities)
{
    auto params = Json::object(), settings = Json::object();
    for (const auto& row : type.params)
        params[std::string (row.id)] = param (row, quantities);
    for (const auto& row : type.settings)
        settings[std::string (row.id)] = setting (row, quantities);

    Json properties { { "params", onlyThese (std::move (params)) }, { "settings", onlyThese (std::move (settings)) } };
    for (const auto* key : { "count", "every", "times", "hold" })
        properties[key] = never (std::string ("only nodes that are subgraphs have '") + key + "'");
    if (! type.bind) properties["role"] = never ("only device nodes have a role");

    Json node { { "description", type.info.summary }, { "properties", std::move (properties) } };
    if (type.bind) node["required"] = Json::array ({ "role" });
    return node;
}

}   // namespace tactus::schema
