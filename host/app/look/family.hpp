// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "theme.hpp"

#include <string_view>

namespace tactus::host
{

/// The header of a node, by its family: a tint of the node's body, so faint that the name keeps its contrast. Families that are alike share
/// a tint; signals and filters, of which there are many, are grey.
juce::Colour headerColour (const Theme&, std::string_view family);

/// The glyph of the family on that header.
juce::Colour glyphColour (const Theme&, std::string_view family);

}   // namespace tactus::host
