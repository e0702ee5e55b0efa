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

/// Reads "hand.position.x", "mix.in[2]", "grain/wave.phase", "finger[3]/drag.mu"; or says what is wrong.
std::variant<Endpoint, std::string> parseEndpoint (std::string_view);

/// Reads "a.out -> b.in", "a.out -> [3] -> b.in", "a.out -> [1] -> (+) b.mu"; or says what is wrong.
std::variant<Wire, std::string> parseWire (std::string_view);

std::string toText (const Endpoint&);
std::string toText (const Wire&);   ///< without gain and enabled

}   // namespace tactus::graph
