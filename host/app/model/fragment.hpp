// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/graph/edit.hpp>

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>

namespace tactus::host
{

/// Nodes and the wires among them as text, which is a graph file of its own. With them go the subgraphs they are of.
std::string copyText (const graph::Graph&, const std::string& patch, const std::set<graph::Id>& nodes);

/// What adds a copied text to a patch: as one step, under names that are free, moved by so much. Fills in the ids of the
/// nodes it will make. Or why the text is none.
std::variant<graph::Command, Message> paste (const graph::Graph&, const std::string& patch, const std::string& text, double dx, double dy, std::set<graph::Id>& made);

/// The upper left corner of the nodes in a copied text; nothing if it does not say where they stand.
std::optional<std::pair<double, double>> cornerOf (const std::string& text);

/// "drag", or where that is taken "drag_2", "drag_3" …
std::string freeName (const graph::Patch&, const std::set<std::string>& also_taken, const std::string& wanted);

}   // namespace tactus::host
