// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene.hpp"
#include "view.hpp"

#include <host/app/look/look.hpp>

#include <set>

namespace tactus::host
{

/// What on a canvas is more than the graph itself.
struct Highlights
{
    std::set<graph::Id> selected;   ///< nodes and wires
    graph::Id hovered = 0;
    /// While a wire is drawn: which sockets it fits. The others are dimmed.
    std::function<bool (const SceneNode&, const FacePort&)> fits {};
};

void paintGrid (juce::Graphics&, const View&, juce::Rectangle<int> area, const Theme&);

/// The wires and nodes of a scene. The context is that of the component.
void paintScene (juce::Graphics&, const Scene&, const View&, const Look&, const Highlights&);

/// A wire from somewhere to somewhere else.
void paintWire (juce::Graphics&, const SceneWire&, const Theme&, bool selected, bool hovered);

}   // namespace tactus::host
