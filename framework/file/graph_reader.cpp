// SPDX-License-Identifier: MIT
#include "graph_file.hpp"
#include "migrate.hpp"

#include <tactus/graph/part_reader.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tactus
{
namespace
{
using namespace graph;

class GraphReader : public PartReader
{
public:
    void readFile (Json& file, Graph& graph)
    {
        const auto ignore = [] (Json&, const std::string&) {};
        std::vector<KnownKey> fields {
            { "$schema", JsonKind::text, keep ("$schema", graph.extra) },   // for editors
            { "format", JsonKind::any, ignore },
            { "version", JsonKind::any, ignore },
            { "name", JsonKind::text, into (graph.name) },
            { "about", JsonKind::text, into (graph.about) },
            { "tags", JsonKind::list, [&] (Json& v, const std::string& at) { readTags (v, at, graph.tags); } },
            { "rate_hz", JsonKind::number,
              [&] (Json& v, const std::string& at) {
                  graph.rate_hz = v.get<double>();
                  if (! (graph.rate_hz > 0.0))
                      error ("file/bad_value", at, "the rate is " + v.dump() + " Hz; it should be more than 0", "4000 suits most devices");
              } },
            { "devices", JsonKind::object, [&] (Json& v, const std::string& at) { readDevices (v, at, graph); } },
            { "controls", JsonKind::object,
              [&] (Json& v, const std::string& at) {
                  eachId (v, at, "a control",
                          [&] (const std::string& id, Json& control,
                               const std::string& where) { readControl (id, control, where, graph.controls.emplace_back()); });
              } },
            { "graphs", JsonKind::object,
              [&] (Json& v, const std::string& at) {
                  eachId (v, at, "a subgraph",
                          [&] (const std::string& id, Json& patch,
                               const std::string& where) { readSubgraph (patch, where, graph.graphs.emplace_back (id, Patch {}).second); });
              } },
            { "ui", JsonKind::object, keep ("ui", graph.extra) },
        };
        addPatch (fields, graph.root);
        read (file, "", fields, graph.extra);
    }

private:
    void readTags (Json& list, const std::string& where, std::vector<std::string>& tags)
    {
        for (std::size_t i = 0; i < list.size(); ++i)
            if (isKind (list[i], JsonKind::text, where + '/' + std::to_string (i)))
                tags.push_back (std::move (list[i].asString()));
    }

    void readDevices (Json& object, const std::string& where, Graph& graph)
    {
        eachId (object, where, "a role",
                [&] (const std::string& role, Json& description, const std::string&) { graph.devices.emplace_back (role, std::move (description)); });
    }
};

/// Checks what must be right before anything else is read. Returns the version.
std::optional<int> readHeader (const Json& file, OrderedReader& problems)
{
    const auto remedy = "a graph file begins with { \"format\": \"tactus-graph\", \"version\": " + std::to_string (graph_format.version) + ", …";
    if (! file.is_object())
    {
        problems.error ("file/not_a_graph", "", "the file does not contain an object, {…}, so it is not a graph", remedy);
        return std::nullopt;
    }
    const auto format = file.find ("format");
    if (format == file.end() || *format != "tactus-graph")
    {
        if (format == file.end())
            problems.error ("file/not_a_graph", "", "the file has no 'format', so it is not a graph", remedy);
        else
            problems.error ("file/not_a_graph", "/format", "the 'format' of the file is not \"tactus-graph\"", remedy);
        return std::nullopt;
    }
    const auto version = file.find ("version");
    if (version == file.end())
    {
        problems.error ("file/missing_key", "", "the file has no 'version'", "add \"version\": " + std::to_string (graph_format.version));
        return std::nullopt;
    }
    if (! problems.isKind (*version, JsonKind::number, "/version")) return std::nullopt;
    const double n = version->get<double>();
    constexpr double most = 1e6;
    if (! (n >= 0.0 && n <= most && n == std::floor (n)))
    {
        problems.error ("file/bad_value", "/version", "the version is " + version->dump() + "; it should be a whole number",
                        "write \"version\": " + std::to_string (graph_format.version));
        return std::nullopt;
    }
    return static_cast<int> (n);
}
}   // namespace

TextPosition LoadedGraph::positionOf (std::string_view pointer) const { return tactus::positionOf (positions, pointer); }

LoadedGraph readGraph (std::string_view text, double most_values) { return readGraph (text, graph_format, most_values); }

LoadedGraph readGraph (std::string_view text, const FileFormat& format, double most_values)
{
    auto json = readJson (text, most_values);
    LoadedGraph loaded;
    loaded.values = json.values;
    loaded.positions = std::move (json.positions);

    GraphReader reader;
    reader.messages = std::move (json.messages);
    const bool whole = std::ranges::none_of (reader.messages, [] (const Message& m) { return m.id != "file/duplicate_key"; });
    if (whole)
        if (const auto version = readHeader (json.root, reader))
        {
            if (auto migrated = migrate (json.root, *version, format))
                reader.readFile (json.root, loaded.graph);
            else
                reader.messages.push_back (std::move (migrated).error());
        }

    loaded.messages = std::move (reader.messages);
    for (auto& m : loaded.messages)
        if (m.line == 0)
        {
            const auto position = loaded.positionOf (m.where);
            m.line = position.line;
            m.column = position.column;
        }
    std::ranges::stable_sort (loaded.messages, {}, [] (const Message& m) { return std::tuple (m.line, m.column); });
    return loaded;
}

}   // namespace tactus
