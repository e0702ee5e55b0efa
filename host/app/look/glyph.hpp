// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// The icon of a node family, such as "friction" for friction.elasto_plastic: a path to stroke, 14 by 14. Subgraphs are the
/// family "graph". An unknown family gets a dot.
juce::Path glyphOf (std::string_view family);

}   // namespace tactus::host
