// SPDX-License-Identifier: MIT
#pragma once

#include "graph.hpp"

#include <functional>
#include <string>

namespace tactus::graph
{

/// The kind of port that an endpoint refers to.
enum class Side
{
    start,   ///< start of a wire, or exposed output
    end,     ///< end of a wire, or exposed input
    param    ///< parameter that a control, an override or an exposed parameter refers to
};

/// A name in the path of an endpoint: the patch in which it is looked up, and its position.
struct Waypoint
{
    const Patch* patch;
    Side side;
    std::string name;         ///< without an instance
    std::size_t begin, end;   ///< where the name, with its instance, begins and ends in Endpoint::node
};

/// Calls `visit` for each name in the path of each endpoint of a graph, from the outside in, until it returns false. If `visit`
/// rewrites the endpoint, the rest of that path is skipped.
void forEachEndpoint (Graph&, const std::function<bool (Endpoint&, const Waypoint&)>& visit);

/// Returns "grain" for "grain[2]/wave".
std::string firstNameOf (const std::string& path);

}   // namespace tactus::graph
