// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "describe.hpp"

namespace tactus::host
{

/// The header of a node: icon, editable name, type, and buttons for bypass and help.
std::unique_ptr<Block> nodeHeader (const InspectorContext&, const graph::Node&, bool help, std::function<void()> toggleHelp);

}   // namespace tactus::host
