// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "canvas.hpp"

#include <host/app/model/clip_graph.hpp>
#include <host/app/text/file_path.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/graph/endpoint_text.hpp>

#include <algorithm>
#include <limits>

namespace tactus::host
{

namespace
{
bool always (const Canvas&) noexcept { return true; }

bool hasSelection (const Canvas& c) noexcept { return ! c.selection().empty(); }
bool hasNode (const Canvas& c) noexcept { return ! c.commands().selectedNodes().empty(); }
bool hasOneNode (const Canvas& c) noexcept { return c.commands().selectedNodes().size() == 1; }
bool hasClip (const Canvas& c) noexcept { return hasOneNode (c) && c.commands().selectedNodes()[0]->type == clip_type; }
bool hasTwoNodes (const Canvas& c) noexcept { return c.commands().selectedNodes().size() > 1; }
bool hasNote (const Canvas& c) noexcept { return std::ranges::any_of (c.selection(), isNote); }
bool hasOneNodeOrNote (const Canvas& c) noexcept { return hasOneNode (c) || hasNote (c); }
bool hasSomeNodes (const Canvas& c) noexcept { return ! c.scene().nodes().empty(); }
bool isInside (const Canvas& c) noexcept { return ! c.breadcrumbs().empty(); }
bool isInsideWithNode (const Canvas& c) noexcept { return isInside (c) && hasOneNode (c); }
bool hasSubgraph (const Canvas& c) noexcept { return hasOneNode (c) && c.commands().selectedNodes()[0]->face->kind == Face::Kind::subgraph; }

bool hasWire (const Canvas& c) noexcept
{
    return std::ranges::any_of (c.scene().wires(), [&] (const SceneWire& w) { return c.selection().contains (w.id); });
}

template <Alignment how>
void align (Canvas& c)
{
    c.commands().alignSelection (how);
}

template <int x, int y>
void nudge (Canvas& c)
{
    c.commands().nudgeSelection ({ x * Box::grid, y * Box::grid });
}

template <int x, int y>
void step (Canvas& c)
{
    c.commands().selectNext ({ static_cast<float> (x), static_cast<float> (y) });
}

template <int by>
void delay (Canvas& c)
{
    c.commands().delaySelection (by);
}

template <void (CanvasCommands::*command)()>
void call (Canvas& c)
{
    (c.commands().*command)();
}

template <void (Canvas::*command)()>
void view (Canvas& c)
{
    (c.*command)();
}

template <int percent>
void zoom (Canvas& c)
{
    c.commands().zoomBy (static_cast<float> (percent) / 100.0f);
}

void addNode (Canvas& c) { c.commands().requestNode ({ c.commands().placeOfNext(), {}, 0 }); }
/// Ends a drag here as Esc does, and says whether there is one, here or in a field. If a drag went on after an undo, it would replace the steps that
/// can be redone.
bool endsDrag (Canvas& c) { return c.cancelDrag() || juce::ModifierKeys::currentModifiers.isAnyMouseButtonDown(); }

void undo (Canvas& c)
{
    if (! endsDrag (c)) c.edited().undo();
}

void redo (Canvas& c)
{
    if (! endsDrag (c)) c.edited().redo();
}

void copy (Canvas& c) { c.commands().copySelection(); }
void leave (Canvas& c) { c.leaveTo (c.breadcrumbs().size() - 1); }
void resetZoom (Canvas& c) { c.commands().zoomBy (1.0f / c.view().zoom); }

void cut (Canvas& c)
{
    c.commands().copySelection();
    c.commands().removeSelection();
}

constexpr CanvasCommand commands[] {
    { NEEDS_TRANS ("Add node"), "spacebar|tab", always, addNode },
    { NEEDS_TRANS ("Add note, or region around selection"), "n", always, call<&CanvasCommands::addNote> },
    { NEEDS_TRANS ("Next region colour"), "k", hasNote, call<&CanvasCommands::recolourNotes> },
    { NEEDS_TRANS ("Connect to..."), "w", hasOneNode, call<&CanvasCommands::wireFromSelection>, false, true,
      NEEDS_TRANS ("Select one node first: W lists what it can be wired to.") },
    { NEEDS_TRANS ("Save clip as..."), "", hasClip, call<&CanvasCommands::saveClipOfSelection> },
    { NEEDS_TRANS ("Probe signal"), "p", hasSelection, call<&CanvasCommands::probeSelection>, true },

    { NEEDS_TRANS ("Undo"), "ctrl + z", always, undo },
    { NEEDS_TRANS ("Redo"), "ctrl + y|ctrl + shift + z", always, redo },
    { NEEDS_TRANS ("Cut"), "ctrl + x", hasSelection, cut },
    { NEEDS_TRANS ("Copy"), "ctrl + c", hasSelection, copy },
    { NEEDS_TRANS ("Paste"), "ctrl + v", always, call<&CanvasCommands::pasteText> },
    { NEEDS_TRANS ("Paste as a layer"), "ctrl + shift + v", hasSomeNodes, call<&CanvasCommands::pasteLayer>, false, true,
      NEEDS_TRANS ("There is no node here that a layer could join. Ctrl+V pastes the nodes.") },
    { NEEDS_TRANS ("Duplicate with incoming wires"), "ctrl + d", hasNode, call<&CanvasCommands::duplicateSelection> },
    { NEEDS_TRANS ("Delete and reconnect"), "delete|backspace", hasSelection, call<&CanvasCommands::removeSelection> },
    { NEEDS_TRANS ("Select all"), "ctrl + a", hasSomeNodes, call<&CanvasCommands::selectAll>, true },

    { NEEDS_TRANS ("Bypass"), "b", hasNode, call<&CanvasCommands::bypassSelection> },
    { NEEDS_TRANS ("Group into subgraph"), "g", hasNode, call<&CanvasCommands::groupSelection> },
    { NEEDS_TRANS ("Ungroup subgraph"), "shift + g", hasSubgraph, call<&CanvasCommands::expandSelection> },
    { NEEDS_TRANS ("Enter subgraph"), "return", hasSubgraph, call<&CanvasCommands::enterSelection> },
    { NEEDS_TRANS ("Rename"), "F2", hasOneNodeOrNote, call<&CanvasCommands::renameSelection> },
    { NEEDS_TRANS ("Edit parameters"), "return|shift + return", hasSelection, call<&CanvasCommands::editParams> },
    { NEEDS_TRANS ("Leave subgraph"), "u", isInside, leave },
    { NEEDS_TRANS ("Expose or hide port..."), "o", isInsideWithNode, call<&CanvasCommands::exposeFromSelection>, true },

    { NEEDS_TRANS ("Increase wire delay"), "]", hasWire, delay<1> },
    { NEEDS_TRANS ("Decrease wire delay"), "[", hasWire, delay<-1> },
    { NEEDS_TRANS ("Toggle wire"), "e", hasWire, call<&CanvasCommands::toggleWires> },
    { NEEDS_TRANS ("Bend wire"), "j", hasWire, call<&CanvasCommands::bendSelection>, true },

    { NEEDS_TRANS ("Arrange all"), "l", hasSomeNodes, call<&CanvasCommands::arrangeAll> },
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

    { NEEDS_TRANS ("Frame selection"), "f", hasSomeNodes, call<&CanvasCommands::frameSelection> },
    { NEEDS_TRANS ("Frame all"), "home", hasSomeNodes, view<&Canvas::frameAll> },
    { NEEDS_TRANS ("Zoom in"), "+|=", always, zoom<125>, false, false },
    { NEEDS_TRANS ("Zoom out"), "-", always, zoom<80>, false, false },
    { NEEDS_TRANS ("Actual size"), "0", always, resetZoom, false, false },
    { NEEDS_TRANS ("Show or hide minimap"), "m", always, view<&Canvas::toggleMap> },
    { NEEDS_TRANS ("Menu of the selection"), "shift + F10", always, view<&Canvas::showMenuOfSelection>, false, false },
};
}   // namespace

std::span<const CanvasCommand> canvasCommands() noexcept { return commands; }

void CanvasCommands::selectAll()
{
    Selection all;
    for (const auto& n : canvas.scene().nodes())
        all.insert (n.id);
    for (std::size_t i = 0; i < canvas.scene().notes().size(); ++i)
        all.insert (noteId (i));
    canvas.select (std::move (all));
}

void CanvasCommands::selectNext (juce::Point<float> direction)
{
    const SceneNode *from = nullptr, *next = nullptr;
    for (const auto& n : canvas.scene().nodes())
        if (canvas.selection().contains (n.id)) from = &n;
    float least = std::numeric_limits<float>::max();
    for (const auto& n : canvas.scene().nodes())
    {
        if (&n == from) continue;
        const auto d = n.bounds().getCentre() - (from == nullptr ? canvas.scene().bounds().getTopLeft() : from->bounds().getCentre());
        const float along = d.getDotProduct (direction), beside = std::abs (d.x * direction.y - d.y * direction.x);
        if (from != nullptr && along <= beside * 0.5f) continue;
        if (const float distance = along + 2.0f * beside; distance < least)
        {
            least = distance;
            next = &n;
        }
    }
    if (next != nullptr) canvas.select ({ next->id });
}

void CanvasCommands::enterSelection()
{
    if (const auto nodes = selectedNodes(); ! nodes.empty()) canvas.enter (*nodes[0]);
}

void CanvasCommands::frameSelection()
{
    juce::Rectangle<float> area;
    const auto include = [&] (juce::Rectangle<float> r) { area = area.isEmpty() ? r : area.getUnion (r); };
    for (const auto* n : selectedNodes())
        include (n->bounds());
    for (std::size_t i = 0; i < canvas.scene().notes().size(); ++i)
        if (canvas.selection().contains (noteId (i))) include (canvas.scene().notes()[i].area);
    canvas.view().frame (area.isEmpty() ? canvas.scene().bounds() : area, canvas.getLocalBounds().toFloat());
    canvas.repaint();
}

void CanvasCommands::zoomBy (float factor)
{
    canvas.view().zoomAt (canvas.getLocalBounds().getCentre().toFloat(), factor);
    canvas.repaint();
}

juce::Point<float> CanvasCommands::pointerOrCentre() const
{
    const auto pointer = canvas.getMouseXYRelative();
    return canvas.view().toCanvas ((canvas.getLocalBounds().contains (pointer) ? pointer : canvas.getLocalBounds().getCentre()).toFloat());
}

juce::Point<float> CanvasCommands::placeOfNext() const
{
    const auto* last = canvas.scene().find (added.node);
    return last != nullptr && canvas.getMouseXYRelative() == added.pointer ? last->at : pointerOrCentre();
}

std::vector<std::string> CanvasCommands::selectedPorts() const
{
    std::vector<std::string> ports;
    for (const auto& w : patchShown().wires)
        if (canvas.selection().contains (w.id)) ports.push_back (canvas.address (graph::toText (w.from)));
    for (const auto* n : selectedNodes())
        if (! n->face->outputs.empty()) ports.push_back (canvas.address (n->name + '.' + n->face->outputs.front().id));
    return ports;
}

void CanvasCommands::probeSelection()
{
    auto ports = selectedPorts();
    if (! ports.empty() && canvas.onProbe) canvas.onProbe (std::move (ports));
}

void CanvasCommands::saveClipOfSelection()
{
    const auto nodes = selectedNodes();
    if (nodes.size() != 1 || ! canvas.onSaveClip) return;
    const auto* node = patchShown().find (nodes[0]->name);
    if (node == nullptr) return;
    const auto written = node->settings.find ("clip");
    if (written == node->settings.end() || ! written->is_string() || written->asString().empty())
        return canvas.notice (filled (TRANS ("%1 has no clip yet. Drop a clip file on it first."), node->name));
    canvas.onSaveClip (std::filesystem::path (resolved (written->asString(), document.graph().folder)));
}

void CanvasCommands::requestNode (NodeRequest request)
{
    if (canvas.onNodeRequested) canvas.onNodeRequested (std::move (request));
}

void CanvasCommands::editParams()
{
    if (canvas.onEditParams) canvas.onEditParams();
}

}   // namespace tactus::host
