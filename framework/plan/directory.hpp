// SPDX-License-Identifier: MIT
#pragma once

#include "flat.hpp"
#include "names.hpp"

#include <memory>
#include <vector>

namespace tactus::plan
{

/// Which roles a name may be looked up among, in this order.
enum class Side
{
    start,   ///< of a wire: outputs
    end,     ///< of a wire, or a feed: inputs, then params
    param,   ///< params
    record   ///< outputs, then inputs, then params
};

/// The ports that a name stands for: mostly one, and of a subgraph with a count one in each instance.
using Ports = std::vector<PortRef>;

/// A patch in place: what its names stand for, and what it shows of its inside.
struct Scope
{
    /// What a name in a patch stands for: a node, the instances of a subgraph, or a placeholder (neither).
    struct Member
    {
        int node = -1;
        bool counted = false;                            ///< has a `count`
        std::vector<std::unique_ptr<Scope>> instances;   ///< one without it
    };

    struct Exposed
    {
        Role role;
        std::string name;
        Ports to;   ///< none: a placeholder's
    };

    const graph::Graph* owner = nullptr;
    const graph::Patch* patch = nullptr;
    std::string prefix;   // of paths
    int number = 0;       // in Flat::scopes
    int stand_in = -1;    // the node that has its ports while it is bypassed
    int section = 0;      // in Flat::sections
    Origin origin {};     // of the patch
    Names names;
    std::vector<Member> members;   // by the numbers of their names
    std::vector<Exposed> exposed;

    /// Null if there is none.
    const Member* find (std::string_view name) const noexcept
    {
        const auto known = names.find (name);
        return known == Names::none ? nullptr : &members[known];
    }
};

/// Finds a port by the names people use, from a patch and downwards. Puts into `found` what the name stands for, in the
/// order of instances: nothing for the port of a placeholder. False, with a message added, if there is no such port.
bool find (const graph::Endpoint&, Side, const Scope&, Origin, Flat&, Ports& found);
bool find (std::string_view text, Side, const Scope&, Origin, Flat&, Ports& found);

/// The paths that a path from a patch downwards stands for, with each instance named: "hand/finger" may be "hand/finger[0]"
/// and "hand/finger[1]". What cannot be found stays as it is.
std::vector<std::string> spelledOut (std::string_view path, const Scope&);

/// "a, b, c", or "none"; of many, the first.
std::string listed (const std::vector<std::string>& names);

}   // namespace tactus::plan
