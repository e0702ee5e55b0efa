// SPDX-License-Identifier: MIT
#pragma once

#include "graph.hpp"

#include <tactus/text/result.hpp>

#include <string>
#include <string_view>

namespace tactus::graph
{

/// Ids of nodes, ports, params, controls, subgraphs and roles match [a-z][a-z0-9_]*.
bool isId (std::string_view) noexcept;

/// The longest delay of a wire, in ticks: several minutes. A tick or two is enough to open a loop.
inline constexpr int longest_delay = 1'000'000;

/// Reads "hand.position.x", "mix.in[2]", "grain/wave.phase", "finger[3]/drag.mu". An error (port/syntax) has neither a location
/// nor a remedy.
Result<Endpoint> parseEndpoint (std::string_view);

/// Reads the key of an override, which is relative to its node: an endpoint, or "[3]/drag.mu" for one instance, whose path is then
/// "[3]/drag". Errors as for parseEndpoint.
Result<Endpoint> parseOverride (std::string_view);

/// Reads "a.out -> b.in", "a.out -> [3] -> b.in", "a.out -> [1] -> (+) b.mu". An error (wire/syntax) has neither a location nor a
/// remedy.
Result<Wire> parseWire (std::string_view);

std::string toText (const Endpoint&);
std::string toText (const Wire&);   ///< without gain and enabled

}   // namespace tactus::graph
