// SPDX-License-Identifier: MIT
#pragma once

/// Commands are the only way to change a graph. Each is a plain struct that can be stored, sent and undone. A command names its
/// patch ("" for the graph itself, else a subgraph) and its nodes; wires are identified by id, because two may look the same.
///
/// Errors of refused edits, in addition to those of graph files (bad ids, wrong kinds, units):
///
///     edit/unknown_patch, edit/unknown_node, edit/unknown_wire, edit/unknown_control, edit/unknown_device
///     edit/name_taken       a node, control, subgraph or target of that name already exists
///     edit/id_taken         a node or wire was copied with its id; give the copy a new one
///     edit/in_use           nodes still use the subgraph as their type
///     edit/cannot_expand    the node is not a subgraph, or its contents cannot replace it as they are
///     edit/bad_value        the command cannot set this key, or a file could not hold the value

#include "graph.hpp"

#include <tactus/text/result.hpp>

#include <concepts>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tactus::graph
{

/// An index in a list or object. nullopt, or an index beyond the end, means the end.
using Place = std::optional<std::size_t>;

struct AddNode
{
    std::string patch;
    Node node;
    Place place {};
};

/// Also removes everything that refers to the node: wires, exposed ports, overrides and targets of controls, anywhere in the graph.
struct RemoveNode
{
    std::string patch, name;
    bool only_node = false;   ///< keep the references to the node; used by inverse commands
};

/// Also renames all references to the node, including those through instances of its subgraph ("grain/wave.phase").
struct RenameNode
{
    std::string patch, name, to;
    bool only_node = false;
};

/// Without a value, resets the parameter to its default.
struct SetParam
{
    std::string patch, node, param;
    std::optional<Json> value {};
    Place place {};
};

struct SetSetting
{
    std::string patch, node, setting;
    std::optional<Json> value {};
    Place place {};
};

/// Sets a parameter inside a subgraph node, by its key in the overrides: "drag.mu", or "[3]/drag.mu" for one instance.
struct SetOverride
{
    std::string patch, node, path;
    std::optional<Json> value {};
    Place place {};
};

/// Sets any other key of a node: type, role, roles, bypass, overrides, count, every, times, hold, ui, and unknown ones.
struct SetNodeKey
{
    std::string patch, node, key;
    std::optional<Json> value {};
    Place place {};
};

struct AddWire
{
    std::string patch;
    Wire wire;
    Place place {};
};

struct RemoveWire
{
    std::string patch;
    Id wire {};
    std::string text {};   ///< instead of the id: the text of the wire, in any spelling that means the same; see findWire()
};

/// The wire keeps its id; the id in `to` is ignored.
struct ChangeWire
{
    std::string patch;
    Id wire {};
    Wire to;
};

struct AddControl
{
    Control control;
    Place place {};
};

struct RemoveControl
{
    std::string control;
};

struct ChangeControl
{
    std::string control;
    Control to;
};

struct AddSubgraph
{
    std::string name;
    Patch patch;
    Place place {};
};

struct RemoveSubgraph
{
    std::string name;
};

struct RenameSubgraph
{
    std::string name, to;
};

/// Moves nodes of a patch, with the wires between them, into a new subgraph, and replaces them by one node that uses it. Wires from
/// outside, and the ports that the patch itself exposes, reach them through exposed ports; all other references are adapted. Nodes and
/// wires keep their ids.
struct CollapseNodes
{
    std::string patch;
    std::vector<std::string> nodes;
    std::string name;       ///< name of the new node
    std::string subgraph;   ///< name of the new subgraph
};

/// The reverse of CollapseNodes: replaces a subgraph node by the contents of its subgraph, with the params, overrides and roles
/// of the node applied. Removes the subgraph if no other node uses it. If it is shared, its nodes and wires are copied, and the
/// copies record their origin. A node whose name is taken outside gets a new one that begins with the name of the subgraph node.
/// A node with a `count` becomes one node per instance, "finger_0", "finger_1" …, each of which can be expanded in turn. A wire
/// from all instances becomes one wire per instance; these are an error (wire/two_into_one) if their sum went into a port that
/// takes a single wire.
struct ExpandNode
{
    std::string patch, name;
};

/// Replaces the whole graph; the inverse of edits that change much of it. Nodes and wires with the same ids count as the same.
struct ReplaceGraph
{
    std::shared_ptr<const Graph> to;
};

struct ChangeExpose
{
    std::string patch;
    Expose to;
};

/// Without a description, removes the device of the role.
struct SetDevice
{
    std::string role;
    std::optional<Json> description {};
    Place place {};
};

/// Sets the values that are present. In a subgraph, only `ui` can be set. A `ui` of null removes the key.
struct SetHeader
{
    std::string patch {};
    std::optional<std::string> name {}, about {};
    std::optional<std::vector<std::string>> tags {};
    std::optional<double> rate_hz {};
    std::optional<Json> ui {};
};

struct Command;

/// Carries out all commands or none, as one undo step.
struct Batch
{
    std::string name;
    std::vector<Command> commands;
};

/// Any of these commands. It is not itself a variant, because a call to `apply` would then find std::apply.
struct Command
{
    using Edit = std::variant<AddNode, RemoveNode, RenameNode, SetParam, SetSetting, SetOverride, SetNodeKey,                       //
                              AddWire, RemoveWire, ChangeWire, AddControl, RemoveControl, ChangeControl,                            //
                              AddSubgraph, RemoveSubgraph, RenameSubgraph, CollapseNodes, ExpandNode, ReplaceGraph, ChangeExpose,   //
                              SetDevice, SetHeader, Batch>;

    template <typename T>
    requires (! std::same_as<T, Command>)
        Command (T e) : edit (std::move (e))
    {
    }

    Edit edit;
};

/// Commands from outside are checked. Inverse commands are not: they restore the previous state, valid or not.
enum class Checks
{
    all,
    none
};

/// Carries out a command and returns its inverse. On an error, leaves the graph unchanged. After the inverse (with Checks::none)
/// the graph is the same as before, byte for byte in its file, with the same ids. [main thread]
Result<Command> apply (Graph&, const Command&, Checks = Checks::all);

/// The text for a menu: "rename 'drag' to 'stick'". For a batch, its name.
std::string nameOf (const Command&);

}   // namespace tactus::graph
