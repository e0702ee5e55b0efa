// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene.hpp"
#include "view.hpp"

#include <host/app/look/look.hpp>

#include <set>

namespace tactus::host
{

/// What runs, seen on the canvas.
struct Live
{
    std::map<graph::Id, int> states;             ///< of nodes that tell theirs
    std::map<graph::Id, double> costs;           ///< part of a tick, of nodes; none while costs are not shown
    std::map<graph::Id, double> hits;            ///< how far along a wire a hit is, 0…1
    std::map<graph::Id, std::string> problems;   ///< of nodes and wires, in words

    bool operator== (const Live&) const = default;
};

/// What on a canvas is more than the graph itself.
struct Highlights
{
    std::set<graph::Id> selected;   ///< nodes and wires
    graph::Id hovered = 0;
    /// While a wire is drawn: which sockets it fits. The others are dimmed.
    std::function<bool (const SceneNode&, const FacePort&)> fits {};
    Live live {};
};

void paintGrid (juce::Graphics&, const View&, juce::Rectangle<int> area, const Theme&);

/// The notes, wires and nodes of a scene. The context is that of the component.
void paintScene (juce::Graphics&, const Scene&, const View&, const Look&, const Highlights&);

/// A wire from somewhere to somewhere else.
void paintWire (juce::Graphics&, const SceneWire&, const Theme&, bool selected, bool hovered);

}   // namespace tactus::host
