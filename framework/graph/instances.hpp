// SPDX-License-Identifier: MIT
#pragma once

/// A subgraph node with a `count` stands for several instances, counted from 0. In a path "finger[3]" names one of them,
/// "finger[*]" and plain "finger" all.

#include "graph.hpp"

#include <optional>
#include <string_view>

namespace tactus::graph
{

/// The largest `count` there can be.
inline constexpr int most_instances = 1'000'000;

/// The `count` of a node, if it has one; 0 if that is no whole number from 1 to most_instances.
std::optional<int> countOf (const Node&) noexcept;

/// The first name of a path, and which of its instances is meant.
struct PathStep
{
    static constexpr int not_said = -2, all = -1;

    std::string_view name;
    int instance = not_said;   ///< its number, or one of the two
    std::string_view rest;     ///< of the path, without the '/'
};

PathStep firstStep (std::string_view path) noexcept;

/// How many names of a path, or of the path of a port, say one instance: "a[3]/b[*]/c.in[2]" is 1. Of two values for one
/// parameter the one whose path says more holds.
int instancesSaid (std::string_view) noexcept;

/// How far from its beginning a text, in which instances are named one by one, is what a path or port stands for: all but
/// the ".x" of "finger[3].force.x" for "finger.force", "finger[*].force" and "finger[3].force". Nothing if it is not.
std::optional<std::size_t> covers (std::string_view name, std::string_view text) noexcept;

/// By what a node or a wire is known, or one of the instances of a node: what it is a copy of, or itself.
template <typename Thing>
std::vector<Ancestor> ancestryOf (const Thing& x, int instance = 0)
{
    if (x.origin.empty() || (instance > 0 && x.origin.back().instance > 0)) return { { x.id, instance } };
    auto ancestry = x.origin;
    ancestry.back().instance += instance;
    return ancestry;
}

}   // namespace tactus::graph
