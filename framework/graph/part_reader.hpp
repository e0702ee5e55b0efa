// SPDX-License-Identifier: MIT
#pragma once

/// Reads the parts of a graph file: patches, nodes, wires, exposed ports, controls.

#include <tactus/text/json_text.hpp>
#include <tactus/text/ordered_reader.hpp>

#include "endpoint_text.hpp"
#include "graph.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tactus
{

class PartReader : public OrderedReader
{
public:
    void readSubgraph (Json& object, const std::string& where, graph::Patch&);
    void readNode (const std::string& name, Json& object, const JsonPlace&, graph::Node&);
    void readWire (Json& value, const std::string& where, graph::Patch&);
    void readWire (Json& value, const std::string& list, std::size_t number, graph::Patch&);   ///< an entry of the list of wires
    void readExpose (Json& object, const std::string& where, graph::Expose&);
    void readControl (const std::string& id, Json& object, const std::string& where, graph::Control&);
    bool checkId (const std::string& id, const std::string& where, std::string_view what);

protected:
    using Read = std::function<void (Json&, const std::string&)>;

    /// Adds the keys of a patch to the known keys of an object that has other keys too.
    void addPatch (std::vector<KnownKey>&, graph::Patch&);

    /// Visits the members of an object whose keys are ids and whose values are objects.
    template <typename F>
    void eachId (Json& object, const std::string& where, std::string_view what, F&& each)
    {
        const JsonPlace around (where);
        for (auto& [id, value] : object.asObject())
        {
            const JsonPlace at (around, id);
            if (! graph::isId (id)) checkId (id, at, what);
            if (matches (value, JsonKind::object) || isKind (value, JsonKind::object, at)) each (id, value, at);
        }
    }

    static Read into (std::string& text)
    {
        return [&text] (Json& v, const std::string&) { text = std::move (v.asString()); };
    }

    static Read keep (std::string key, Json& extra)
    {
        return [key = std::move (key), &extra] (Json& v, const std::string&) { append (extra, key, std::move (v)); };
    }

private:
    void readType (std::string& type, const JsonPlace&, graph::Node&);
    void readValues (Json& object, const JsonPlace&, std::string_view what, Json& values);
    void readRoles (Json& object, const std::string& where, graph::Node&);
    void readOverrides (Json& object, const std::string& where, graph::Node&);
    void readCount (const std::string& key, Json& value, const std::string& where, Json& extra);
    std::optional<graph::Wire> parse (const Json& text, const std::string& where);
    void checkNumber (const Json&, const std::string& where);   ///< a number, or a string with a unit
    std::optional<graph::Endpoint> readEndpoint (const std::string& text, const std::string& where, std::string remedy);
    void readTarget (const std::string& path, Json& range, const std::string& where, graph::Control&);
};

}   // namespace tactus
