// SPDX-License-Identifier: MIT
#pragma once

#include "surface.hpp"

#include <string>

namespace tactus
{

/// Why a surface cannot be used, as a sentence. Empty if it can.
std::string problemOf (const Surface&);

// Warnings about a usable surface. Each is a sentence, or empty.
std::string wrongSide (const Surface&);   ///< the surface faces inwards, and therefore attracts
std::string leaning (const Surface&);     ///< a flat patch has leaning frames, so without friction there is no potential

bool isFlat (const Surface&);             ///< all triangles lie in one plane
bool isPatchThatLeans (const Surface&);   ///< the surface is flat, but at least one of the given frames is tilted against its plane

}   // namespace tactus
