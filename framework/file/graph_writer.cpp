// SPDX-License-Identifier: MIT
#include "atomic_file.hpp"
#include "graph_file.hpp"
#include "migrate.hpp"

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/graph_parts.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/json_writer.hpp>

#include <array>
#include <cmath>

namespace tactus
{
namespace
{
using namespace graph;

constexpr std::string_view schema_key = "$schema";   // names the JSON schema, which editors look for at the top of a file

/// Whole numbers are written without a point.
Json plainNumber (double value)
{
    constexpr double most = 1e15;
    if (value == std::floor (value) && std::abs (value) < most) return static_cast<std::int64_t> (value);
    return value;
}

void appendText (Json& object, std::string key, const std::string& text)
{
    if (! text.empty()) append (object, std::move (key), text);
}

void appendUnlessEmpty (Json& object, std::string key, const Json& value)
{
    if (! value.empty()) append (object, std::move (key), value);
}

/// Adds the keys that the reader has kept, with `ui` at the end, because `ui` matters least in a diff. A `$schema` of the file is the first
/// key already.
void appendExtra (Json& object, const Json& extra)
{
    const Json* ui = nullptr;
    for (const auto& [key, value] : extra.asObject())
        if (key == "ui")
            ui = &value;
        else if (key != schema_key || ! object.contains (schema_key))
            append (object, key, value);
    if (ui != nullptr) append (object, "ui", *ui);
}

void appendPatch (Json& object, const Patch& patch)
{
    auto nodes = Json::object();
    for (const auto& node : patch.nodes)
        append (nodes, node.name, toJson (node));
    append (object, "nodes", std::move (nodes));

    auto wires = Json::array();
    for (const auto& wire : patch.wires)
        wires.push_back (toJson (wire));
    append (object, "wires", std::move (wires));
    appendUnlessEmpty (object, "expose", toJson (patch.expose));
}

Json graphJson (const Graph& graph)
{
    auto file = Json::object();
    if (const auto schema = graph.extra.find (schema_key); schema != graph.extra.end()) append (file, std::string (schema_key), *schema);
    append (file, "format", "tactus-graph");
    append (file, "version", graph_format.version);
    appendText (file, "name", graph.name);
    appendText (file, "about", graph.about);
    if (! graph.tags.empty()) append (file, "tags", graph.tags);
    append (file, "rate_hz", plainNumber (graph.rate_hz));

    auto devices = Json::object();
    for (const auto& [role, description] : graph.devices)
        append (devices, role, description);
    appendUnlessEmpty (file, "devices", devices);

    appendPatch (file, graph.root);

    auto controls = Json::object();
    for (const auto& control : graph.controls)
        append (controls, control.id, toJson (control));
    appendUnlessEmpty (file, "controls", controls);

    auto subgraphs = Json::object();
    for (const auto& [name, patch] : graph.graphs)
        append (subgraphs, name, toJson (patch));
    appendUnlessEmpty (file, "graphs", subgraphs);
    appendExtra (file, graph.extra);
    return file;
}
}   // namespace

Json toJson (const graph::Node& node)
{
    auto object = Json::object();
    append (object, "type", node.type);
    appendText (object, "role", node.role);
    appendUnlessEmpty (object, "roles", node.roles);
    appendUnlessEmpty (object, "params", node.params);
    appendUnlessEmpty (object, "settings", node.settings);
    appendUnlessEmpty (object, "overrides", node.overrides);
    if (node.bypass) append (object, "bypass", true);
    appendExtra (object, node.extra);
    return object;
}

Json toJson (const graph::Wire& wire)
{
    const auto text = toText (wire);
    if (wire.gain.is_null() && ! wire.enabled && wire.extra.empty()) return text;
    auto object = Json::object();
    append (object, "wire", text);
    if (! wire.gain.is_null()) append (object, "gain", wire.gain);
    if (wire.enabled) append (object, "enabled", *wire.enabled);
    appendExtra (object, wire.extra);
    return object;
}

Json toJson (const graph::Expose& expose)
{
    auto object = Json::object();
    const auto ports = [&] (std::string key, const std::vector<std::pair<std::string, Endpoint>>& list) {
        auto shown = Json::object();
        for (const auto& [id, end] : list)
            append (shown, id, toText (end));
        appendUnlessEmpty (object, std::move (key), shown);
    };
    ports ("inputs", expose.inputs);
    ports ("outputs", expose.outputs);
    ports ("params", expose.params);
    appendExtra (object, expose.extra);
    return object;
}

Json toJson (const graph::Control& control)
{
    auto object = Json::object();
    appendText (object, "name", control.name);
    append (object, "value", plainNumber (control.value));
    auto to = Json::object();
    for (const auto& target : control.to)
        append (to, target.path, Json::array ({ target.low, target.high }));
    append (object, "to", std::move (to));
    appendExtra (object, control.extra);
    return object;
}

Json toJson (const graph::Patch& patch)
{
    auto object = Json::object();
    appendPatch (object, patch);
    appendExtra (object, patch.extra);
    return object;
}

std::string writeGraph (const Graph& graph)
{
    static constexpr std::array<std::string_view, 5> one_a_line { "devices", "nodes", "wires", "controls", "graphs" };
    return writeJson (graphJson (graph), one_a_line);
}

Result<> saveGraph (const Graph& graph, const std::filesystem::path& path)
{
    const auto failed = [&] (const Message& why) {
        auto m = Message::error (why.id, {}, path.string() + " " + why.text, "choose another file or folder");
        m.file = path.string();
        return m;
    };
    auto file = AtomicFile::create (path);
    if (! file) return failed (file.error());
    file->stream() << writeGraph (graph);
    if (auto done = file->commit(); ! done) return failed (done.error());
    return {};
}

}   // namespace tactus
