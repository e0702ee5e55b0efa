// SPDX-License-Identifier: MIT
#pragma once

#include "surface.hpp"

#include <string>

namespace tactus
{

/// The reason why a surface cannot be used, as a sentence. Empty if it can.
std::string problemOf (const Surface&);

/// A warning if a usable surface faces inwards, and therefore attracts; or empty.
std::string wrongSide (const Surface&);

}   // namespace tactus
