// SPDX-License-Identifier: MIT
#pragma once

/// A graph as people edit and save it: plain data, in the order it was written. Nothing here has been checked against
/// the catalogue; framework/plan/compile.hpp does that. Change a graph only through framework/graph/edit.hpp.

#include <framework/json.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tactus::graph
{

/// Identity for life. Names only address; state follows the id through rename and regrouping. Unique in a process,
/// not written to files.
using Id = std::uint64_t;

Id newId() noexcept;   // [any thread]

/// What a copy was made from, or a node that stands for several; then which of them.
struct Ancestor
{
    Id id = 0;
    int instance = 0;

    bool operator== (const Ancestor&) const = default;
};

/// One end of a wire or a port address: `node.port`, `in[2]`, `position.x`, `finger[3].x`, `grain/wave.phase`.
struct Endpoint
{
    std::string node;   ///< path: names joined by '/', each perhaps with an instance "[3]" or "[*]"
    std::string port;
    int index = -1;       ///< entry of an array port, -1 for none
    int component = -1;   ///< 0, 1, 2 for .x, .y, .z; -1 for the whole port

    bool operator== (const Endpoint&) const = default;
};

struct Wire
{
    Id id = newId();
    std::vector<Ancestor> origin {};   ///< of a copy that expanding made: the subgraph nodes around what it is a copy of, and that; state follows
    Endpoint from, to;
    int delay = 0;                 ///< ticks; 0 is no delay
    bool add = false;              ///< `(+)`: onto a parameter's stored value instead of replacing it
    Json gain;                     ///< as written: null, a number, or a string with a unit
    std::optional<bool> enabled;   ///< as written; a wire is enabled unless it says otherwise
    Json extra = Json::object();   ///< `ui` and unknown keys
};

struct Node
{
    Id id = newId();
    std::vector<Ancestor> origin {};   ///< as of a wire
    std::string name;
    std::string type;               ///< id in the catalogue, "graph:NAME" or "file:path.json"
    std::string role;               ///< of a device node
    Json params = Json::object();   ///< values as written, so that "0.4 mm" stays "0.4 mm"
    Json settings = Json::object();
    Json roles;                        ///< subgraph: inner role to outer role
    Json overrides = Json::object();   ///< subgraph: inner params, relative to this node
    bool bypass = false;
    Json extra = Json::object();   ///< `count`, `every`, `times`, `hold`, and unknown keys
};

/// What a subgraph shows of its inside, in order.
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
        std::string path;   ///< node.param, paths into subgraphs allowed
        Json low, high;     ///< as written
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
    std::vector<std::pair<std::string, Json>> devices;   ///< role and its description, for the host
    Patch root;
    std::vector<Control> controls;
    std::vector<std::pair<std::string, Patch>> graphs;   ///< subgraphs by name
    Json extra = Json::object();                         ///< `ui` and unknown keys

    std::string folder;                                          ///< where relative paths start; not saved
    std::map<std::string, std::shared_ptr<const Graph>> files;   ///< loaded "file:" subgraphs by path as written; not saved

    const Patch* find (std::string_view subgraph) const noexcept;
};

}   // namespace tactus::graph
