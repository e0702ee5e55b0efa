// SPDX-License-Identifier: MIT
#pragma once

#include "graph.hpp"

#include <functional>
#include <string>

namespace tactus::graph
{

/// What an endpoint may stand for.
enum class Side
{
    start,   ///< of a wire, or an output that is shown
    end,     ///< of a wire, or an input that is shown
    param    ///< of controls, overrides, and params that are shown
};

/// A name on the way of an endpoint's path: in which patch it is looked up, and where it stands.
struct Waypoint
{
    const Patch* patch;
    Side side;
    std::string name;         ///< without an instance
    std::size_t begin, end;   ///< in Endpoint::node
};

/// Calls `visit` for each name on the way of each endpoint in a graph, from the outside in, until it returns false. It may
/// rewrite the endpoint, and then is not asked about the rest of that path.
void forEachEndpoint (Graph&, const std::function<bool (Endpoint&, const Waypoint&)>& visit);

/// "grain" of "grain[2]/wave".
std::string firstNameOf (const std::string& path);

}   // namespace tactus::graph
