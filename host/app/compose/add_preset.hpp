// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// A graph that is added to another one as a layer.

#include "parts.hpp"

#include <tactus/graph/edit.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/text/result.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host::compose
{

/// The role of the open graph that plays each role of the added graph. A role without an entry brings its own device.
using RoleMap = std::map<std::string, std::string>;

/// The ways in which the roles of one graph can become those of another, the most likely first. If there is only one, the user need not be asked.
std::vector<RoleMap> roleMaps (const graph::Graph& open, const graph::Graph& added);

struct AddOptions
{
    RoleMap roles {};
    Parts parts {};
    std::optional<juce::Point<double>> at {};   ///< of the block, in canvas units; empty: the canvas finds a place
};

/// The result of addPreset().
struct AddedPreset
{
    graph::Command command = graph::Batch {};
    std::string block;                 ///< the name of the new node
    graph::Id node = 0;                ///< and its id
    std::string label;                 ///< of its layer in the mixer
    std::vector<std::string> layers;   ///< the mixers that have the layer
    double rate_hz = 0.0;              ///< of the whole graph after the step
};

/// Adds a graph to another one as one node at its top, a subgraph, in one undo step. Its hands read the roles of the open graph. The signals
/// of its motors go to layers of the mixers before the motors of these roles. Mixers and motors are made if there are none, and the other signals
/// that reach a motor become layers, too. Its controls become controls of the open graph. The rate becomes the higher one of the two.
/// Its files stay where they are. Ids: mixer/full, compose/in_file, compose/in_path, compose/no_motor, compose/no_part. [main thread]
Result<AddedPreset> addPreset (const graph::Graph& open, graph::Graph added, const AddOptions&, const Catalogue&);

}   // namespace tactus::host::compose
