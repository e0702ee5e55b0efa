// SPDX-License-Identifier: MIT
#pragma once

/// The only way to change a graph: commands, each a plain struct that can be kept, sent and undone. A command names its
/// patch ("" is the graph itself, else a subgraph) and its nodes by name; wires go by id, since two may look alike.
///
/// Ids of the messages of refused edits, besides those of graph files (bad ids, wrong kinds, units):
///
///     edit/unknown_patch, edit/unknown_node, edit/unknown_wire, edit/unknown_control, edit/unknown_device
///     edit/name_taken       a node, control, subgraph or target of that name is there already
///     edit/id_taken         a node or wire was copied with its id; give it a new one
///     edit/in_use           a subgraph that nodes still have as their type
///     edit/cannot_expand    a node of no subgraph, or one whose subgraph does not stand in its place as it is
///     edit/bad_value        a key that this command cannot set, or a value that a file could not hold

#include "graph.hpp"

#include <framework/message.hpp>

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

/// A place in a list or object; none, or beyond the end, is the end.
using Place = std::optional<std::size_t>;

struct AddNode
{
    std::string patch;
    Node node;
    Place place {};
};

/// With the node go its wires, the ports it shows, its overrides and the targets of controls on it, wherever they are.
struct RemoveNode
{
    std::string patch, name;
    bool only_node = false;   ///< leave what refers to it: for the way back
};

/// Whatever refers to the node follows, also through instances of its subgraph ("grain/wave.phase").
struct RenameNode
{
    std::string patch, name, to;
    bool only_node = false;
};

/// Without a value, the parameter goes back to its default.
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

/// A parameter inside a subgraph node, under its key among the overrides: "drag.mu", or "[3]/drag.mu" of one instance.
struct SetOverride
{
    std::string patch, node, path;
    std::optional<Json> value {};
    Place place {};
};

/// Any other key of a node: type, role, roles, bypass, overrides, count, every, times, hold, ui, and unknown ones.
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
};

/// The wire keeps its id, whatever `to` says.
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

/// Nodes of a patch, with the wires among them, become a new subgraph, and one node of it takes their place. Wires from
/// outside reach them through ports that it shows; whatever else names them follows. Nodes and wires keep their ids.
struct CollapseNodes
{
    std::string patch;
    std::vector<std::string> nodes;
    std::string name;       ///< of the node
    std::string subgraph;   ///< that it is of
};

/// The reverse: what is in its subgraph takes the node's place, with the params, overrides and roles that the node gave
/// it. A subgraph that no other node is of goes; of one that is shared, copies are made, which know their origin. A node
/// whose name is taken outside is given another one that begins with the name of the subgraph node. A node with a `count`
/// becomes a node for each instance, "finger_0", "finger_1" …, which can be expanded one by one; a wire from all of them
/// becomes as many, which compile refuses (wire/two_into_one) where their sum went into a port for a single one.
struct ExpandNode
{
    std::string patch, name;
};

/// All of it: the way back from edits that change much. Nodes and wires that were there under the same ids are the same.
struct ReplaceGraph
{
    std::shared_ptr<const Graph> to;
};

struct ChangeExpose
{
    std::string patch;
    Expose to;
};

/// Without a description, the role has none any more.
struct SetDevice
{
    std::string role;
    std::optional<Json> description {};
    Place place {};
};

/// What is given is set. A subgraph has nothing but `ui`; null removes it.
struct SetHeader
{
    std::string patch {};
    std::optional<std::string> name {}, about {};
    std::optional<std::vector<std::string>> tags {};
    std::optional<double> rate_hz {};
    std::optional<Json> ui {};
};

struct Command;

/// All of it or nothing, as one step of undo.
struct Batch
{
    std::string name;
    std::vector<Command> commands;
};

/// Any of these. No variant itself, since apply would then find std::apply.
struct Command
{
    using Edit = std::variant<AddNode, RemoveNode, RenameNode, SetParam, SetSetting, SetOverride, SetNodeKey, AddWire, RemoveWire, ChangeWire, AddControl, RemoveControl, ChangeControl, AddSubgraph, RemoveSubgraph, RenameSubgraph, CollapseNodes, ExpandNode, ReplaceGraph, ChangeExpose, SetDevice, SetHeader, Batch>;

    template <typename T>
    requires (! std::same_as<T, Command>)
        Command (T e) : edit (std::move (e))
    {
    }

    Edit edit;
};

/// A command from outside is checked. An inverse is not: it brings back what was there, right or wrong.
enum class Checks
{
    all,
    none
};

/// Carries out a command. Returns the command that takes it back, or why it is refused; then the graph is as it was.
/// After the inverse (with Checks::none) the graph is the same again, byte for byte in its file, with the same ids.
/// [main thread]
std::variant<Command, Message> apply (Graph&, const Command&, Checks = Checks::all);

/// What a menu says: "rename 'drag' to 'stick'"; the name of a batch.
std::string nameOf (const Command&);

}   // namespace tactus::graph
