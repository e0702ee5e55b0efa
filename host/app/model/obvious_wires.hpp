// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// The wires of a node that go without saying: the tool to what it touches, the resistance of a surface to what rubs on it, forces to the motor.

#include <tactus/graph/edit.hpp>
#include <tactus/node/catalogue.hpp>

#include <optional>
#include <set>
#include <string>

namespace tactus::host::wiring
{

graph::Endpoint endOf (const std::string& node, std::string_view port, int index = -1, int component = -1);
graph::Wire wire (graph::Endpoint from, graph::Endpoint to);

/// A node and everything downstream of it.
std::set<std::string> downstreamOf (const graph::Patch&, const std::string& node);

/// The component that a scalar force drives where a vector is expected.
inline constexpr int z_component = 2;

/// An output that can drive a motor.
struct ForceOutput
{
    std::string port;
    bool is_vector = false;
};

/// The output of a type that can drive a motor; preferably a vector if `vectors` is true.
std::optional<ForceOutput> forceOutput (const NodeType&, bool vectors);

bool isTexture (std::string_view type) noexcept;

/// True for an input without which a node of this type is not felt: where the tool is, how deep, how fast or how hard.
bool isNeeded (const NodeType&, const PortSheet& input);

/// The best source in the patch for an input. The excluded nodes are skipped. What presses on a surface is the resistance of an object or a
/// sensor of the device, never another force, such as that of friction.
std::optional<graph::Endpoint> sourceFor (const PortSheet& input, const graph::Graph&, const graph::Patch&, const std::set<std::string>& excluded,
                                          const Catalogue&);

/// Wires the inputs of a node that have no wire yet, as far as the patch has sources for them. The node may be a new one. Returns what is missing.
std::string wireInputs (const NodeType&, const std::string& node, const graph::Graph&, const std::string& patch, const std::set<std::string>& excluded,
                        const Catalogue&, graph::Batch&);

/// Multiplies a source by the gain of a contact window, which is 0 while the tool does not touch. Uses a window of the patch, or adds one that
/// reads the depth of a surface. Returns the product, or the source itself if the patch has neither.
graph::Endpoint gated (graph::Endpoint source, bool is_vector, const graph::Graph&, const std::string& patch, const std::set<std::string>& excluded,
                       const Catalogue&, graph::Batch&);

/// The obvious wires of a node of the patch. Wires that it has stay. A hand goes to all that has no position yet, forces
/// that go nowhere go to a motor, and any other node gets its sources and goes to the motor, a texture through a contact window. What rubs and has no
/// load yet gets that of a surface. Empty if the node has its wires, or if nothing fits.
graph::Batch obviousWires (const graph::Graph&, const std::string& patch, const std::string& node, const Catalogue&);

}   // namespace tactus::host::wiring
