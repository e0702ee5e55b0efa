// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "highlights.hpp"

#include <host/app/canvas/navigation/view.hpp>
#include <host/app/look/look.hpp>

namespace tactus::host
{

/// Paints the nodes of a scene, or one of them, in canvas units.
void paintNode (juce::Graphics&, const SceneNode&, const View&, const Look&, const Highlights&);
void paintNodes (juce::Graphics&, const Scene&, const View&, const Look&, const Highlights&);

/// The bounds of the limit light of a node, in canvas units: at its top right corner, and never too small to see.
juce::Rectangle<float> limitLightOf (const SceneNode&, float zoom);

/// An area, in canvas units, that contains a node and whatever is painted on it and beside it.
juce::Rectangle<float> boundsOf (const SceneNode&, float zoom);

}   // namespace tactus::host
