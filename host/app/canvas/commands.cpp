// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "canvas.hpp"

#include <host/app/model/clip_graph.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
bool always (const Canvas&) noexcept { return true; }

bool hasSelection (const Canvas& c) noexcept { return ! c.selection().empty(); }
bool hasNode (const Canvas& c) noexcept { return ! c.selectedNodes().empty(); }
bool hasOneNode (const Canvas& c) noexcept { return c.selectedNodes().size() == 1; }
bool hasClip (const Canvas& c) noexcept { return hasOneNode (c) && c.selectedNodes()[0]->type == clip_type; }
bool hasTwoNodes (const Canvas& c) noexcept { return c.selectedNodes().size() > 1; }
bool hasNote (const Canvas& c) noexcept { return std::ranges::any_of (c.selection(), isNote); }
bool hasSomeNodes (const Canvas& c) noexcept { return ! c.scene().nodes().empty(); }
bool isInside (const Canvas& c) noexcept { return ! c.breadcrumbs().empty(); }
bool isInsideWithNode (const Canvas& c) noexcept { return isInside (c) && hasOneNode (c); }
bool hasSubgraph (const Canvas& c) noexcept { return hasOneNode (c) && c.selectedNodes()[0]->face->kind == Face::Kind::subgraph; }

bool hasWire (const Canvas& c) noexcept
{
    return std::ranges::any_of (c.scene().wires(), [&] (const SceneWire& w) { return c.selection().contains (w.id); });
}

template <Alignment how>
void align (Canvas& c)
{
    c.alignSelection (how);
}

template <int x, int y>
void nudge (Canvas& c)
{
    c.nudgeSelection ({ x * Box::grid, y * Box::grid });
}

template <int x, int y>
void step (Canvas& c)
{
    c.selectNext ({ static_cast<float> (x), static_cast<float> (y) });
}

template <int by>
void delay (Canvas& c)
{
    c.delaySelection (by);
}

template <void (Canvas::*command)()>
void call (Canvas& c)
{
    (c.*command)();
}

template <int percent>
void zoom (Canvas& c)
{
    c.zoomBy (static_cast<float> (percent) / 100.0f);
}

void addNode (Canvas& c) { c.requestNode ({ c.pointerOrCentre(), {}, 0 }); }
void undo (Canvas& c) { c.edited().undo(); }
void redo (Canvas& c) { c.edited().redo(); }
void copy (Canvas& c) { c.copySelection(); }
void leave (Canvas& c) { c.leaveTo (c.breadcrumbs().size() - 1); }
void resetZoom (Canvas& c) { c.zoomBy (1.0f / c.view().zoom); }

void cut (Canvas& c)
{
    c.copySelection();
    c.removeSelection();
}

constexpr CanvasCommand commands[] {
    { "Add node", "spacebar|tab", always, addNode },
    { "Add note, or region around selection", "n", always, call<&Canvas::addNote> },
    { "Next region colour", "k", hasNote, call<&Canvas::recolourNotes> },
    { "Connect to...", "w", hasOneNode, call<&Canvas::wireFromSelection> },
    { "Save clip as...", "", hasClip, call<&Canvas::saveClipOfSelection> },
    { "Probe signal", "p", hasSelection, call<&Canvas::probeSelection>, true },

    { "Undo", "ctrl + z", always, undo },
    { "Redo", "ctrl + y|ctrl + shift + z", always, redo },
    { "Cut", "ctrl + x", hasSelection, cut },
    { "Copy", "ctrl + c", hasSelection, copy },
    { "Paste", "ctrl + v", always, call<&Canvas::pasteText> },
    { "Duplicate with incoming wires", "ctrl + d", hasNode, call<&Canvas::duplicateSelection> },
    { "Delete and reconnect", "delete|backspace", hasSelection, call<&Canvas::removeSelection> },
    { "Select all", "ctrl + a", hasSomeNodes, call<&Canvas::selectAll>, true },

    { "Bypass", "b", hasNode, call<&Canvas::bypassSelection> },
    { "Group into subgraph", "g", hasNode, call<&Canvas::groupSelection> },
    { "Ungroup subgraph", "shift + g", hasSubgraph, call<&Canvas::expandSelection> },
    { "Enter subgraph", "return", hasSubgraph, call<&Canvas::enterSelection> },
    { "Edit parameters", "return|shift + return", hasSelection, call<&Canvas::editParams> },
    { "Leave subgraph", "u", isInside, leave },
    { "Expose or hide port...", "o", isInsideWithNode, call<&Canvas::exposeFromSelection>, true },

    { "Increase wire delay", "]", hasWire, delay<1> },
    { "Decrease wire delay", "[", hasWire, delay<-1> },
    { "Toggle wire", "e", hasWire, call<&Canvas::toggleWires>, true },

    { "Arrange all", "l", hasSomeNodes, call<&Canvas::arrangeAll> },
    { "Align left", "alt + cursor left", hasTwoNodes, align<Alignment::left> },
    { "Align right", "alt + cursor right", hasTwoNodes, align<Alignment::right> },
    { "Align top", "alt + cursor up", hasTwoNodes, align<Alignment::top> },
    { "Align bottom", "alt + cursor down", hasTwoNodes, align<Alignment::bottom> },
    { "Distribute horizontally", "alt + shift + cursor right", hasTwoNodes, align<Alignment::rows> },
    { "Distribute vertically", "alt + shift + cursor down", hasTwoNodes, align<Alignment::columns>, true },

    { "Move left", "cursor left", hasSelection, nudge<-1, 0>, false, false },
    { "Move right", "cursor right", hasSelection, nudge<1, 0>, false, false },
    { "Move up", "cursor up", hasSelection, nudge<0, -1>, false, false },
    { "Move down", "cursor down", hasSelection, nudge<0, 1>, true, false },
    { "Select next node to the left", "ctrl + cursor left", hasSomeNodes, step<-1, 0>, false, false },
    { "Select next node to the right", "ctrl + cursor right", hasSomeNodes, step<1, 0>, false, false },
    { "Select next node above", "ctrl + cursor up", hasSomeNodes, step<0, -1>, false, false },
    { "Select next node below", "ctrl + cursor down", hasSomeNodes, step<0, 1>, true, false },

    { "Frame selection", "f", hasSomeNodes, call<&Canvas::frameSelection> },
    { "Frame all", "home", hasSomeNodes, call<&Canvas::frameAll> },
    { "Zoom in", "+|=", always, zoom<125>, false, false },
    { "Zoom out", "-", always, zoom<80>, false, false },
    { "Actual size", "0", always, resetZoom, false, false },
    { "Show or hide minimap", "m", always, call<&Canvas::toggleMap> },
};
}   // namespace

std::span<const CanvasCommand> canvasCommands() noexcept { return commands; }

}   // namespace tactus::host
