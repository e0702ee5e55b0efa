// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/canvas/canvas.hpp>
#include <host/app/palette/palette.hpp>
#include <host/app/presets/preset_list.hpp>

namespace tactus::host
{

/// Opens the palette with the node types that fit a request from the canvas, those in `recent` first. If the graph is empty, it offers the templates,
/// too; if not, the presets that can be added to it. `chosen` receives a type, or the entry of a template or preset.
void openNodePalette (Palette&, Canvas&, const Catalogue&, const NodeRequest&, const std::vector<std::string>& recent, const std::vector<Preset>& templates,
                      const std::vector<Preset>& presets, std::function<void (const std::string& entry)> chosen);

/// The template or preset of a list that an entry of the palette stands for; null if it is a node.
const Preset* templateOf (const std::string& entry, const std::vector<Preset>& of);

/// Opens the palette at the pointer with the given entries to choose from.
void openPalette (Palette&, Canvas&, const juce::String& purpose, PaletteSearch, std::function<void (const std::string& type)> chosen);

}   // namespace tactus::host
