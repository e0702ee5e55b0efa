// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "box.hpp"
#include "notes.hpp"
#include "route.hpp"

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
    std::unique_ptr<Face> face;   ///< stays where it is: the box points at its ports
    Box box;
    juce::Point<float> at;
    bool bypass = false;
    std::map<std::pair<Role, std::string>, Quantity> carried;   ///< by ports whose unit is found out by what is wired

    juce::Rectangle<float> bounds() const noexcept { return { at.x, at.y, box.width, box.height }; }
    juce::Point<float> placeOf (const Socket& s) const noexcept { return at + s.at; }
    Quantity quantityOf (const FacePort&) const;

    /// The param whose value is written there; null if there is none.
    const Socket* paramAt (juce::Point<float>) const noexcept;
};

struct SceneWire
{
    graph::Id id = 0;
    juce::Point<float> from, to;
    std::vector<juce::Point<float>> by {};   ///< around what stands in the way
    int start = -1, end = -1;                ///< which nodes of the scene
    std::string out {}, in {};               ///< the ports there, as their faces name them; empty if there is no such port
    Role in_role = Role::input;
    Quantity quantity = Quantity::any;
    int width = 1;   ///< components
    int delay = 0;   ///< ticks
    bool add = false, enabled = true;
    std::string text;   ///< as in the file

    juce::Path path() const { return curveThrough (from, by, to); }
};

/// A socket of a node of a scene; null if there is none.
struct SceneSocket
{
    const SceneNode* node = nullptr;
    const Socket* socket = nullptr;

    explicit operator bool() const noexcept { return socket != nullptr; }
};

/// What a canvas shows of one patch of a graph: where everything stands, in canvas units. Made anew after each edit.
class Scene
{
public:
    /// `patch` is "" for the graph itself, else the name of a subgraph. Nodes that say nothing of their place are arranged.
    Scene (const graph::Graph&, const std::string& patch, const Catalogue&, const TextWidth&);

    const std::vector<SceneNode>& nodes() const noexcept { return all_nodes; }
    const std::vector<SceneWire>& wires() const noexcept { return all_wires; }
    /// A port that the subgraph shows to the outside, and as what.
    struct Exposed
    {
        juce::Point<float> at;
        Role role = Role::input;
        std::string name;
        Quantity quantity = Quantity::any;
    };
    const std::vector<Exposed>& exposed() const noexcept { return all_exposed; }

    const std::vector<Note>& notes() const noexcept { return all_notes; }
    juce::Rectangle<float> bounds() const noexcept;

    const SceneNode* find (graph::Id) const noexcept;
    const SceneWire* findWire (graph::Id) const noexcept;

    /// What stands there, the topmost first; null if nothing does. `reach` is how far beside it still counts.
    const SceneNode* nodeAt (juce::Point<float>) const noexcept;
    const SceneWire* wireAt (juce::Point<float>, float reach) const;
    std::vector<const SceneWire*> wiresAt (juce::Point<float>, float reach) const;   ///< the nearest first
    SceneSocket socketAt (juce::Point<float>, float reach) const noexcept;

    /// Of a region only its title and its corner are there for the pointer, so that one can select what is in it.
    std::optional<std::size_t> noteAt (juce::Point<float>) const noexcept;

    /// Whether a place is the corner by which a note is made larger.
    bool isCorner (std::size_t note, juce::Point<float>) const noexcept;

private:
    void addNodes (const graph::Graph&, const std::string& name, const graph::Patch&, const Catalogue&, const TextWidth&);
    void place (const graph::Patch&);
    std::optional<juce::Point<float>> besideOthers (std::size_t node, const std::vector<std::size_t>& unplaced, const std::vector<std::pair<int, int>>& wires) const;
    void findQuantities (const graph::Patch&, const Quantities&);
    void addWires (const graph::Patch&);
    void routeWires();
    void addExposed (const graph::Patch&);
    int numberOf (const std::string& name) const noexcept;

    std::vector<SceneNode> all_nodes;
    std::vector<SceneWire> all_wires;
    std::vector<Note> all_notes;
    std::vector<Exposed> all_exposed;
    std::map<std::string, int, std::less<>> numbers;   // by name
};

/// The place a node's file gives it, under `ui`; nothing if it gives none.
std::optional<juce::Point<float>> placeOf (const graph::Node&);

}   // namespace tactus::host
