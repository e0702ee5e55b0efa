// SPDX-License-Identifier: MIT
#pragma once

/// A graph as people edit and save it: plain data, in the order it was written. It is not checked against the catalogue; that
/// happens in framework/plan/compile.hpp. Change a graph only through framework/graph/edit.hpp.

#include <tactus/text/json.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tactus::graph
{

/// A permanent identity. Names are only addresses; state follows the id through renaming and regrouping. Unique in a process,
/// not written to files.
using Id = std::uint64_t;

Id newId() noexcept;   // [any thread]

/// The node or wire that a copy was made from; for one of several instances, also the number of that instance.
struct Ancestor
{
    Id id = 0;
    int instance = 0;

    bool operator== (const Ancestor&) const = default;
};

/// One end of a wire or a port address: `node.port`, `in[2]`, `position.x`, `finger[3].x`, `grain/wave.phase`.
struct Endpoint
{
    std::string node;   ///< path: names joined by '/', each with an optional instance "[3]" or "[*]"
    std::string port;
    int index = -1;       ///< entry of an array port, -1 for none
    int component = -1;   ///< 0, 1, 2 for .x, .y, .z; -1 for the whole port

    bool operator== (const Endpoint&) const = default;
};

struct Wire
{
    Id id = newId();
    std::vector<Ancestor> origin {};   ///< for a copy made by expanding: the subgraph nodes around the original, then the original; the copy keeps its state
    Endpoint from, to;
    int delay = 0;                 ///< in ticks; 0: no delay
    bool add = false;              ///< `(+)`: adds to the stored value of a parameter instead of replacing it
    Json gain;                     ///< as written: null, a number, or a string with a unit
    std::optional<bool> enabled;   ///< as written; a wire is enabled by default
    Json extra = Json::object();   ///< `ui` and unknown keys
};

struct Node
{
    Id id = newId();
    std::vector<Ancestor> origin {};   ///< as in Wire
    std::string name;
    std::string type;               ///< id in the catalogue, "graph:NAME" or "file:path.json"
    std::string role;               ///< role of a device node; empty for other nodes
    Json params = Json::object();   ///< values as written, so that "0.4 mm" stays "0.4 mm"
    Json settings = Json::object();
    Json roles;                        ///< of a subgraph node: maps inner roles to outer ones
    Json overrides = Json::object();   ///< of a subgraph node: values of inner params, by their paths relative to this node
    bool bypass = false;
    Json extra = Json::object();   ///< `count`, `every`, `times`, `hold`, and unknown keys

    bool isSubgraph() const noexcept { return type.starts_with ("graph:") || type.starts_with ("file:"); }
};

/// The ports that a subgraph exposes, in order.
struct Expose
{
    std::vector<std::pair<std::string, Endpoint>> inputs, outputs, params;
    Json extra = Json::object();   ///< unknown keys
};

/// Nodes and wires: the body of a graph, and of each subgraph.
struct Patch
{
    std::vector<Node> nodes;
    std::vector<Wire> wires;
    Expose expose;
    Json extra = Json::object();   ///< `ui` and unknown keys

    const Node* find (std::string_view name) const noexcept;
};

struct Control
{
    struct Target
    {
        std::string path;   ///< node.param; may lead into subgraphs
        Json low, high;     ///< values of the parameter when the control is at 0 and at 1, as written
    };

    std::string id, name;
    double value = 0.5;   ///< 0…1
    std::vector<Target> to;
    Json extra = Json::object();
};

struct Graph
{
    std::string name, about;
    std::vector<std::string> tags;
    double rate_hz = 4000.0;
    std::vector<std::pair<std::string, Json>> devices;   ///< descriptions of devices, by role; for the host
    Patch root;
    std::vector<Control> controls;
    std::vector<std::pair<std::string, Patch>> graphs;   ///< subgraphs by name
    Json extra = Json::object();                         ///< `ui` and unknown keys

    std::string folder;                                          ///< base of relative paths; not saved
    std::map<std::string, std::shared_ptr<const Graph>> files;   ///< loaded "file:" subgraphs by path as written; not saved

    const Patch* find (std::string_view subgraph) const noexcept;

    /// The description of a role's device; null if there is none.
    const Json* device (std::string_view role) const noexcept;
};

}   // namespace tactus::graph
