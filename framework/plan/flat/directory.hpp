// SPDX-License-Identifier: MIT
#pragma once

#include "flat.hpp"
#include "names.hpp"

#include <memory>
#include <vector>

namespace tactus::plan
{

/// The roles that are searched for a name, in this order.
enum class Side
{
    start,   ///< start of a wire: outputs
    end,     ///< end of a wire or feed: inputs, then params
    param,   ///< params
    record   ///< outputs, then inputs, then params
};

/// The ports that a name refers to: usually one; for a subgraph with a count, one in each instance.
using Ports = std::vector<PortRef>;

/// An expanded patch: what its names refer to, and the ports it exposes.
struct Scope
{
    /// The member of a patch that a name refers to: a node, the instances of a subgraph, or a placeholder (neither).
    struct Member
    {
        int node = -1;
        bool counted = false;                            ///< has a `count`
        std::vector<std::unique_ptr<Scope>> instances;   ///< exactly one if there is no `count`
    };

    struct Exposed
    {
        Role role;
        std::string name;
        Ports to;   ///< empty for the port of a placeholder
    };

    const graph::Graph* owner = nullptr;
    const graph::Patch* patch = nullptr;
    std::string prefix;   // of the paths of its nodes, such as "finger[3]/"
    int number = 0;       // index in Flat::scopes
    int stand_in = -1;    // number of the node that replaces the subgraph while it is bypassed; else -1
    int section = 0;      // index in Flat::sections
    Origin origin {};     // where the patch was written
    Names names;
    std::vector<Member> members;   // by number of the name in `names`
    std::vector<Exposed> exposed;

    /// The member that a name refers to; null if the patch has no such name.
    const Member* find (std::string_view name) const noexcept
    {
        const auto known = names.find (name);
        return known == Names::none ? nullptr : &members[known];
    }
};

/// Finds a port by its address, such as "drag.mu", relative to a patch. Stores in `found` the ports the name refers to, in the
/// order of instances; none for the port of a placeholder. Returns false and adds a message if there is no such port.
bool find (const graph::Endpoint&, Side, const Scope&, Origin, Flat&, Ports& found);
bool find (std::string_view text, Side, const Scope&, Origin, Flat&, Ports& found);

/// Expands a path into one path per instance: "hand/finger" may become "hand/finger[0]" and "hand/finger[1]". Returns the
/// path unchanged if it cannot be found.
std::vector<std::string> spelledOut (std::string_view path, const Scope&);

/// "a, b, c", or "none"; a long list is truncated.
std::string listed (const std::vector<std::string>& names);

}   // namespace tactus::plan
