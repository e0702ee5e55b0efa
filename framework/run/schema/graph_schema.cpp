// SPDX-License-Identifier: MIT
#include "graph_schema.hpp"
#include "schema_parts.hpp"

#include <tactus/file/migrate.hpp>

#include <set>

namespace tactus
{

namespace schema
{
Json reference (const std::string& definition) { return { { "$ref", "#/$defs/" + definition } }; }
Json never (const std::string& message) { return { { "not", Json::object() }, { "errorMessage", message }, { "doNotSuggest", true } }; }

Json listOf (Json entries, int least, int most)
{
    Json list { { "type", "array" }, { "items", std::move (entries) } };
    if (least > 0) list["minItems"] = least;
    if (most >= 0) list["maxItems"] = most;
    return list;
}
}   // namespace schema

namespace
{
using namespace schema;

/// The ports of all types: what a wire can start from, what it can end at, and what a control can move, if no subgraph has ports of its own.
struct Ports
{
    std::set<std::string_view> outputs, params, ends;

    explicit Ports (const Catalogue& catalogue)
    {
        for (const auto& type : catalogue)
        {
            for (const auto& row : type.outputs)
                outputs.insert (row.id);
            for (const auto& row : type.params)
                params.insert (row.id);
            for (const auto* rows : { &type.inputs, &type.params })
                for (const auto& row : *rows)
                    ends.insert (row.id);
        }
    }
};

std::string oneOf (const std::set<std::string_view>& names)
{
    std::string all;
    for (const auto name : names)
        all += (all.empty() ? "(?:" : "|") + std::string (name);
    return all + ")";
}

Json withPattern (const std::string& pattern, const std::string& message) { return { { "pattern", pattern }, { "patternErrorMessage", message } }; }

/// In a patch without subgraphs every port is a row of some datasheet.
Json patchWithoutSubgraphs (const Ports& ports)
{
    const std::string part = "(?:\\[[0-9]+\\])?(?:\\.[xyz])?\\s*", start = "^[^.]*\\." + oneOf (ports.outputs) + part;
    const auto end = "\\." + oneOf (ports.ends) + part + "$", param = "\\." + oneOf (ports.params) + part + "$";
    auto wire = withPattern (start + "->.*" + end, "no node has such an output, or no node has such an input or parameter");
    wire["properties"] = { { "wire", wire } };
    const auto shown = [] (const std::string& pattern) -> Json { return { { "additionalProperties", withPattern (pattern, "no node has such a port") } }; };
    Json expose { { "inputs", shown (end) }, { "outputs", shown (start + "$") }, { "params", shown (param) } };
    const Json targets { { "propertyNames", withPattern (param, "no node has such a parameter") } };
    Json control { { "properties", { { "to", targets } } } };
    const Json is_plain { { "properties", { { "type", { { "not", { { "pattern", "^(?:graph|file):" } } } } } } } };
    return { { "if", { { "properties", { { "nodes", { { "additionalProperties", is_plain } } } } } } },
             { "then",
               { { "properties",
                   { { "wires", { { "items", std::move (wire) } } },
                     { "expose", { { "properties", std::move (expose) } } },
                     { "controls", { { "additionalProperties", std::move (control) } } } } } } } };
}
}   // namespace

Json graphSchema (const Catalogue& catalogue)
{
    auto schema = base();
    schema["properties"]["version"]["const"] = graph_format.version;
    auto& definitions = schema["$defs"];
    Quantities quantities;
    definitions["device"] = deviceOf (quantities);

    std::vector<std::string> ids;
    auto by_type = Json::array();
    for (const auto& type : catalogue)
    {
        const std::string id (type.info.id);
        ids.push_back (id);
        definitions["node." + id] = nodeOf (type, quantities);
        by_type.push_back ({ { "if", { { "properties", { { "type", { { "const", id } } } } }, { "required", Json::array ({ "type" }) } } },
                             { "then", reference ("node." + id) } });
    }
    definitions["type"]["anyOf"].asArray().insert (definitions["type"]["anyOf"].asArray().begin(), Json { { "enum", ids } });
    definitions["node"]["allOf"] = std::move (by_type);
    quantities.define (definitions);

    definitions["plain_patch"] = patchWithoutSubgraphs (Ports { catalogue });
    schema["allOf"] = Json::array ({ reference ("plain_patch") });
    definitions["subgraph"]["allOf"] = schema["allOf"];
    for (const auto* object : { "node", "wire", "expose", "control", "subgraph" })
        refuseMisspelt (definitions[object]);
    refuseMisspelt (schema);
    return schema;
}

}   // namespace tactus
