// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "face.hpp"

#include <map>

namespace tactus::host
{

/// The quantity each port of a graph carries, generic ports included: it propagates along wires, through nodes, and in and out
/// of subgraphs. For display only; compile() decides whether units match.
class Quantities
{
public:
    Quantities (const graph::Graph&, const Catalogue&);

    /// Returns `any` if unknown. The patch belongs to that graph; `node` is an index into it.
    Quantity of (const graph::Patch&, std::size_t node, Role, std::string_view port) const;

private:
    struct NodePorts
    {
        Face face;
        int first;   ///< number of the node's first port; params follow inputs, outputs follow params
    };

    struct PatchPorts
    {
        std::vector<NodePorts> nodes;   ///< in the order of the patch's nodes
        std::map<std::string_view, std::size_t> by_name;
    };

    void visit (const graph::Graph& owner, const graph::Patch&);
    void joinPortsOf (const NodePorts&);
    bool joinProducts();
    bool isPlainFactor (const graph::Patch&, const NodePorts&, const FacePort&);   ///< it has no unit, or nothing drives it
    void joinAlongWires (const graph::Patch&);
    void joinWithInside (const graph::Graph& owner, const graph::Patch&);

    const NodePorts* portsOf (const graph::Patch&, std::string_view node) const;
    static int numberOf (const NodePorts&, const FacePort*);   ///< -1 if there is no such port
    int root (int port);                                       ///< shortens the way to the root
    void join (int a, int b);

    const Catalogue& catalogue;
    std::map<const graph::Patch*, PatchPorts> patches;
    std::vector<int> parent;       // union-find: ports that carry the same quantity share a root; once made, each has its root as parent
    std::vector<Quantity> known;   // by port: its quantity; valid only at the roots
};

}   // namespace tactus::host
