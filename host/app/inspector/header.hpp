// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "describe.hpp"

namespace tactus::host
{

/// The head of a node: its family's picture, its name, which can be changed, its type, a switch that bypasses it, and one for
/// more help.
std::unique_ptr<Block> nodeHeader (const Inspected&, const graph::Node&, bool help, std::function<void()> toggleHelp);

}   // namespace tactus::host
