// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "face.hpp"

#include <map>

namespace tactus::host
{

/// What the ports of a graph carry, also those that take on whatever is wired to them: it is followed along wires,
/// through nodes, and in and out of subgraphs. For the eye; whether units fit is what compile() says.
class Quantities
{
public:
    Quantities (const graph::Graph&, const Catalogue&);

    /// Any, where nothing says. The patch is one of that graph, the node's number counts within it.
    Quantity of (const graph::Patch&, std::size_t node, Role, std::string_view port) const;

private:
    struct Seat
    {
        Face face;
        int first;   ///< number of its first port; params follow inputs, outputs follow params
    };

    struct Row
    {
        std::vector<Seat> seats;   ///< of the nodes of a patch, in their order
        std::map<std::string_view, std::size_t> by_name;
    };

    void visit (const graph::Graph& owner, const graph::Patch&);
    void followNode (const Seat&);
    void followWires (const graph::Patch&);
    void followInside (const graph::Graph& owner, const graph::Patch&);

    const Seat* seatOf (const graph::Patch&, std::string_view node) const;
    static int numberOf (const Seat&, const FacePort*);   ///< -1 for none
    int root (int port) const;
    void join (int a, int b);

    const Catalogue& catalogue;
    std::map<const graph::Patch*, Row> rows;
    std::vector<int> towards;   // of ports that carry the same, one; in the end itself
    std::vector<Quantity> known;
};

}   // namespace tactus::host
