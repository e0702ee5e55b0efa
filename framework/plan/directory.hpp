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

/// A patch in place: what its names stand for, and what it shows of its inside.
struct Scope
{
    /// What a name in a patch stands for: a node, a placeholder (neither), or a subgraph. A bypassed subgraph is both.
    struct Member
    {
        int node = -1;
        std::unique_ptr<Scope> inside;
    };

    struct Exposed
    {
        Role role;
        std::string name;
        std::optional<PortRef> to;
    };

    const graph::Graph* owner = nullptr;
    const graph::Patch* patch = nullptr;
    std::string prefix;   // of paths
    int number = 0;       // in Flat::scopes
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

/// Finds a port by the names people use, from a patch and downwards; nothing, with a message added, if there is none.
/// A placeholder's port gives nothing too, without a message.
std::optional<PortRef> find (const graph::Endpoint&, Side, const Scope&, Origin, Flat&);
std::optional<PortRef> find (std::string_view text, Side, const Scope&, Origin, Flat&);

/// "a, b, c", or "none"; of many, the first.
std::string listed (const std::vector<std::string>& names);

}   // namespace tactus::plan
