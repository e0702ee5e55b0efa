// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/canvas/canvas.hpp>
#include <host/app/palette/palette.hpp>

namespace tactus::host
{

/// Opens the palette with the node types that fit a request from the canvas, those in `recent` first, and adds the chosen node.
void openNodePalette (Palette&, Canvas&, const Catalogue&, const NodeRequest&, const std::vector<std::string>& recent,
                      std::function<void (const std::string& type)> onAdded);

/// Opens the palette at the pointer with the given entries to choose from.
void openPalette (Palette&, Canvas&, const juce::String& purpose, std::vector<PaletteEntry>, std::function<void (const std::string& type)> chosen);

}   // namespace tactus::host
