// SPDX-License-Identifier: MIT
// The schema of graph files says of devices and guards what their readers read.

#include <tactus/run/device/make_device.hpp>
#include <tactus/run/schema/graph_schema.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <set>

using namespace tactus;

namespace
{
/// "N/s" for a quantity whose schema refers to "#/$defs/in_N_per_s"; empty for anything else.
std::string unitOf (const Json& schema)
{
    if (! schema.is_object()) return {};   // true: anything
    const auto ref = schema.value ("$ref", std::string());
    const std::string prefix = "#/$defs/in_";
    if (! ref.starts_with (prefix)) return {};
    std::string unit;
    for (auto rest = std::string_view (ref).substr (prefix.size()); ! rest.empty();)
    {
        const bool per = rest.starts_with ("_per_");
        unit += per ? '/' : rest.front() == '_' ? '*'
                                                : rest.front();
        rest.remove_prefix (per ? 5 : 1);
    }
    return unit;
}

/// The properties of the description of a device with a driver.
Json propertiesOf (const std::string& driver)
{
    const auto schema = graphSchema (catalogue());
    for (const auto& choice : schema["$defs"]["device"]["allOf"])
        if (choice["if"]["properties"]["driver"]["const"] == driver) return choice["then"]["properties"];
    FAIL (driver);
    return {};
}

/// What the reader says about a description that has `object` at this key, or is `object` if the key is empty.
Messages problemsOf (const std::string& driver, const std::string& key, const Json& object)
{
    Json description { { "driver", driver }, { "path", "stroke" } };
    if (driver == "sim") description.asObject().pop_back();
    if (key == "axes")
        description["axes"] = { { "knob", object } };
    else if (! key.empty())
        description[key] = object;
    else
        for (const auto& [name, value] : object.items())
            description[name] = value;
    return makeDevice (description, ".").messages;
}

int count (const Messages& messages, const std::string& id, const std::string& where)
{
    return static_cast<int> (std::ranges::count_if (messages, [&] (const Message& m) { return m.id == id && m.where.ends_with ('/' + where); }));
}

/// The keys that the reader knows, from its remedy for an unknown one.
std::set<std::string> knownKeys (const Messages& messages)
{
    std::set<std::string> keys;
    const auto isIt = [] (const Message& m) { return m.id == "device/unknown_key" && m.text.find ("xyzzyxyzzy") != m.text.npos; };
    const auto unknown = std::ranges::find_if (messages, isIt);
    REQUIRE (unknown != messages.end());
    const std::string lead = "the known names are: ";
    REQUIRE (unknown->remedy.starts_with (lead));
    for (auto rest = std::string_view (unknown->remedy).substr (lead.size()); ! rest.empty();)
    {
        const auto end = std::min (rest.find (','), rest.size());
        keys.emplace (rest.substr (0, end));
        rest.remove_prefix (std::min (end + 2, rest.size()));
    }
    return keys;
}
}   // namespace

TEST_CASE ("the schema has the keys of the devices and guards that are read, with their units and ranges", "[schema]")
{
    using Place = std::pair<std::string, std::string>;
    const auto [driver, key] = GENERATE (Place { "sim", "" }, Place { "sim", "guard" }, Place { "sim", "hand" }, Place { "sim", "axes" },
                                         Place { "gesture", "" }, Place { "gesture", "guard" });
    CAPTURE (driver, key);
    auto properties = propertiesOf (driver);
    if (key == "axes")
        properties = properties["axes"]["additionalProperties"]["properties"];
    else if (! key.empty())
        properties = properties[key]["properties"];

    auto all = Json::object();
    for (const auto& [name, schema] : properties.items())
    {
        CAPTURE (name);
        const auto kind = [&, &driver = driver, &key = key, &name = name] (const char* id, const Json& value) {
            return count (problemsOf (driver, key, { { name, value } }), id, name);
        };   // clang 14 captures no structured bindings by itself
        const auto& alternatives = schema.is_object() && schema.contains ("anyOf") ? schema["anyOf"] : Json::array ({ schema });
        for (const auto& one : alternatives)
            if (const auto unit = unitOf (one); ! unit.empty())
            {
                CAPTURE (unit);
                CHECK (kind ("device/unit", "0.1 " + unit) == 0);
                CHECK (kind ("device/unit", "0.1 kg3") == 1);
                CHECK (kind ("device/out_of_range", -1e-3) == (one.contains ("minimum") ? 1 : 0));
            }
        all[name] = name == "driver" ? Json (driver) : name == "path"                                    ? Json ("stroke")
                                                   : name == "hand" || name == "axes" || name == "guard" ? Json::object()
                                                                                                         : Json (1);
    }
    all["xyzzyxyzzy"] = 1;

    // The reader knows each key of the schema, and the schema each key of the reader.
    const auto problems = problemsOf (driver, key, all);
    for (const auto& m : problems)
        CHECK ((m.id != "device/unknown_key" || m.text.find ("xyzzyxyzzy") != m.text.npos));
    for (const auto& known : knownKeys (problems))
        CHECK (properties.contains (known));
}
