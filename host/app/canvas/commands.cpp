// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "canvas.hpp"

#include <host/app/model/clip_graph.hpp>
#include <host/app/text/filled.hpp>

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
    { NEEDS_TRANS ("Add node"), "spacebar|tab", always, addNode },
    { NEEDS_TRANS ("Add note, or region around selection"), "n", always, call<&Canvas::addNote> },
    { NEEDS_TRANS ("Next region colour"), "k", hasNote, call<&Canvas::recolourNotes> },
    { NEEDS_TRANS ("Connect to..."), "w", hasOneNode, call<&Canvas::wireFromSelection> },
    { NEEDS_TRANS ("Save clip as..."), "", hasClip, call<&Canvas::saveClipOfSelection> },
    { NEEDS_TRANS ("Probe signal"), "p", hasSelection, call<&Canvas::probeSelection>, true },

    { NEEDS_TRANS ("Undo"), "ctrl + z", always, undo },
    { NEEDS_TRANS ("Redo"), "ctrl + y|ctrl + shift + z", always, redo },
    { NEEDS_TRANS ("Cut"), "ctrl + x", hasSelection, cut },
    { NEEDS_TRANS ("Copy"), "ctrl + c", hasSelection, copy },
    { NEEDS_TRANS ("Paste"), "ctrl + v", always, call<&Canvas::pasteText> },
    { NEEDS_TRANS ("Duplicate with incoming wires"), "ctrl + d", hasNode, call<&Canvas::duplicateSelection> },
    { NEEDS_TRANS ("Delete and reconnect"), "delete|backspace", hasSelection, call<&Canvas::removeSelection> },
    { NEEDS_TRANS ("Select all"), "ctrl + a", hasSomeNodes, call<&Canvas::selectAll>, true },

    { NEEDS_TRANS ("Bypass"), "b", hasNode, call<&Canvas::bypassSelection> },
    { NEEDS_TRANS ("Group into subgraph"), "g", hasNode, call<&Canvas::groupSelection> },
    { NEEDS_TRANS ("Ungroup subgraph"), "shift + g", hasSubgraph, call<&Canvas::expandSelection> },
    { NEEDS_TRANS ("Enter subgraph"), "return", hasSubgraph, call<&Canvas::enterSelection> },
    { NEEDS_TRANS ("Edit parameters"), "return|shift + return", hasSelection, call<&Canvas::editParams> },
    { NEEDS_TRANS ("Leave subgraph"), "u", isInside, leave },
    { NEEDS_TRANS ("Expose or hide port..."), "o", isInsideWithNode, call<&Canvas::exposeFromSelection>, true },

    { NEEDS_TRANS ("Increase wire delay"), "]", hasWire, delay<1> },
    { NEEDS_TRANS ("Decrease wire delay"), "[", hasWire, delay<-1> },
    { NEEDS_TRANS ("Toggle wire"), "e", hasWire, call<&Canvas::toggleWires>, true },

    { NEEDS_TRANS ("Arrange all"), "l", hasSomeNodes, call<&Canvas::arrangeAll> },
    { NEEDS_TRANS ("Align left"), "alt + cursor left", hasTwoNodes, align<Alignment::left> },
    { NEEDS_TRANS ("Align right"), "alt + cursor right", hasTwoNodes, align<Alignment::right> },
    { NEEDS_TRANS ("Align top"), "alt + cursor up", hasTwoNodes, align<Alignment::top> },
    { NEEDS_TRANS ("Align bottom"), "alt + cursor down", hasTwoNodes, align<Alignment::bottom> },
    { NEEDS_TRANS ("Distribute horizontally"), "alt + shift + cursor right", hasTwoNodes, align<Alignment::rows> },
    { NEEDS_TRANS ("Distribute vertically"), "alt + shift + cursor down", hasTwoNodes, align<Alignment::columns>, true },

    { NEEDS_TRANS ("Move left"), "cursor left", hasSelection, nudge<-1, 0>, false, false },
    { NEEDS_TRANS ("Move right"), "cursor right", hasSelection, nudge<1, 0>, false, false },
    { NEEDS_TRANS ("Move up"), "cursor up", hasSelection, nudge<0, -1>, false, false },
    { NEEDS_TRANS ("Move down"), "cursor down", hasSelection, nudge<0, 1>, true, false },
    { NEEDS_TRANS ("Select next node to the left"), "ctrl + cursor left", hasSomeNodes, step<-1, 0>, false, false },
    { NEEDS_TRANS ("Select next node to the right"), "ctrl + cursor right", hasSomeNodes, step<1, 0>, false, false },
    { NEEDS_TRANS ("Select next node above"), "ctrl + cursor up", hasSomeNodes, step<0, -1>, false, false },
    { NEEDS_TRANS ("Select next node below"), "ctrl + cursor down", hasSomeNodes, step<0, 1>, true, false },

    { NEEDS_TRANS ("Frame selection"), "f", hasSomeNodes, call<&Canvas::frameSelection> },
    { NEEDS_TRANS ("Frame all"), "home", hasSomeNodes, call<&Canvas::frameAll> },
    { NEEDS_TRANS ("Zoom in"), "+|=", always, zoom<125>, false, false },
    { NEEDS_TRANS ("Zoom out"), "-", always, zoom<80>, false, false },
    { NEEDS_TRANS ("Actual size"), "0", always, resetZoom, false, false },
    { NEEDS_TRANS ("Show or hide minimap"), "m", always, call<&Canvas::toggleMap> },
};
}   // namespace

std::span<const CanvasCommand> canvasCommands() noexcept { return commands; }

}   // namespace tactus::host
