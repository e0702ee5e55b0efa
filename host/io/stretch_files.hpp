// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "clip_io.hpp"

#include <tactus/run/log/stretch.hpp>

namespace tactus::host
{

/// The components of a stretch as a clip: a wave on the channel of each. A clip counts from -1 to 1: a note says by which value
/// everything is divided, if a value is larger.
Clip clipOfStretch (const Stretch&, Messages& notes);

/// Writes the movement of a stretch as a CSV, which the drivers `trace` and `sim` play. Ids: take/no_movement and those of TableWriter.
Result<> saveMovement (const Stretch&, const std::filesystem::path&);

}   // namespace tactus::host
