// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/compose/parts.hpp>
#include <host/app/desk/desk.hpp>

namespace tactus::host
{

/// Adds a graph to the open one as a node and a layer, and asks for its roles if there are several ways. If nothing is open, opens it. [main thread]
void addGraph (const Desk&, const std::filesystem::path&, const compose::Parts& = {}, std::optional<juce::Point<float>> at = {});

/// The same with a graph that is loaded. Something must be open. [main thread]
void addGraph (const Desk&, const graph::Graph&, const compose::Parts& = {}, std::optional<juce::Point<float>> at = {});

/// Adds a copied graph with a motor as above. What has none becomes a layer of a mixer of the patch that the canvas shows. [main thread]
void pasteLayer (const Desk&, const graph::Graph&);

void askForAdded (const Desk&);   ///< asks for the file of the graph to add

}   // namespace tactus::host
