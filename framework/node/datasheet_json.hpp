// SPDX-License-Identifier: MIT
#pragma once

#include "catalogue.hpp"

#include <string>

namespace tactus
{

class Json;

/// The datasheet of a node type, in the format of `tactus nodes --json`. [any thread]
Json datasheetJson (const NodeType&);

/// A unit as text for people: "N/m", "as wired", "as in", "in[0] * in[1] …".
std::string unitText (const UnitRule&);

}   // namespace tactus
