// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "commands.hpp"
#include "minimap.hpp"
#include "navigation/trail.hpp"
#include "navigation/view_history.hpp"
#include "paint/backdrop.hpp"
#include "paint/node_pictures.hpp"

#include <host/app/look/text_overlay.hpp>
#include <host/app/palette/search.hpp>

#include <filesystem>
#include <optional>

namespace tactus::host
{

/// A mouse drag, from button down to button up.
class Drag
{
public:
    virtual ~Drag() = default;
    virtual void move (const juce::MouseEvent&) = 0;
    virtual void end (const juce::MouseEvent&) {}
    virtual void paint (juce::Graphics&) const {}   ///< paints over the scene, in pixels
};

/// The patch editor: shows the nodes, wires and notes of one patch and edits them with mouse and keyboard.
///
/// Dragging on empty canvas selects. The middle or right button pans; a right-click opens the menu. The wheel zooms at the
/// pointer; a trackpad pans. Dragging from a port draws a wire: ports that the wire fits are highlighted, the others show why
/// it does not fit. A clip file dropped on a clip node replaces the file of this node; on
/// empty canvas, it becomes a new node. Keyboard commands: commands.hpp.
class Canvas final : public juce::Component,
                     public juce::TooltipClient,
                     public juce::FileDragAndDropTarget,
                     public juce::DragAndDropTarget,
                     private Document::Listener
{
public:
    static constexpr float socket_reach = 9.0f, wire_reach = 6.0f;   ///< how many pixels the pointer may be from a port or a wire

    Canvas (Document&, const Catalogue&);
    ~Canvas() override;

    Document& edited() noexcept { return document; }
    const Catalogue& types() const noexcept { return catalogue; }
    CanvasCommands& commands() noexcept { return edits; }
    const CanvasCommands& commands() const noexcept { return edits; }
    const Scene& scene() const noexcept { return *shown; }
    const Backdrop& below() const noexcept { return backdrop; }
    const NodePictures& pictures() const noexcept { return node_pictures; }
    std::uint64_t sceneNumber() const noexcept { return scenes_made; }   ///< another number for each scene; never 0
    View& view() noexcept { return window; }
    const View& view() const noexcept { return window; }
    Highlights& highlighted() noexcept { return highlights; }
    const Selection& selection() const noexcept { return highlights.selected; }
    void select (Selection);
    void selectBend (const Bend&);   ///< selects a bend and its wire

    using Breadcrumbs = Trail::Entries;
    using Instance = Trail::Instance;
    const Breadcrumbs& breadcrumbs() const noexcept { return trail.entries(); }
    std::string patch() const { return trail.patch(); }
    SeenPatch seen() const { return trail.seen(); }
    void leaveTo (std::size_t depth);
    void enter (const SceneNode&);   ///< no effect unless the node is a subgraph of this file

    /// Goes to a patch, then selects a node or wire in it and scrolls to it. No effect if the patch cannot be reached from the root.
    void show (const std::string& patch, graph::Id);

    /// Moves the view there, unless it shows it already. The move belongs to the latest edit.
    void bringIntoView (juce::Rectangle<float>);

    /// The current patch as it would look in another graph.
    std::shared_ptr<const Scene> sceneOf (const graph::Graph&);

    /// See Trail.
    std::string address (const std::string& port) const { return trail.address (port); }
    std::optional<Instance> instance() const { return trail.instance(); }
    void chooseInstance (int number);

    void placeHint (int bottom);   ///< where the hint on an empty canvas ends, in px; by default just below the middle

    void frameAll();
    void frameStart();   ///< as frameAll(), but labels stay readable: of a large patch, it shows the part around the hand, or around the first node
    void toggleMap();
    void showMenuOfSelection();                                ///< at the first selected node, wire or note, else in the middle; with the keyboard
    bool isFitted() const { return viewState().isFitted(); }   ///< the user has not moved the view since it was fitted to the patch

    /// The view as it is now belongs to the latest edit: undoing the edit brings back the view from before.
    void endEdit() { views.end (viewState()); }

    /// Opens a text editor over part of the canvas. If `done` refuses the text, by false, Return leaves it for another try. Tab ends the editor and
    /// calls `next`, Shift+Tab with -1 instead of 1.
    void openEditor (juce::Rectangle<float> area, const juce::String& text, TextOverlay::Kind kind, std::function<bool (const juce::String&)> done,
                     std::function<void (int step)> next = {});

    void showLive (LiveState);   ///< call many times a second; repaints only what has changed

    /// The port or wire that the pointer is on; none during a drag.
    const PointedPort& pointed() const noexcept { return pointed_at; }

    juce::String getTooltip() override;                        ///< tooltipAt the pointer
    juce::String tooltipAt (juce::Point<float> pixel) const;   ///< about the limit light, or, while nothing runs, the port at this pixel; else empty

    bool isDragging() const noexcept { return drag != nullptr; }

    /// Ends the drag that is going on as if it had not begun. Returns false if there is none.
    bool cancelDrag();

    std::function<void()> onSelection, onBreadcrumbs;
    /// Fills the menu of a param, which the user has clicked with the right button.
    std::function<void (juce::PopupMenu&, const std::string& node, const std::string& port)> onParamMenu;
    std::function<void()> onEditParams;                 ///< the parameters of the selected node get the keyboard focus
    std::function<void (const juce::String&)> onHint;   ///< receives a description of what is under the pointer, or ""

    /// The user wants to add a node: by double-click, by key, or by dropping a wire on empty canvas.
    std::function<void (NodeRequest)> onNodeRequested;

    /// Asks the user to choose one of the entries that the search finds; `chosen` receives the type of that entry.
    std::function<void (const juce::String& purpose, PaletteSearch, std::function<void (const std::string&)> chosen)> onChoose;

    std::function<void (std::vector<std::string> ports)> onProbe;   ///< receives the full paths of the ports

    /// Receives the file of a graph that is dropped here, or dragged here from the list of presets.
    std::function<void (const std::filesystem::path&, juce::Point<float> at)> onGraphDropped;
    /// Extends the removal of nodes by what was made for them elsewhere, such as their layers.
    std::function<graph::Command (graph::Batch removal)> completeRemoval;

    std::function<void (const graph::Graph&)> onLayerPasted;                           ///< receives a copied graph that is to become a layer
    std::function<void (const std::string& type, const NodeRequest&)> onTypeDropped;   ///< a node is dragged here from the list of nodes
    std::function<void (const std::filesystem::path&)> onSaveClip;                     ///< receives the clip of a node, to be saved in another format

    std::function<void (const PortId& start, juce::Point<int> screen)> onWireOutside;   ///< a new wire is dropped beside the canvas

    std::function<void (const juce::String&)> onNotice;   ///< receives the reason why an edit was not made

    void hint (const juce::String&);
    void notice (const juce::String& text)
    {
        if (onNotice) onNotice (text);
    }

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
    bool isInterestedInFileDrag (const juce::StringArray&) override;
    void fileDragEnter (const juce::StringArray&, int x, int y) override;
    void fileDragMove (const juce::StringArray&, int x, int y) override;
    void fileDragExit (const juce::StringArray&) override;
    void filesDropped (const juce::StringArray&, int x, int y) override;
    bool isInterestedInDragSource (const SourceDetails&) override;
    void itemDragMove (const SourceDetails&) override;
    void itemDragExit (const SourceDetails&) override;
    void itemDropped (const SourceDetails&) override;

private:
    void documentChanged() override;
    void typesChanged() override
    {
        drag.reset();   // a drag may hold a row of a datasheet, so it ends where it is
        curves.clear();
        rebuild();   // what has another shape now was not edited, so it moves nothing aside
        repaint();
    }
    ViewState viewState() const { return { patch(), window, framed, framed_around }; }
    void followStep (const Scene& before);
    void revealStep();
    void rebuild();
    TextWidth textWidth() const;
    void repaintEdit (const Scene& before);   ///< what differs from the scene before an edit
    void repaintAround (juce::Rectangle<float> area);
    void frameAround (juce::Rectangle<float> focus);
    void breadcrumbsChanged();
    /// The object under the pointer: its id, a description, and the cursor to show.
    struct Hover
    {
        graph::Id id = 0;
        juce::String text {};
        juce::MouseCursor::StandardCursorType cursor = juce::MouseCursor::NormalCursor;
    };
    std::optional<Bend> bendAt (juce::Point<float>, bool of_selected) const;   ///< bends of a selected wire are above the nodes
    const SceneWire* wireUnder (juce::Point<float>) const;                     ///< null also if something is in front of it
    Hover hoverAt (juce::Point<float>, const SceneWire* wire) const;
    PointedPort portAt (juce::Point<float>, const SceneWire* wire) const;
    void point (PointedPort);
    void repaintChanged (const LiveState& before);
    std::unique_ptr<Drag> dragFor (const juce::MouseEvent&);
    void dropClip (const std::filesystem::path&, juce::Point<float> at);
    void paintFileOver (juce::Graphics&) const;
    void showMenu (juce::Point<float> at, const juce::PopupMenu::Options& place);   ///< of what is at a point of the canvas

    Document& document;
    CanvasCommands edits { *this, document };
    const Catalogue& catalogue;
    NodeCurves curves;
    KeptPlaces kept_places;
    std::shared_ptr<const Scene> shown;
    std::pair<std::uint64_t, SeenPatch> shown_of;   // the version of the document, and the patch
    std::uint64_t scenes_made = 0;
    View window;
    Highlights highlights;
    Backdrop backdrop;
    NodePictures node_pictures;
    Trail trail { document };
    PointedPort pointed_at;
    std::unique_ptr<Drag> drag;
    std::size_t drag_begins_at = 0;   // position in the history
    TextOverlay text_editor { *this };
    std::optional<juce::Point<int>> file_over;   // where a file is being dragged over the canvas
    std::optional<View> framed;                  // see ViewState
    juce::Rectangle<float> framed_around;
    ViewHistory views { document };
    juce::Rectangle<float> laid_out;   // of the last layout; the view stays fitted until the user moves it, then keeps its centre
    std::optional<int> hint_bottom;
    bool with_map = true;
};

}   // namespace tactus::host
