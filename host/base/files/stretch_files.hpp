// SPDX-License-Identifier: MIT
#pragma once

#include "clip_io.hpp"

#include <tactus/run/log/stretch.hpp>

namespace tactus::host
{

/// Converts a stretch to a clip: each component becomes a wave on its own channel. The values of a clip are from -1 to 1. If a value is
/// outside, all values are divided by the same number, and a message in the list states this number.
Clip clipOfStretch (const Stretch&, Messages& notes);

/// Writes the movement of a stretch as a CSV, which the drivers `trace` and `sim` play. Ids: take/no_movement and those of TableWriter.
Result<> saveMovement (const Stretch&, const std::filesystem::path&);

}   // namespace tactus::host
