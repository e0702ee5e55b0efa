// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/graph/edit.hpp>

#include <cstddef>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace tactus::plan
{

/// Finds nodes and wires of a graph itself (not of its subgraphs) without a search: by name, by id, and the wires at a node. It follows
/// edits; after an edit that it cannot follow, it is made again when it is needed. [main thread]
class GraphIndex
{
public:
    using Ids = std::vector<graph::Id>;

    /// The wires at a node, by the first name in their path.
    struct Links
    {
        Ids in {}, out {};
        mutable std::size_t place = 0;   ///< where the node was found last
    };

    /// Notes an edit that has been carried out.
    void follow (const graph::Command&, const graph::Command& inverse);

    /// Call this before the functions below, with the graph as it is now.
    void see (const graph::Graph&);

    const graph::Node* node (const std::string& name) const;
    const graph::Wire* wire (graph::Id) const;
    std::size_t placeOf (const graph::Wire& w) const { return static_cast<std::size_t> (&w - graph->root.wires.data()); }
    const Links& at (const std::string& name) const;

    /// A port of a node of the graph itself where two wires end, or did.
    struct Joint
    {
        std::string node, port;
    };

    /// The joints that were found since the last call.
    std::vector<Joint> takeJoints() { return std::exchange (joints, {}); }

    /// Changes whenever all joints are found again.
    int generation() const noexcept { return made; }

    /// True if two wires, one of them inside a subgraph, may end at one port.
    bool joinsInside() const noexcept { return joins_inside; }

    /// True if a subgraph has `every` or `times`. May be true although there is none any more.
    bool mayHaveSections() const noexcept { return has_sections; }

private:
    struct Ends
    {
        std::string from, to, head;   // head: "node.port[entry"
        mutable std::size_t place = 0;
    };

    void add (const graph::Wire&, std::size_t place);
    void remove (graph::Id);
    void note (const graph::Node&);
    void note (const graph::Patch&);

    const graph::Graph* graph = nullptr;
    bool is_known = false;
    int made = 0;
    bool joins_inside = false, has_sections = false;
    std::size_t nodes = 0;   // where a node goes that is added at the end
    std::vector<Joint> joints;
    std::unordered_map<std::string, Links> links;
    std::unordered_map<graph::Id, Ends> wires;
    std::unordered_map<std::string, int> heads;   // how many wires end there

    friend struct GraphIndexFollower;
};

/// "grain" for "grain[2]/wave".
inline std::string firstName (const std::string& path) { return path.substr (0, path.find_first_of ("[/")); }

}   // namespace tactus::plan
