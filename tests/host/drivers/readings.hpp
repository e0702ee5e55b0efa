// SPDX-License-Identifier: MIT
#pragma once

#include "support/rounds.hpp"

#include <algorithm>
#include <cstdlib>

namespace tactus::test
{

/// The readings of a device that are compared with a render: TACTUS_READINGS, or so many.
inline int readings (int usual)
{
    const auto* wanted = std::getenv ("TACTUS_READINGS");
    return wanted != nullptr ? std::max (1, std::atoi (wanted)) : rounds (usual);
}

}   // namespace tactus::test
