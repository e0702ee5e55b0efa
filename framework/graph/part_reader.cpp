// SPDX-License-Identifier: MIT
#include "part_reader.hpp"

#include "endpoint_text.hpp"
#include "meant.hpp"
#include "wire_text.hpp"

#include <tactus/text/closest_match.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/units.hpp>

#include <algorithm>
#include <cmath>

namespace tactus
{
using namespace graph;

bool PartReader::checkId (const std::string& id, const std::string& where, std::string_view what)
{
    if (isId (id)) return true;
    error ("graph/bad_id", where, quote (id) + " is not an id for " + std::string (what), idRemedy (id));
    return false;
}

void PartReader::addPatch (std::vector<KnownKey>& fields, Patch& patch)
{
    const auto addNode = [&] (const std::string& name, Json& node, const JsonPlace& where) { readNode (name, node, where, patch.nodes.emplace_back()); };
    fields.push_back ({ "nodes", JsonKind::object, [this, addNode, &patch] (Json& v, const std::string& at) {
                           patch.nodes.reserve (v.size());
                           eachId (v, at, "a node", addNode);
                       } });
    fields.push_back ({ "wires", JsonKind::list, [&] (Json& v, const std::string& at) {
                           patch.wires.reserve (v.size());
                           for (std::size_t i = 0; i < v.size(); ++i)
                               readWire (v[i], at, i, patch);
                       } });
    fields.push_back ({ "expose", JsonKind::object, [&] (Json& v, const std::string& at) { readExpose (v, at, patch.expose); } });
}

void PartReader::readSubgraph (Json& object, const std::string& where, Patch& patch)
{
    std::vector<KnownKey> fields { { "ui", JsonKind::object, keep ("ui", patch.extra) } };
    addPatch (fields, patch);
    read (object, where, fields, patch.extra);
}

void PartReader::readNode (const std::string& name, Json& object, const JsonPlace& where, graph::Node& node)
{
    using Self = PartReader;
    using Row = RowKey<PartReader, graph::Node>;
    static const Row keys[] = {
        { "type", JsonKind::text, [] (Self& self, graph::Node& n, Json& v, const JsonPlace& at) { self.readType (v.asString(), at, n); } },
        { "role", JsonKind::text,
          [] (Self& self, graph::Node& n, Json& v, const JsonPlace& at) {
              n.role = v.asString();
              self.checkId (n.role, at, "a role");
          } },
        { "params", JsonKind::object, [] (Self& self, graph::Node& n, Json& v, const JsonPlace& at) { self.readValues (v, at, "a parameter", n.params); } },
        { "settings", JsonKind::object, [] (Self& self, graph::Node& n, Json& v, const JsonPlace& at) { self.readValues (v, at, "a setting", n.settings); } },
        { "roles", JsonKind::object, [] (Self& self, graph::Node& n, Json& v, const JsonPlace& at) { self.readRoles (v, at, n); } },
        { "overrides", JsonKind::object, [] (Self& self, graph::Node& n, Json& v, const JsonPlace& at) { self.readOverrides (v, at, n); } },
        { "bypass", JsonKind::truth, [] (Self&, graph::Node& n, Json& v, const JsonPlace&) { n.bypass = v.get<bool>(); } },
        { "count", JsonKind::number, [] (Self& self, graph::Node& n, Json& v, const JsonPlace& at) { self.readCount ("count", v, at, n.extra); } },
        { "every", JsonKind::number, [] (Self& self, graph::Node& n, Json& v, const JsonPlace& at) { self.readCount ("every", v, at, n.extra); } },
        { "times", JsonKind::number, [] (Self& self, graph::Node& n, Json& v, const JsonPlace& at) { self.readCount ("times", v, at, n.extra); } },
        { "hold", JsonKind::text,
          [] (Self& self, graph::Node& n, Json& v, const JsonPlace& at) {
              if (const std::vector<std::string> holds { "latch", "linear" }; std::ranges::count (holds, v.asString()) == 0)
                  self.error ("file/bad_value", at, "'hold' is " + quote (v.asString()) + "; it should be \"latch\" or \"linear\"",
                              suggestion (v.asString(), holds));
              append (n.extra, "hold", std::move (v));
          } },
        { "ui", JsonKind::object, [] (Self&, graph::Node& n, Json& v, const JsonPlace&) { append (n.extra, "ui", std::move (v)); } },
    };
    node.name = name;
    read (object, where, keys, *this, node, node.extra);
    if (! object.contains ("type"))
        error ("file/missing_key", where, "the node " + quote (name) + " has no 'type'",
               "add \"type\", with an id from the catalogue or \"graph:\" and the name of a subgraph");
}

void PartReader::readType (std::string& type, const JsonPlace& where, graph::Node& node)
{
    constexpr std::string_view subgraph = "graph:", file = "file:";
    if (type.empty() || type == file)
        error ("file/bad_value", where, type.empty() ? "the type is empty" : "there is no path after 'file:'",
               "write an id from the catalogue, \"graph:name\" or \"file:path.json\"");
    else if (type.starts_with (subgraph))
        checkId (type.substr (subgraph.size()), where, "a subgraph");
    node.type = std::move (type);
}

void PartReader::readValues (Json& object, const JsonPlace& where, std::string_view what, Json& values)
{
    for (const auto& [id, value] : object.asObject())
        if (! isId (id)) checkId (id, JsonPlace (where, id), what);
    values = std::move (object);
}

void PartReader::readRoles (Json& object, const std::string& where, graph::Node& node)
{
    for (auto& [inner, outer] : object.asObject())
    {
        const auto at = where + '/' + pointerPart (inner);
        checkId (inner, at, "a role");
        if (outer.is_string())
            checkId (outer.asString(), at, "a role");
        else if (outer.is_array())
        {
            for (std::size_t i = 0; i < outer.size(); ++i)
            {
                const auto entry = at + '/' + std::to_string (i);
                if (isKind (outer[i], JsonKind::text, entry)) checkId (outer[i].asString(), entry, "a role");
            }
        }
        else
            error ("file/wrong_kind", at, "the role " + quote (inner) + " should be mapped to a role, or to a list of roles, one for each instance",
                   "write \"thumb\" or [\"thumb\", \"index\"]");
    }
    node.roles = std::move (object);
}

void PartReader::readOverrides (Json& object, const std::string& where, graph::Node& node)
{
    for (const auto& [path, value] : object.asObject())
        if (const auto parsed = parseOverride (path); ! parsed)
            error ("graph/bad_path", where + '/' + pointerPart (path), parsed.error().text, "write node.param, or [3]/node.param for one instance");
    node.overrides = std::move (object);
}

void PartReader::readCount (const std::string& key, Json& value, const std::string& where, Json& extra)
{
    constexpr double most = 1e6;
    const double n = value.get<double>();
    if (! (n >= 1.0 && n <= most && n == std::floor (n)))
        error ("file/bad_value", where, quote (key) + " is " + value.dump() + "; it should be a whole number from 1 to 1000000", "write 1, or remove the key");
    append (extra, key, std::move (value));
}

void PartReader::readWire (Json& value, const std::string& list, std::size_t number, Patch& patch)
{
    if (value.is_string())
    {
        if (graph::readWire (value.asString(), patch.wires.emplace_back())) return;
        patch.wires.pop_back();
    }
    readWire (value, list + '/' + std::to_string (number), patch);
}

void PartReader::readWire (Json& value, const std::string& where, Patch& patch)
{
    if (value.is_string())
    {
        if (auto wire = parse (value, where)) patch.wires.push_back (std::move (*wire));
        return;
    }
    if (! value.is_object())
    {
        error ("file/wrong_kind", where, "a wire should be a string, or an object with a key 'wire'", "write \"node.port -> node.port\"");
        return;
    }

    std::optional<Wire> wire;
    Wire rest;
    read (value, where,
          { { "wire", JsonKind::text, [&] (Json& v, const std::string& at) { wire = parse (v, at); } },
            { "gain", JsonKind::any, [&] (Json& v, const std::string& at) {
                 checkNumber (v, at);
                 rest.gain = std::move (v);
             } },
            { "enabled", JsonKind::truth, [&] (Json& v, const std::string&) { rest.enabled = v.get<bool>(); } },
            { "ui", JsonKind::object, keep ("ui", rest.extra) } },
          rest.extra);
    if (! value.contains ("wire")) error ("file/missing_key", where, "the wire has no key 'wire' for its two ends", "add \"wire\": \"node.port -> node.port\"");
    if (! wire) return;
    wire->gain = std::move (rest.gain);
    wire->enabled = rest.enabled;
    wire->extra = std::move (rest.extra);
    patch.wires.push_back (std::move (*wire));
}

std::optional<Wire> PartReader::parse (const Json& text, const std::string& where)
{
    auto parsed = parseWire (text.asString());
    if (parsed) return *std::move (parsed);
    error ("wire/syntax", where, parsed.error().text, wireRemedy (text.asString()));
    return std::nullopt;
}

void PartReader::checkNumber (const Json& value, const std::string& where)
{
    if (value.is_number()) return;
    if (! value.is_string())
        error ("file/wrong_kind", where, "this should be a number, or a string with a number and a unit", "write 0.5 or \"0.5 N\"");
    else if (const auto measure = parseMeasure (value.asString()); ! measure)
        error ("unit/syntax", where, measure.error().text, "write a number and a unit, such as \"0.4 mm\"");
}

std::optional<Endpoint> PartReader::readEndpoint (const std::string& text, const std::string& where, std::string remedy)
{
    auto parsed = parseEndpoint (text);
    if (parsed) return *std::move (parsed);
    error ("graph/bad_path", where, parsed.error().text, std::move (remedy));
    return std::nullopt;
}

void PartReader::readExpose (Json& object, const std::string& where, Expose& expose)
{
    const auto ports = [&] (std::vector<std::pair<std::string, Endpoint>>& list) -> Read {
        return [this, &list] (Json& v, const std::string& at) {
            for (auto& [id, target] : v.asObject())
            {
                const auto entry = at + '/' + pointerPart (id);
                checkId (id, entry, "a port");
                if (! isKind (target, JsonKind::text, entry)) continue;
                if (auto end = readEndpoint (target.asString(), entry, "write the inner node.port that is exposed"))
                    list.emplace_back (id, std::move (*end));
            }
        };
    };
    read (object, where,
          { { "inputs", JsonKind::object, ports (expose.inputs) },
            { "outputs", JsonKind::object, ports (expose.outputs) },
            { "params", JsonKind::object, ports (expose.params) } },
          expose.extra);
}

void PartReader::readControl (const std::string& id, Json& object, const std::string& where, Control& control)
{
    control.id = id;
    read (object, where,
          { { "name", JsonKind::text, into (control.name) },
            { "value", JsonKind::number, [&] (Json& v, const std::string& at) {
                 control.value = v.get<double>();
                 if (! (control.value >= 0.0 && control.value <= 1.0))
                     error ("file/bad_value", at, "the value of a control must be from 0 to 1, but is " + v.dump(),
                            "the ranges in 'to' define what 0 and 1 mean");
             } },
            { "to", JsonKind::object, [&] (Json& v, const std::string& at) {
                 for (auto& [path, range] : v.asObject())
                     readTarget (path, range, at + '/' + pointerPart (path), control);
             } },
            { "ui", JsonKind::object, keep ("ui", control.extra) } },
          control.extra);
    if (! object.contains ("to"))
        warning ("file/missing_key", where, "the control " + quote (id) + " has no 'to', so it moves nothing",
                 "add \"to\": { \"node.param\": [value at 0, value at 1] }");
}

void PartReader::readTarget (const std::string& path, Json& range, const std::string& where, Control& control)
{
    readEndpoint (path, where, "write node.param, or subgraph/node.param");
    if (! range.is_array() || range.size() != 2)
    {
        error ("file/wrong_kind", where, "the range of " + quote (path) + " should be a list of two values",
               "write [value at 0, value at 1], such as [0, \"0.12 N\"]");
        return;
    }
    checkNumber (range[0], where + "/0");
    checkNumber (range[1], where + "/1");
    control.to.push_back ({ path, std::move (range[0]), std::move (range[1]) });
}

}   // namespace tactus
