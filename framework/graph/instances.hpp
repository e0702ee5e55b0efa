// SPDX-License-Identifier: MIT
#pragma once

/// A subgraph node with a `count` has several instances, numbered from 0. In a path, "finger[3]" names one of them; "finger[*]" and
/// plain "finger" name all of them.

#include "graph.hpp"

#include <optional>
#include <string_view>

namespace tactus::graph
{

/// The largest `count`.
inline constexpr int most_instances = 1'000'000;

/// The `count` of a node, if it has one; 0 if it is not a whole number from 1 to most_instances.
std::optional<int> countOf (const Node&) noexcept;

/// The first name of a path, and its instance.
struct PathStep
{
    static constexpr int unspecified = -2, all = -1;

    std::string_view name;
    int instance = unspecified;   ///< number of the instance, or `all` for "[*]", or `unspecified`
    std::string_view rest;        ///< the rest of the path, without the '/'
};

PathStep firstStep (std::string_view path) noexcept;

/// The number of names in the path of a node or port that have a single instance: 1 for "a[3]/b[*]/c.in[2]". If two values are given for one
/// parameter, the value with the larger number takes precedence.
int namedInstances (std::string_view) noexcept;

/// Matches the path or port `name` against the beginning of `text`, in which every instance is named. Returns the length of the
/// match; empty if `name` does not match. "finger.force", "finger[*].force" and "finger[3].force" match all of
/// "finger[3].force.x" except ".x".
std::optional<std::size_t> covers (std::string_view name, std::string_view text) noexcept;

/// The ancestry of a node, a wire, or an instance of a node: for a copy, its origin; for anything else, the thing itself.
template <typename Thing>
std::vector<Ancestor> ancestryOf (const Thing& x, int instance = 0)
{
    if (x.origin.empty() || (instance > 0 && x.origin.back().instance > 0)) return { { x.id, instance } };
    auto ancestry = x.origin;
    ancestry.back().instance += instance;
    return ancestry;
}

}   // namespace tactus::graph
