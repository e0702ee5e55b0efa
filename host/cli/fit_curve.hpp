// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/command_line/command.hpp>

namespace tactus::host
{

/// Adds `tactus fit curve`, which turns a recorded indentation into a curve of force over depth.
void addFitCurve (const Command& fit);

}   // namespace tactus::host
