// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "highlights.hpp"

#include <host/app/canvas/navigation/view.hpp>
#include <host/app/look/look.hpp>

namespace tactus::host
{

/// The wires of a scene that are painted together, below all others: those of a patch that has very many, except what stands out. Painted one at a
/// time, they take longer.
class Bundling
{
public:
    Bundling (const Scene&, const Highlights&);

    bool isEmpty() const noexcept { return ! has_very_many; }
    bool contains (const SceneWire&) const;

private:
    bool isBesideSelected (const SceneWire&) const;

    const Scene& scene;
    const Highlights& highlights;
    bool has_very_many, lifts = false;   // lifts: the wires of selected nodes, which move with them, are not in it
};

/// Paints one wire. `level` is how much it carries, as in LiveState.
void paintWire (juce::Graphics&, const SceneWire&, const Theme&, bool selected, bool hovered, int level = 0);

/// The amount that a wire carries, as in LiveState; 0: nothing.
int levelOf (const SceneWire&, const LiveState&);

/// These paint in canvas units: the wires that are painted together, the other wires with what is on all of them, and what of the wires is above the
/// nodes: those that are selected or under the pointer, which shine through, and the bends of selected ones, where they can be grabbed.
void paintBundles (juce::Graphics&, const Scene&, const Theme&, const Highlights&);
void paintSingleWires (juce::Graphics&, const Scene&, const View&, const Look&, const Highlights&);
void paintAboveNodes (juce::Graphics&, const Scene&, const View&, const Theme&, const Highlights&);

}   // namespace tactus::host
