// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/canvas/canvas.hpp>
#include <host/app/palette/palette.hpp>

namespace tactus::host
{

/// Opens the palette with the node types that fit a request from the canvas, and adds the chosen node.
void openNodePalette (Palette&, Canvas&, const Catalogue&, const NodeRequest&);

/// Opens the palette at the pointer with the given entries to choose from.
void openPalette (Palette&, Canvas&, const juce::String& purpose, std::vector<PaletteEntry>, std::function<void (const std::string& type)> chosen);

}   // namespace tactus::host
