// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/graph/graph.hpp>
#include <tactus/kit/at.hpp>
#include <tactus/plan/flat/names.hpp>

#include <string_view>
#include <vector>

namespace tactus::plan
{

/// The wires at each node of a graph itself (not of its subgraphs). Nodes and wires have the numbers of their places in the lists.
class GraphIndex
{
public:
    static constexpr int none = -1;

    struct Links
    {
        std::vector<int> in {}, out {};
    };

    /// Takes in what was added at the end of the lists since the last call. If the lists may have changed otherwise, forget() comes first.
    void follow (const graph::Patch&);
    void forget() { *this = {}; }

    /// Notes that a wire has been removed. The numbers of those after it change.
    void remove (graph::Id wire);

    /// The number of the node that a path begins with, "grain" in "grain[2]/wave"; or `none`.
    int node (std::string_view path) const noexcept;

    const Links& at (int node) const { return links[tactus::at (node)]; }
    int start (int wire) const { return ends[tactus::at (wire)].from; }
    int end (int wire) const { return ends[tactus::at (wire)].to; }

private:
    struct Ends
    {
        int from, to;
        graph::Id id;
    };

    Names names;
    std::vector<Links> links;
    std::vector<Ends> ends;
};

}   // namespace tactus::plan
