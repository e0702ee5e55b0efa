// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// The kinds of effect in a graph, and how some of them are left out.

#include <tactus/graph/graph.hpp>
#include <tactus/node/catalogue.hpp>

namespace tactus::host::compose
{

/// A set of kinds of effect, by the source of the force.
struct Parts
{
    bool walls = true;        ///< surfaces and couplings
    bool friction = true;     ///< nodes of the friction family
    bool textures = true;     ///< gratings, height maps and recorded textures
    bool vibrations = true;   ///< modes, shocks, clips, oscillators
    bool others = true;       ///< cuts, fields, and nodes of plugins

    bool operator== (const Parts&) const = default;

    static Parts none() { return { false, false, false, false, false }; }
    bool isAll() const { return *this == Parts {}; }
};

inline Parts withoutWalls() { return { .walls = false }; }

/// The kinds of effect that reach a motor at the top of the graph or inside its subgraphs.
Parts partsOf (const graph::Graph&, const Catalogue&);

/// Unplugs the effects of all other kinds from the motors at the top of the graph. They still feed the effects that are kept: friction keeps the load of
/// its wall. An effect that is multiplied with a kept one is kept, too. Nodes that feed nothing any more are removed, with their wires and their entries in
/// controls.
void keepOnly (graph::Graph&, const Parts& kept, const Catalogue&);

}   // namespace tactus::host::compose
