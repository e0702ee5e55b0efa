// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// The little picture of a family of nodes ("friction" of friction.elasto_plastic), in a square of 14; to be stroked. A
/// subgraph is the family "graph". What has none gets a dot.
juce::Path glyphOf (std::string_view family);

}   // namespace tactus::host
