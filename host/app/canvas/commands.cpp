// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "canvas.hpp"

#include <algorithm>

namespace tactus::host
{

namespace
{
bool always (const Canvas&) noexcept { return true; }

std::size_t nodesSelected (const Canvas& c) noexcept
{
    return static_cast<std::size_t> (std::ranges::count_if (c.scene().nodes(), [&] (const SceneNode& n)
                                                            { return c.selection().contains (n.id); }));
}

bool anything (const Canvas& c) noexcept { return ! c.selection().empty(); }
bool aNode (const Canvas& c) noexcept { return nodesSelected (c) > 0; }
bool oneNode (const Canvas& c) noexcept { return nodesSelected (c) == 1; }
bool twoNodes (const Canvas& c) noexcept { return nodesSelected (c) > 1; }
bool aNote (const Canvas& c) noexcept { return std::ranges::any_of (c.selection(), isNote); }
bool someNodes (const Canvas& c) noexcept { return ! c.scene().nodes().empty(); }
bool inside (const Canvas& c) noexcept { return ! c.way().empty(); }

bool insideOnANode (const Canvas& c) noexcept { return inside (c) && oneNode (c); }

bool aWire (const Canvas& c) noexcept
{
    return std::ranges::any_of (c.scene().wires(), [&] (const SceneWire& w)
                                { return c.selection().contains (w.id); });
}

bool aSubgraph (const Canvas& c) noexcept
{
    return oneNode (c) && std::ranges::any_of (c.scene().nodes(), [&] (const SceneNode& n)
                                               { return c.selection().contains (n.id) && n.face->kind == Face::Kind::subgraph; });
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

constexpr CanvasCommand all[] {
    { "Add a node", "spacebar|tab", always, [] (Canvas& c)
      { c.wantNode ({ c.pointerOrCentre(), {}, 0 }); } },
    { "Add a note, or a region around what is selected", "n", always, [] (Canvas& c)
      { c.addNote(); } },
    { "Another colour for the region, or none", "k", aNote, [] (Canvas& c)
      { c.recolourNotes(); } },
    { "Wire from here", "w", oneNode, [] (Canvas& c)
      { c.wireFromSelection(); } },
    { "Probe what it carries", "p", anything, [] (Canvas& c)
      { c.probeSelection(); },
      true },

    { "Undo", "ctrl + z", always, [] (Canvas& c)
      { c.edited().undo(); } },
    { "Redo", "ctrl + y|ctrl + shift + z", always, [] (Canvas& c)
      { c.edited().redo(); } },
    { "Cut", "ctrl + x", anything, [] (Canvas& c)
      {
          c.copySelection();
          c.removeSelection();
      } },
    { "Copy", "ctrl + c", anything, [] (Canvas& c)
      { c.copySelection(); } },
    { "Paste", "ctrl + v", always, [] (Canvas& c)
      { c.pasteText(); } },
    { "Duplicate, with the wires that come in", "ctrl + d", aNode, [] (Canvas& c)
      { c.duplicateSelection(); } },
    { "Delete, and heal the wires through", "delete|backspace", anything, [] (Canvas& c)
      { c.removeSelection(); } },
    { "Select all", "ctrl + a", someNodes, [] (Canvas& c)
      { c.selectAll(); },
      true },

    { "Bypass", "b", aNode, [] (Canvas& c)
      { c.bypassSelection(); } },
    { "Make a subgraph of it", "g", aNode, [] (Canvas& c)
      { c.groupSelection(); } },
    { "Put a subgraph's inside in its place", "shift + g", aSubgraph, [] (Canvas& c)
      { c.expandSelection(); } },
    { "Enter the subgraph", "return", aSubgraph, [] (Canvas& c)
      { c.enterSelection(); } },
    { "Leave the subgraph", "u", inside, [] (Canvas& c)
      { c.leaveTo (c.way().size() - 1); } },
    { "Show a port of it outside, or hide it", "o", insideOnANode, [] (Canvas& c)
      { c.exposeFromSelection(); },
      true },

    { "One more tick of delay on the wire", "]", aWire, delay<1> },
    { "One tick of delay less", "[", aWire, delay<-1> },
    { "Switch the wire off or on", "e", aWire, [] (Canvas& c)
      { c.toggleWires(); },
      true },

    { "Arrange all", "l", someNodes, [] (Canvas& c)
      { c.arrangeAll(); } },
    { "Align left", "alt + cursor left", twoNodes, align<Alignment::left> },
    { "Align right", "alt + cursor right", twoNodes, align<Alignment::right> },
    { "Align at the top", "alt + cursor up", twoNodes, align<Alignment::top> },
    { "Align at the bottom", "alt + cursor down", twoNodes, align<Alignment::bottom> },
    { "Spread from left to right", "alt + shift + cursor right", twoNodes, align<Alignment::rows> },
    { "Spread from top to bottom", "alt + shift + cursor down", twoNodes, align<Alignment::columns>, true },

    { "Move left", "cursor left", anything, nudge<-1, 0>, false, false },
    { "Move right", "cursor right", anything, nudge<1, 0>, false, false },
    { "Move up", "cursor up", anything, nudge<0, -1>, false, false },
    { "Move down", "cursor down", anything, nudge<0, 1>, true, false },
    { "Select the next one at the left", "ctrl + cursor left", someNodes, step<-1, 0>, false, false },
    { "Select the next one at the right", "ctrl + cursor right", someNodes, step<1, 0>, false, false },
    { "Select the next one above", "ctrl + cursor up", someNodes, step<0, -1>, false, false },
    { "Select the next one below", "ctrl + cursor down", someNodes, step<0, 1>, true, false },

    { "Frame what is selected", "f", someNodes, [] (Canvas& c)
      { c.frameSelection(); } },
    { "Frame all", "home", someNodes, [] (Canvas& c)
      { c.frameAll(); } },
    { "Zoom in", "+|=", always, [] (Canvas& c)
      { c.zoomBy (1.25f); },
      false, false },
    { "Zoom out", "-", always, [] (Canvas& c)
      { c.zoomBy (0.8f); },
      false, false },
    { "Actual size", "0", always, [] (Canvas& c)
      { c.zoomBy (1.0f / c.view().zoom); },
      false, false },
    { "Show or hide the map", "m", always, [] (Canvas& c)
      { c.toggleMap(); } },
};
}   // namespace

std::span<const CanvasCommand> canvasCommands() noexcept { return all; }

}   // namespace tactus::host
