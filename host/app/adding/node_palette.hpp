// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/desk/desk.hpp>
#include <host/app/palette/palette.hpp>

namespace tactus::host
{

/// Adds a node as a request of the canvas says, and notes its type as a recent one. [main thread]
void addNode (const Desk&, const std::string& type, const NodeRequest&);

/// Opens the palette with the node types that fit a request from the canvas, those added lately first, and adds what is chosen. If the graph is empty, it
/// offers the templates, too; if not, the presets that can be added to it. [main thread]
void openNodePalette (const Desk&, Palette&, const std::vector<Preset>& templates, const NodeRequest&);

/// Opens the palette at the pointer with the given entries to choose from.
void openPalette (Palette&, Canvas&, const juce::String& purpose, PaletteSearch, std::function<void (const std::string& type)> chosen);

}   // namespace tactus::host
