// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/catalogue.hpp>
#include <framework/graph/graph.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// A port as a node shows it: of a node of the catalogue a row of its datasheet, or one entry of an array port; of a
/// subgraph what it exposes.
struct FacePort
{
    Role role = Role::input;
    std::string id;                     ///< as a wire names it after the dot: "force", "in[0]"
    std::string about;                  ///< one sentence
    UnitRule unit {};                   ///< fixed, or found out by what is wired
    int width = 1;                      ///< components
    const PortSheet* sheet = nullptr;   ///< null on a placeholder

    Quantity quantity() const noexcept { return unit.kind == UnitRule::Kind::fixed ? unit.unit.quantity : Quantity::any; }
    bool isChoice() const noexcept { return sheet != nullptr && ! sheet->choices.empty(); }
};

/// What a node shows of itself.
struct Face
{
    enum class Kind
    {
        node,
        subgraph,
        placeholder   ///< its type is unknown; it keeps the ports that wires name
    };

    Kind kind = Kind::node;
    const NodeType* type = nullptr;   ///< of a node of the catalogue
    std::vector<FacePort> inputs, params, outputs;

    const FacePort* find (Role, std::string_view id) const noexcept;

    /// The port at an end of a wire: an output at its start, an input or param at its end.
    const FacePort* startOf (const graph::Endpoint&) const noexcept;
    const FacePort* endOf (const graph::Endpoint&) const noexcept;
};

/// The face of a node that stands in a patch of a graph.
Face faceOf (const graph::Graph&, const graph::Patch&, const graph::Node&, const Catalogue&);

}   // namespace tactus::host
