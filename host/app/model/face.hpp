// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/graph.hpp>
#include <tactus/node/catalogue.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// The number of levels of nested subgraphs that are looked into. compile() refuses a subgraph that contains itself, but the canvas still draws it.
inline constexpr int deepest_subgraph = 32;

/// A port as shown on a node: a datasheet row, one entry of an array port, or a port that a subgraph exposes.
struct FacePort
{
    Role role = Role::input;
    std::string id;                     ///< the name after the dot in a wire: "force", "in[0]"
    std::string about;                  ///< description, in one sentence
    UnitRule unit {};                   ///< fixed, or taken from what is wired to the port
    int width = 1;                      ///< number of components
    const PortSheet* sheet = nullptr;   ///< the datasheet row; null on a placeholder

    Quantity quantity() const noexcept { return unit.kind == UnitRule::Kind::fixed ? unit.unit.quantity : Quantity::any; }
    bool isChoice() const noexcept { return sheet != nullptr && ! sheet->choices.empty(); }
};

/// The ports a node shows on the canvas and in the inspector.
struct Face
{
    enum class Kind
    {
        node,
        subgraph,
        placeholder   ///< unknown type; its ports are those that wires name
    };

    Kind kind = Kind::node;
    const NodeType* type = nullptr;   ///< null unless the type is in the catalogue
    std::vector<FacePort> inputs, params, outputs;

    const std::vector<FacePort>& of (Role) const noexcept;
    const FacePort* find (Role, std::string_view id) const noexcept;

    /// The port at one end of a wire: an output at its start, an input or param at its end.
    const FacePort* startOf (const graph::Endpoint&) const noexcept;
    const FacePort* endOf (const graph::Endpoint&) const noexcept;
};

/// Builds the face of a node in a patch of a graph.
Face faceOf (const graph::Graph&, const graph::Patch&, const graph::Node&, const Catalogue&);

}   // namespace tactus::host
