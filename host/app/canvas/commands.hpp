// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "actions.hpp"
#include "align.hpp"

#include <host/app/model/document.hpp>
#include <host/app/palette/search.hpp>

#include <span>

namespace tactus::host
{

class Canvas;

/// A canvas command with a menu item, a keyboard shortcut, or both.
struct CanvasCommand
{
    const char* name;                       ///< menu text, in English
    const char* keys;                       ///< juce::KeyPress descriptions, separated by '|'; "" for none
    bool (*can) (const Canvas&) noexcept;   ///< false if the command does not apply to the selection
    void (*run) (Canvas&);
    bool ends_group = false;   ///< a separator follows in the menu
    bool in_menu = true;       ///< false: keyboard only
    const char* lacks = "";    ///< what its key says if the command does not apply, in English; "" for nothing
};

std::span<const CanvasCommand> canvasCommands() noexcept;

/// A request to add a node that the user has yet to choose: where it goes and what it will be connected to.
struct NodeRequest
{
    juce::Point<float> at;
    std::optional<PortId> start {};   ///< the port to connect the new node to
    graph::Id wire = 0;               ///< the wire to insert the new node into; 0 for none
    bool modulates = false;           ///< what the new node gives to `start`, a param, moves it around its value, and does not set it
    bool is_joined = false;           ///< it belongs to the last step of the history
    double depth = 0.0;               ///< how far it moves the param, in SI; 0: in proportion to its value
    bool has_more_targets = false;    ///< it is going to move more params, and what it reads is wired after that
};

/// The commands for the selection of a canvas and for its patch. Each edit is one undo step.
class CanvasCommands
{
public:
    CanvasCommands (Canvas& c, Document& d) noexcept : canvas (c), document (d) {}

    /// Performs an edit and stores the positions of automatically arranged nodes with it. Returns false if the edit is refused.
    bool perform (graph::Command, graph::Step = graph::Step::own);

    /// Like perform(), for a command that brings new nodes and notes, with these ids, and their places. If they would cover others there, they go together
    /// to a free place.
    bool performBeside (graph::Command, const Selection& made);

    /// As perform(). New nodes without a position get a free place where their wires are short, and come into view. Returns their ids; none if the
    /// edit is refused.
    Selection performPlaced (graph::Command);
    void makeRoom (const Scene& before);    ///< nodes that the latest edit let grow push others aside; joined to the edit
    graph::Graph graphWithPlaces() const;   ///< the graph with the places of automatically arranged nodes stored in them

    std::vector<const SceneNode*> selectedNodes() const;
    void selectAll();
    void renameSelection();                           ///< opens the field for the name of the selected node, or for the text of the selected note
    void selectNext (juce::Point<float> direction);   ///< selects the nearest node in that direction
    void frameSelection();
    void zoomBy (float factor);
    juce::Point<float> pointerOrCentre() const;   ///< the position of the pointer if it is over the canvas, else the centre of the view

    /// The place for the next node: with the node that was added last if the pointer has not moved since then, otherwise pointerOrCentre().
    juce::Point<float> placeOfNext() const;

    void removeSelection();
    void duplicateSelection();
    void copySelection() const;
    void pasteText();
    void pasteLayer();   ///< the copied graph as a node and a layer, see Canvas::onLayerPasted
    void bypassSelection();
    void groupSelection();
    void expandSelection();
    void enterSelection();
    void alignSelection (Alignment);
    void arrangeAll();
    void nudgeSelection (juce::Point<float> by);
    void delaySelection (int ticks);
    void toggleWires();
    void bendSelection();                                               ///< bends a selected wire at the pointer, or else in the middle
    std::optional<Bend> addBend (graph::Id wire, juce::Point<float>);   ///< bends a wire at a place on it, and selects the bend
    void removeBend (const Bend&);
    void nudgeBend (const Bend&, juce::Point<float> by);
    void addNote();
    void recolourNotes();
    void editNote (std::size_t);
    void probeSelection();
    std::vector<std::string> selectedPorts() const;   ///< of the selected wires and nodes, as scopes name them
    void saveClipOfSelection();
    void wireFromSelection();
    void exposeFromSelection();

    void requestNode (NodeRequest);                                 ///< asks the user for a node to add
    void addNodeAt (const std::string& type, const NodeRequest&);   ///< adds a node and connects it as requested

    /// Adds a node of this type that moves a param of a node of the patch around its value; "": asks for it.
    void addModulator (const std::string& node, const std::string& param, const std::string& type);

    /// Checks whether join() would connect two ports. Any speed or envelope may modulate a param that no wire sets: the depth of the wire
    /// has the unit for it.
    Result<> mayJoin (const ScenePort& from, const ScenePort& to, graph::Id replaced = 0) const;

    /// Connects two ports, in place of a wire if its id is given. If only one of them is a vector, asks which component to use.
    void join (const ScenePort& from, const ScenePort& to, graph::Id replaced = 0);

    /// Connects an output to what a control sets: a modulator moves the control's targets around their values, and any other output replaces them. One
    /// undo step. Exposes targets inside of subgraphs. Says so if a target does not take the wire.
    void joinControl (const PortId& start, const std::string& control);

    /// Adds a node of this type that moves what a control sets around its value, as addModulator() does for a param.
    void addModulatorOf (const std::string& control, const std::string& type);

    void editParams();   ///< gives the keyboard focus to the parameters of the selected node
    void editParam (const SceneNode&, const Socket&);
    void editParamBeside (const PortId&, int step);
    bool setParam (const SceneNode&, const FacePort&, const std::optional<Json>&, graph::Step = graph::Step::own);

private:
    /// Calls `act` with each param of the patch through which a control sets something, exposed if it is inside of a subgraph: that is an edit with this step,
    /// and what follows is joined to it. `depth` is the same part of the range of each target, with its sign. Returns what `act` said last, or why there is
    /// no such param; empty if neither.
    juce::String eachTarget (const std::string& control, graph::Step& step, const std::function<juce::String (const PortId&, double depth)>& act);

    void addModulatorAt (const ScenePort& param, const std::string& type, graph::Step, double depth = 0.0, bool has_more_targets = false);
    void wireInputsOf (const std::string& node);
    void hintTargets (const PortId& source) const;
    juce::Point<float> placeFor (const std::string& type, const NodeRequest&) const;

    /// The node that was added last, its place, and where the pointer was.
    struct Added
    {
        graph::Id node = 0;
        juce::Point<int> pointer;
        juce::Point<float> at {};
        bool is_chosen = false;   ///< the place is that of the pointer
    };

    void moveClear (graph::Id made, const NodeRequest&);
    void placeAddedNode();
    void modulate (const Plug& from, const Plug& to, graph::Command& joined, double depth = 0.0) const;
    void connectNew (const Plug& from, const Plug& to, graph::Step, double depth = 0.0);
    void connectInPlaceOf (graph::Id, const Plug& from, const Plug& to);
    void addValues (const SceneNode& driven, const FacePort& param, const SceneNode& source, graph::Command& joined) const;
    const graph::Patch& patchShown() const;
    std::optional<graph::Command> storePositions() const;   ///< stores those of automatically arranged nodes; empty if all are stored
    std::optional<graph::Graph> copied() const;             ///< from the clipboard
    graph::Graph graphAsShown() const;                      ///< stores in the nodes of the patch where they are, and what controls set them to

    Canvas& canvas;
    Document& document;
    Added added;
};

}   // namespace tactus::host
