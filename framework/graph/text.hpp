// SPDX-License-Identifier: MIT
#pragma once

#include "graph.hpp"

#include <string>
#include <string_view>
#include <variant>

namespace tactus::graph
{

/// Ids of nodes, ports, params, controls, subgraphs and roles match [a-z][a-z0-9_]*.
bool isId (std::string_view) noexcept;

/// The longest delay a wire text may ask for: minutes, where a tick or two opens a loop.
inline constexpr int longest_delay = 1'000'000;

/// Reads "hand.position.x", "mix.in[2]", "grain/wave.phase", "finger[3]/drag.mu"; or says what is wrong.
std::variant<Endpoint, std::string> parseEndpoint (std::string_view);

/// Reads the key of an override, which is relative to its node: as an endpoint, and "[3]/drag.mu" for one instance,
/// whose path is then "[3]/drag".
std::variant<Endpoint, std::string> parseOverride (std::string_view);

/// Reads "a.out -> b.in", "a.out -> [3] -> b.in", "a.out -> [1] -> (+) b.mu"; or says what is wrong.
std::variant<Wire, std::string> parseWire (std::string_view);

std::string toText (const Endpoint&);
std::string toText (const Wire&);   ///< without gain and enabled

}   // namespace tactus::graph
