// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Layer mixers as people see them, a desk with a channel for each layer, and what is done at them, as commands. Each is one
/// step of undo.

#include <framework/catalogue.hpp>
#include <framework/graph/edit.hpp>

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace tactus::host
{

/// Where a mixer stands: in a patch, and by which path the graph itself reaches it, "threads/mix"; of a subgraph that
/// several nodes are of, by the first.
struct DeskPlace
{
    graph::Id id = 0;
    std::string patch, node, path;

    bool operator== (const DeskPlace&) const = default;
};

std::vector<DeskPlace> desksOf (const graph::Graph&);

const graph::Node* findDesk (const graph::Graph&, const DeskPlace&);

int layersOf (const graph::Node&, const Catalogue&);

/// As the setting `names` has them; "" of one without.
std::vector<std::string> layerNames (const graph::Node&, int layers);

/// An entry of a list of its params ("gain", 2) as written, or the default.
Json layerValue (const graph::Node&, const Catalogue&, const std::string& param, int layer);

/// The first wire into a layer; null if there is none.
const graph::Wire* wireInto (const graph::Graph&, const DeskPlace&, int layer);

/// Nothing brings the default back.
graph::Command setLayerValue (const graph::Node&, const DeskPlace&, const Catalogue&, const std::string& param, int layer, const std::optional<Json>&);

/// Commas part names in the file, so a name has none.
graph::Command renameLayer (const graph::Node&, const DeskPlace&, int layers, int layer, std::string name);

/// Another layer, empty, or with a node of a type that is wired into it: and what goes into that, as far as something in the
/// patch gives it. What it misses is said.
struct AddedLayer
{
    graph::Command command;
    std::string misses;   ///< "wire something into ring.hit"; "" if nothing is missing
};
std::variant<AddedLayer, std::string> addLayer (const graph::Graph&, const DeskPlace&, const Catalogue&, const std::string& type = {});

/// The types whose force can be a layer: textures and vibrations that give a scalar in newton.
std::vector<const NodeType*> layerTypes (const Catalogue&);

/// Without that layer and its wires; those after it move up. Or why that cannot be.
std::variant<graph::Command, std::string> removeLayer (const graph::Graph&, const DeskPlace&, const Catalogue&, int layer);

/// So that the layer stands elsewhere, with all that is its own.
graph::Command moveLayer (const graph::Graph&, const DeskPlace&, const Catalogue&, int layer, int to);

/// A desk for a graph that has none: between the scalar forces and where they go, if there are such; else beside the
/// vectors, with an empty layer, pushing along z. Or why there is no place for one.
struct AddedDesk
{
    graph::Command command;
    std::string says;   ///< what it does, for the button's tooltip
};
std::variant<AddedDesk, std::string> addDesk (const graph::Graph&, const Catalogue&);

}   // namespace tactus::host
