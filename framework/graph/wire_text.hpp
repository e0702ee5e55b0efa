// SPDX-License-Identifier: MIT
#pragma once

#include "graph.hpp"

#include <tactus/text/result.hpp>

#include <string_view>

namespace tactus::graph
{

/// parseWire for lists of many wires: reads into a new Wire, which is of no use after an error.
Result<> readWire (std::string_view, Wire&);

}   // namespace tactus::graph
