// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "box.hpp"
#include "node_curve.hpp"
#include "notes.hpp"
#include "route.hpp"

#include <host/app/model/wire_rules.hpp>

#include <map>
#include <memory>
#include <optional>

namespace tactus::host
{

class Quantities;

struct SceneNode
{
    graph::Id id = 0;
    std::string name, type;
    std::shared_ptr<const Face> face;   ///< on the heap, because the box points at its ports
    Box box;
    juce::Point<float> at;
    bool bypass = false;
    std::shared_ptr<const PlotData> curve {};                   ///< null if the node has none
    std::map<std::pair<Role, std::string>, Quantity> carried;   ///< quantities of generic ports

    juce::Rectangle<float> bounds() const noexcept { return { at.x, at.y, box.width, box.height }; }
    juce::Point<float> placeOf (const Socket& s) const noexcept { return at + s.at; }
    Quantity quantityOf (const FacePort&) const;

    /// The param whose value is shown at a point. Null if there is none.
    const Socket* paramAt (juce::Point<float>) const noexcept;
};

struct SceneWire
{
    graph::Id id = 0;
    juce::Point<float> from, to;
    std::vector<juce::Point<float>> waypoints {};   ///< the bends, if the user has made some; else, what leads the wire around nodes
    bool has_bends = false;
    int start = -1, end = -1;    ///< indices of nodes in the scene
    std::string out {}, in {};   ///< ids of the ports in their faces; empty if there is no such port
    Role in_role = Role::input;
    Quantity quantity = Quantity::any;
    int width = 1;   ///< number of components
    int delay = 0;   ///< in ticks
    bool add = false, enabled = true;
    std::string source {};   ///< where it begins, as written in the file: "drag.force.x"
    std::string text;        ///< the wire as written in the file

    juce::Path path() const { return has_bends ? curveThroughBends (from, waypoints, to) : curveThrough (from, waypoints, to); }
};

/// An area, in canvas units, that contains a wire with its bends and whatever is painted on it.
juce::Rectangle<float> boundsOf (const SceneWire&);

/// Identifies a port across rebuilds of the scene.
struct PortId
{
    graph::Id node = 0;
    Role role = Role::output;
    std::string port;
};

/// A bend of a wire, by its number from the start of the wire.
struct Bend
{
    graph::Id wire = 0;
    std::size_t number = 0;

    bool operator== (const Bend&) const = default;
};

/// A port and its node. Null if there is none.
struct ScenePort
{
    const SceneNode* node = nullptr;
    const FacePort* port = nullptr;

    explicit operator bool() const noexcept { return port != nullptr; }
    WireEnd end() const { return { port, node->quantityOf (*port) }; }
};

/// A socket and its node. Null if there is none.
struct SceneSocket
{
    const SceneNode* node = nullptr;
    const Socket* socket = nullptr;

    explicit operator bool() const noexcept { return socket != nullptr; }
};

/// Keeps the automatic places of the nodes of patches, by the shapes of these, so that an edit of a value moves no node.
class KeptPlaces
{
public:
    const std::vector<juce::Point<float>>* find (const std::string& shape) const;
    void keep (std::string shape, std::vector<juce::Point<float>>);

private:
    std::map<std::string, std::vector<juce::Point<float>>> known;
};

/// The layout of one patch on the canvas, in canvas units. Rebuilt after each edit.
class Scene
{
public:
    /// Nodes without a stored position are arranged automatically. They keep their places while nodes and wires stay the same.
    Scene (const graph::Graph&, const SeenPatch&, const Catalogue&, NodeCurves&, KeptPlaces&, const TextWidth&);

    /// As above, if nothing but places has changed since another scene was made. While nodes are dragged, wires may stay: in a large patch, those whose ends
    /// are where they were, though other nodes have come into their way or left it; in any patch, those behind a node without wires that has moved.
    /// isRouted() is false then.
    Scene (const Scene& before, const graph::Graph&, const SeenPatch&, KeptPlaces&, const TextWidth&, bool wires_may_stay);
    bool isRouted() const noexcept { return is_routed; }

    const std::vector<SceneNode>& nodes() const noexcept { return all_nodes; }
    const std::vector<SceneWire>& wires() const noexcept { return all_wires; }
    /// A port that the subgraph exposes, and its outer name.
    struct ExposedPort
    {
        juce::Point<float> at;
        Role role = Role::input;
        std::string name;
        Quantity quantity = Quantity::any;
        juce::Rectangle<float> label {};   ///< the place of the name, beside the port
    };
    const std::vector<ExposedPort>& exposed() const noexcept { return all_exposed; }

    const std::vector<Note>& notes() const noexcept { return all_notes; }
    juce::Rectangle<float> bounds() const noexcept;

    const SceneNode* find (graph::Id) const noexcept;
    const SceneWire* findWire (graph::Id) const noexcept;
    ScenePort findPort (const PortId&) const noexcept;

    /// The topmost item at a point, or null. `reach` is the tolerance.
    const SceneNode* nodeAt (juce::Point<float>) const noexcept;
    const SceneWire* wireAt (juce::Point<float>, float reach) const;
    std::vector<const SceneWire*> wiresAt (juce::Point<float>, float reach) const;   ///< nearest first
    SceneSocket socketAt (juce::Point<float>, float reach) const noexcept;
    std::optional<Bend> bendAt (juce::Point<float>, float reach) const noexcept;

    /// A region is hit only at its title and its corner, so that its contents can be selected.
    std::optional<std::size_t> noteAt (juce::Point<float>) const noexcept;

    /// True if a point is on the note's resize corner.
    bool isCorner (std::size_t note, juce::Point<float>) const noexcept;

private:
    void addNodes (const graph::Graph&, const SeenPatch&, const graph::Patch&, const Catalogue&, NodeCurves&, const TextWidth&);
    void layOut (const graph::Graph&, const SeenPatch&, const graph::Patch&, KeptPlaces&, const TextWidth&, const Scene* before = nullptr,
                 bool is_dragged = false);
    std::string shapeFor (const std::vector<bool>& placed) const;
    void place (const graph::Patch&, KeptPlaces&);
    void placeAll();
    void placeAmongOthers (std::vector<bool> placed);
    void findQuantities (const graph::Patch&, const Quantities&);
    void addWires (const graph::Patch&);
    juce::Point<float> leaveOf (const SceneWire&) const;
    juce::Point<float> entryOf (const SceneWire&) const;
    std::vector<bool> obstacles (const Scene* before, bool is_dragged) const;
    void routeWires (const Scene* before, bool is_dragged);
    void addExposed (const graph::Patch&, const TextWidth&);
    int indexOf (const std::string& name) const noexcept;   ///< -1 if there is no such node

    std::vector<SceneNode> all_nodes;
    std::vector<SceneWire> all_wires;
    std::vector<Note> all_notes;
    std::vector<ExposedPort> all_exposed;
    std::map<std::string, int, std::less<>> indices;   // of the nodes, by name
    bool is_routed = true;
};

}   // namespace tactus::host
