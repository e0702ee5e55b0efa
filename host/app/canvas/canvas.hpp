// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "actions.hpp"
#include "align.hpp"
#include "minimap.hpp"
#include "paint_scene.hpp"

#include <host/app/model/document.hpp>
#include <host/app/palette/search.hpp>

namespace tactus::host
{

/// What the mouse is doing from button down to button up.
class Drag
{
public:
    virtual ~Drag() = default;
    virtual void move (const juce::MouseEvent&) = 0;
    virtual void end (const juce::MouseEvent&) {}
    virtual void paint (juce::Graphics&) const {}   ///< over the scene, in pixels
};

/// The port a wire is drawn from.
struct WireStart
{
    graph::Id node = 0;
    Role role = Role::output;
    std::string port;
};

/// A node that somebody is about to choose: where it will stand, and what it will be joined to.
struct NodeWish
{
    juce::Point<float> at;
    std::optional<WireStart> start {};   ///< a wire that waits for its other end
    graph::Id wire = 0;                  ///< into this wire; 0: into none
};

/// Where graphs are patched: nodes, wires and notes of one patch, under the pointer and the keyboard.
///
/// Drag on nothing selects; the middle or the right button pans, and a click of the right one opens the menu; the wheel
/// zooms to the pointer, and a trackpad pans. A drag from a port draws a wire; it lights what it fits and says why it does
/// not fit elsewhere. What the keyboard does: commands.hpp.
class Canvas final : public juce::Component, private Document::Listener
{
public:
    Canvas (Document&, const Catalogue&);
    ~Canvas() override;

    Document& edited() noexcept { return document; }
    const Scene& scene() const noexcept { return *shown; }
    View& view() noexcept { return window; }
    const View& view() const noexcept { return window; }
    Highlights& lit() noexcept { return highlights; }
    const Selection& selection() const noexcept { return highlights.selected; }
    void select (Selection);
    void selectAll();
    void selectNext (juce::Point<float> direction);   ///< the nearest node on that side of the one that is selected

    /// From the graph itself inwards: the names of the subgraph nodes, and of the subgraphs, that were entered.
    const std::vector<std::pair<std::string, std::string>>& way() const noexcept { return entered; }
    std::string patch() const { return entered.empty() ? std::string {} : entered.back().second; }
    void leaveTo (std::size_t depth);
    void enter (const SceneNode&);   ///< of a subgraph of this file; else nothing

    /// Goes to the patch, and selects and frames a node or wire of it. A patch that no way leads to from the graph itself is
    /// not gone to.
    void show (const std::string& patch, graph::Id);

    /// As the whole graph names a port that is in the patch shown: "grain/wave.value".
    std::string address (const std::string& port) const;

    void frameAll();
    void frameSelection();
    void zoomBy (float factor);
    void toggleMap();
    juce::Point<float> pointerOrCentre() const;   ///< of the canvas

    // What commands do; each is one step of undo.
    void removeSelection();
    void duplicateSelection();
    void copySelection() const;
    void pasteText();
    void bypassSelection();
    void groupSelection();
    void expandSelection();
    void enterSelection();
    void alignSelection (Alignment);
    void arrangeAll();
    void nudgeSelection (juce::Point<float> by);
    void delaySelection (int ticks);
    void toggleWires();
    void addNote();
    void recolourNotes();
    void probeSelection();
    void wireFromSelection();
    void exposeFromSelection();

    /// Adds it, and joins it to what waits for it.
    void addNodeAt (const std::string& type, const NodeWish&);

    /// Draws a wire between two ports. Where one is a vector and the other is not, asks which component.
    void join (const SceneNode& from, const FacePort& out, const SceneNode& to, const FacePort& in);

    void editNote (std::size_t);
    void editParam (const SceneNode&, const Socket&);
    void setParam (const SceneNode&, const FacePort&, const std::optional<Json>&, graph::Step = graph::Step::own);

    /// A change made here: what stands somewhere because nobody said where stays there. False if it is refused.
    bool perform (graph::Command, graph::Step = graph::Step::own);
    graph::Graph placedGraph() const;   ///< with the places of all nodes of the patch written down

    void showLive (Live);   ///< many times a second

    std::function<void()> onSelection, onWay;
    std::function<void (const juce::String&)> onHint;   ///< a word on what is under the pointer, or ""

    /// A node is wanted: on a double click, a key, or where a wire was let go on nothing.
    std::function<void (NodeWish)> onWantsNode;
    void wantNode (NodeWish wish)
    {
        if (onWantsNode) onWantsNode (std::move (wish));
    }

    /// One of several is to be chosen, by what it is called; `chosen` is told its type.
    std::function<void (const juce::String& purpose, std::vector<PaletteEntry>, std::function<void (const std::string&)> chosen)> onChoose;

    std::function<void (std::vector<std::string> ports)> onProbe;   ///< as the whole graph names them

    std::function<void (const juce::String&)> onNotice;   ///< why something was not done

    void hint (const juce::String&);
    void notice (const juce::String& text)
    {
        if (onNotice) onNotice (text);
    }
    void showMenu();

    void paint (juce::Graphics&) override;
    void resized() override;
    void mouseDown (const juce::MouseEvent&) override;
    void mouseDrag (const juce::MouseEvent&) override;
    void mouseUp (const juce::MouseEvent&) override;
    void mouseMove (const juce::MouseEvent&) override;
    void mouseExit (const juce::MouseEvent&) override;
    void mouseDoubleClick (const juce::MouseEvent&) override;
    void mouseWheelMove (const juce::MouseEvent&, const juce::MouseWheelDetails&) override;
    void mouseMagnify (const juce::MouseEvent&, float) override;
    bool keyPressed (const juce::KeyPress&) override;

private:
    void documentChanged() override;
    void rebuild();
    void wayChanged();
    std::unique_ptr<Drag> dragFor (const juce::MouseEvent&);
    const graph::Patch& patchShown() const;
    std::optional<graph::Command> settle() const;
    juce::Point<float> freePlace (juce::Point<float>) const;   ///< there, or below what stands there

    /// Has a text typed over a part of the canvas.
    void type (juce::Rectangle<float> area, const juce::String& text, bool several_lines, std::function<void (const juce::String&)> typed);
    void endTyping (bool keep);

    Document& document;
    const Catalogue& catalogue;
    std::unique_ptr<Scene> shown;
    View window;
    Highlights highlights;
    std::vector<std::pair<std::string, std::string>> entered;
    std::unique_ptr<Drag> drag;
    std::unique_ptr<juce::TextEditor> typing;
    std::function<void (const juce::String&)> on_typed;
    bool framed = false;   // once there was room
    bool with_map = true;
};

}   // namespace tactus::host
