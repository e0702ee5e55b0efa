// SPDX-License-Identifier: GPL-3.0-or-later
// The canvas commands that edit the selection.
#include "arrange.hpp"
#include "canvas.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/model/clipboard.hpp>
#include <host/app/model/fragment.hpp>
#include <host/app/model/param_now.hpp>
#include <host/app/model/patch.hpp>
#include <host/app/model/quantity_text.hpp>
#include <host/app/model/step_text.hpp>
#include <host/app/model/wire_rules.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/endpoints.hpp>
#include <tactus/run/turn.hpp>

#include <array>

namespace tactus::host
{

const graph::Patch& Canvas::patchShown() const
{
    const auto* in = findPatch (document.graph(), patch());
    return in == nullptr ? document.graph().root : *in;
}

std::vector<const SceneNode*> Canvas::selectedNodes() const
{
    std::vector<const SceneNode*> nodes;
    for (const auto& n : shown->nodes())
        if (highlights.selected.contains (n.id)) nodes.push_back (&n);
    return nodes;
}

std::optional<graph::Command> Canvas::storePositions() const
{
    std::vector<std::pair<graph::Id, juce::Point<float>>> places;
    for (const auto& n : patchShown().nodes)
        if (const auto* node = shown->find (n.id); node != nullptr && ! positionOf (n)) places.emplace_back (n.id, node->at);
    if (places.empty()) return std::nullopt;
    return placeNodes (document.graph(), patch(), places);
}

bool Canvas::perform (graph::Command command, graph::Step step)
{
    auto stored = storePositions();
    if (! stored) return document.perform (std::move (command), step);
    graph::Batch all { graph::nameOf (command), {} };
    all.commands.push_back (std::move (*stored));
    all.commands.push_back (std::move (command));
    return document.perform (std::move (all), step);
}

graph::Graph Canvas::placedGraph() const
{
    auto placed = document.graph();
    if (const auto stored = storePositions()) (void)graph::apply (placed, *stored);
    return placed;
}

void Canvas::removeSelection()
{
    if (highlights.selected.empty()) return;
    graph::Batch all { NEEDS_TRANS ("delete"), {} };
    if (std::ranges::any_of (highlights.selected, isNote))
    {
        std::vector<Note> left;
        for (std::size_t i = 0; i < shown->notes().size(); ++i)
            if (! highlights.selected.contains (noteId (i))) left.push_back (shown->notes()[i]);
        all.commands.push_back (setNotes (document.graph(), patch(), left, NEEDS_TRANS ("delete")));
    }
    all.commands.push_back (removeSelected (document.graph(), patch(), *shown, highlights.selected));
    perform (std::move (all));
}

void Canvas::duplicateSelection()
{
    Selection made;
    auto command = duplicate (placedGraph(), patch(), *shown, highlights.selected, made);
    if (command && perform (std::move (*command))) select (made);
}

void Canvas::copySelection() const
{
    if (! highlights.selected.empty()) copyToClipboard (copyText (placedGraph(), patch(), highlights.selected));
}

void Canvas::pasteText()
{
    const auto text = textFromClipboard();
    juce::Point<double> offset { 32.0, 32.0 };   // next to the original
    if (const auto corner = cornerOf (text); corner && isMouseOver())
    {
        const auto at = (pointerOrCentre() / Box::grid).roundToInt().toDouble() * static_cast<double> (Box::grid);
        offset = at - *corner;
    }
    Selection made;
    auto command = paste (document.graph(), patch(), text, offset, made);
    if (! command)
        notice (filled (TRANS ("Nothing to paste: %1"), fromUtf8 (command.error().text)));
    else if (! made.empty() && perform (*std::move (command)))
        select (made);
}

void Canvas::bypassSelection() { perform (toggleBypass (document.graph(), patch(), highlights.selected)); }

void Canvas::groupSelection()
{
    auto command = group (document.graph(), patch(), highlights.selected);
    if (! command) return;
    const auto name = std::get<graph::CollapseNodes> (command->edit).name;
    if (! perform (std::move (*command))) return;
    for (const auto& n : shown->nodes())
        if (n.name == name) select ({ n.id });
}

void Canvas::expandSelection()
{
    if (const auto nodes = selectedNodes(); ! nodes.empty()) perform (graph::ExpandNode { patch(), nodes[0]->name });
}

void Canvas::enterSelection()
{
    if (const auto nodes = selectedNodes(); ! nodes.empty()) enter (*nodes[0]);
}

void Canvas::alignSelection (Alignment how)
{
    const auto nodes = selectedNodes();
    std::vector<juce::Rectangle<float>> boxes;
    for (const auto* n : nodes)
        boxes.push_back (n->bounds());
    boxes = aligned (std::move (boxes), how);
    std::vector<std::pair<graph::Id, juce::Point<float>>> places;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        places.emplace_back (nodes[i]->id, boxes[i].getPosition());
    auto command = placeNodes (document.graph(), patch(), places);
    std::get<graph::Batch> (command.edit).name = NEEDS_TRANS ("align");
    perform (std::move (command));
}

void Canvas::arrangeAll()
{
    std::vector<juce::Point<float>> sizes;
    std::vector<std::pair<int, int>> wires;
    for (const auto& n : shown->nodes())
        sizes.emplace_back (n.box.width, n.box.height);
    for (const auto& w : shown->wires())
        if (w.delay == 0) wires.emplace_back (w.start, w.end);
    const auto places = arrange (sizes, wires);
    std::vector<std::pair<graph::Id, juce::Point<float>>> to;
    for (std::size_t i = 0; i < places.size(); ++i)
        to.emplace_back (shown->nodes()[i].id, places[i]);
    auto command = placeNodes (document.graph(), patch(), to);
    std::get<graph::Batch> (command.edit).name = NEEDS_TRANS ("arrange");
    perform (std::move (command));
    frameAll();
    endEdit();
}

void Canvas::nudgeSelection (juce::Point<float> by)
{
    graph::Batch all { NEEDS_TRANS ("move"), {} };
    std::vector<std::pair<graph::Id, juce::Point<float>>> places;
    for (const auto* n : selectedNodes())
        places.emplace_back (n->id, n->at + by);
    all.commands.push_back (placeNodes (document.graph(), patch(), places));
    if (std::ranges::any_of (highlights.selected, isNote))
    {
        auto notes = shown->notes();
        for (std::size_t i = 0; i < notes.size(); ++i)
            if (highlights.selected.contains (noteId (i))) notes[i].area += by;
        all.commands.push_back (setNotes (document.graph(), patch(), notes, NEEDS_TRANS ("move")));
    }
    perform (std::move (all));
}

void Canvas::delaySelection (int ticks)
{
    graph::Batch all { ticks > 0 ? NEEDS_TRANS ("increase delay") : NEEDS_TRANS ("decrease delay"), {} };
    for (const auto& w : patchShown().wires)
        if (highlights.selected.contains (w.id) && w.delay + ticks >= 0)
        {
            auto to = w;
            to.delay += ticks;
            all.commands.push_back (graph::ChangeWire { patch(), w.id, std::move (to) });
        }
    if (! all.commands.empty()) perform (std::move (all));
}

void Canvas::toggleWires()
{
    bool any_on = false;
    for (const auto& w : patchShown().wires)
        any_on = any_on || (highlights.selected.contains (w.id) && w.enabled.value_or (true));
    graph::Batch all { any_on ? NEEDS_TRANS ("switch wires off") : NEEDS_TRANS ("switch wires on"), {} };
    for (const auto& w : patchShown().wires)
        if (highlights.selected.contains (w.id) && w.enabled.value_or (true) == any_on)
        {
            auto to = w;
            to.enabled = any_on ? std::optional (false) : std::nullopt;
            all.commands.push_back (graph::ChangeWire { patch(), w.id, std::move (to) });
        }
    if (! all.commands.empty()) perform (std::move (all));
}

void Canvas::addNote()
{
    juce::Rectangle<float> around;
    for (const auto* n : selectedNodes())
        around = around.isEmpty() ? n->bounds() : around.getUnion (n->bounds());
    constexpr float margin = 3 * Box::grid, width = 200.0f, height = 56.0f;
    auto notes = shown->notes();
    if (around.isEmpty())
        notes.push_back ({ juce::Rectangle<float> (width, height).withPosition (freePlace (pointerOrCentre())), {}, {} });
    else
    {
        const auto area = around.expanded (margin).withTop (around.getY() - margin - Box::header_height);
        notes.push_back ({ area, {}, std::string (note_colours[notes.size() % std::size (note_colours)]) });
    }
    perform (setNotes (document.graph(), patch(), notes, NEEDS_TRANS ("add note")));
    select ({ noteId (notes.size() - 1) });
    editNote (notes.size() - 1);
}

void Canvas::recolourNotes()
{
    auto notes = shown->notes();
    for (std::size_t i = 0; i < notes.size(); ++i)
        if (highlights.selected.contains (noteId (i)))
        {
            const auto* next = notes[i].isRegion() ? std::ranges::find (note_colours, notes[i].colour) + 1 : std::begin (note_colours);
            notes[i].colour = next == std::end (note_colours) ? std::string() : std::string (*next);
        }
    perform (setNotes (document.graph(), patch(), notes, NEEDS_TRANS ("colour region")));
}

void Canvas::editNote (std::size_t i)
{
    if (i >= shown->notes().size()) return;
    const auto& note = shown->notes()[i];
    const auto area = note.isRegion() ? note.area.withHeight (Box::header_height) : note.area;
    openEditor (area, juce::String::fromUTF8 (note.text.c_str()), ! note.isRegion(), [this, i] (const juce::String& text) {
        auto notes = shown->notes();
        if (i >= notes.size()) return;
        notes[i].text = text.toStdString();
        perform (setNotes (document.graph(), patch(), notes, NEEDS_TRANS ("edit note")));
    });
}

void Canvas::setParam (const SceneNode& shown_node, const FacePort& port, const std::optional<Json>& value, graph::Step step)
{
    const auto* node = patchShown().find (shown_node.name);
    if (node == nullptr) return;
    if (auto command = changeParam (document.graph(), patch(), *node, port, value))
        perform (std::move (*command), step);
    else
        notice (juce::String (outOfRangeText (document.graph(), *node, port)));
}

void Canvas::editParam (const SceneNode& node, const Socket& socket)
{
    const auto* sheet = socket.port->sheet;
    if (sheet == nullptr || socket.port->width != 1 || socket.port->isChoice()) return;
    const PortId id { node.id, Role::param, socket.port->id };
    openEditor (socket.row.translated (node.at.x, node.at.y), socket.value, false, [this, id] (const juce::String& text) {
        const auto param = shown->findPort (id);
        if (! param || param.port->sheet == nullptr) return;
        const auto read = readQuantity (readValue (text.trim().toStdString()), *param.port->sheet);
        if (! read) return notice (juce::String (param.node->name + '.' + id.port + ": ") + fromUtf8 (read.error().text));
        setParam (*param.node, *param.port, read->toJson());
    });
}

void Canvas::openEditor (juce::Rectangle<float> area, const juce::String& text, bool several_lines, std::function<void (const juce::String&)> done)
{
    closeEditor (true);
    on_edited = std::move (done);
    editor = std::make_unique<juce::TextEditor>();
    editor->setMultiLine (several_lines);
    editor->setReturnKeyStartsNewLine (false);
    editor->setFont (lookOf (*this).font (13.0f));
    editor->setText (text, false);
    const auto box = juce::Rectangle<float> (window.toPixels (area.getTopLeft()), window.toPixels (area.getBottomRight())).toNearestInt();
    editor->setBounds (box.withWidth (std::max (120, box.getWidth())).withHeight (std::max (24, box.getHeight())));
    editor->onReturnKey = editor->onFocusLost = [this] { closeEditor (true); };
    editor->onEscapeKey = [this] { closeEditor (false); };
    addAndMakeVisible (*editor);
    takeFocus (*editor);
    editor->selectAll();
}

void Canvas::closeEditor (bool keep)
{
    const std::shared_ptr<juce::TextEditor> ended = std::move (editor);
    if (! ended) return;
    ended->onFocusLost = nullptr;
    removeChildComponent (ended.get());
    juce::MessageManager::callAsync ([ended] {});   // deletes the editor after the current event, which may come from the editor itself
    const auto done = std::exchange (on_edited, nullptr);
    if (keep) done (ended->getText());
}

void Canvas::probeSelection()
{
    std::vector<std::string> ports;
    for (const auto& w : patchShown().wires)
        if (highlights.selected.contains (w.id)) ports.push_back (address (graph::toText (w.from)));
    for (const auto* n : selectedNodes())
        if (! n->face->outputs.empty()) ports.push_back (address (n->name + '.' + n->face->outputs.front().id));
    if (! ports.empty() && onProbe) onProbe (std::move (ports));
}

void Canvas::wireFromSelection()
{
    const auto nodes = selectedNodes();
    if (nodes.empty() || ! onChoose) return;
    const auto& from = *nodes.back();
    std::vector<std::pair<PortId, PortId>> wires;
    std::vector<PaletteEntry> entries;
    for (const auto& out : from.face->outputs)
        for (const auto& n : shown->nodes())
            for (const auto* ports : { &n.face->inputs, &n.face->params })
                for (const auto& in : *ports)
                {
                    if (n.id == from.id || ! checkWire ({ &out, from.quantityOf (out) }, { &in, n.quantityOf (in) })) continue;
                    entries.push_back ({ from.name + '.' + out.id + " -> " + n.name + '.' + in.id, {}, in.about });
                    wires.push_back ({ { from.id, Role::output, out.id }, { n.id, in.role, in.id } });
                }
    onChoose (filled (TRANS ("Connect %1 to..."), from.name), entries, [this, wires, entries] (const std::string& chosen) {
        const auto entry = std::ranges::find (entries, chosen, &PaletteEntry::type);
        if (entry == entries.end()) return;
        const auto& [out, in] = wires[static_cast<std::size_t> (entry - entries.begin())];
        const auto a = shown->findPort (out), b = shown->findPort (in);
        if (a && b) join (a, b);
    });
}

void Canvas::exposeFromSelection()
{
    const auto nodes = selectedNodes();
    if (nodes.empty() || entered.empty() || ! onChoose) return;
    const auto& node = *nodes.back();
    std::vector<PaletteEntry> entries;
    std::vector<PortId> ports;
    for (const auto role : { Role::input, Role::param, Role::output })
        for (const auto& p : node.face->of (role))
        {
            entries.push_back ({ node.name + '.' + p.id, {}, p.about });
            ports.push_back ({ node.id, role, p.id });
        }
    onChoose (TRANS ("Expose or hide port"), entries, [this, entries, ports] (const std::string& chosen) {
        const auto entry = std::ranges::find (entries, chosen, &PaletteEntry::type);
        if (entry == entries.end() || entered.empty()) return;
        const auto found = shown->findPort (ports[static_cast<std::size_t> (entry - entries.begin())]);
        if (found) perform (toggleExposed (document.graph(), patch(), found.node->name, *found.port));
    });
}

juce::Point<float> Canvas::freePlace (juce::Point<float> at) const
{
    const juce::Point<float> usual_size { 160.0f, 96.0f };
    const auto isTaken = [&] {
        const juce::Rectangle<float> box { at, at + usual_size };
        return std::ranges::any_of (shown->nodes(), [&] (const SceneNode& n) { return n.bounds().intersects (box); })
               || std::ranges::any_of (shown->notes(), [&] (const Note& n) { return ! n.isRegion() && n.area.intersects (box); });
    };
    while (isTaken())
        at.y += 2 * Box::grid;
    return at;
}

void Canvas::addNodeAt (const std::string& type, const NodeRequest& request)
{
    graph::Id made = 0;
    const auto at = request.wire != 0 ? request.at : freePlace (request.at);
    if (! perform (addNode (document.graph(), patch(), type, at, made))) return;
    select ({ made });
    if (request.wire != 0)
    {
        if (auto command = insertInto (document.graph(), patch(), *shown, request.wire, made)) perform (std::move (*command), graph::Step::joined);
        return;
    }
    const auto* node = shown->find (made);
    const auto other = request.start ? shown->findPort (*request.start) : ScenePort {};
    if (! other || node == nullptr) return;

    const bool is_output = other.port->role == Role::output;
    for (const auto& p : is_output ? node->face->inputs : node->face->outputs)
    {
        const ScenePort own { node, &p };
        const auto &from = is_output ? other : own, &to = is_output ? own : other;
        if (! checkWire (from.end(), to.end())) continue;
        perform (connect (document.graph(), patch(), { *from.node, *from.port }, { *to.node, *to.port }), graph::Step::joined);
        return;
    }
}

void Canvas::join (const ScenePort& from, const ScenePort& to)
{
    if (from.port->width == to.port->width)
    {
        perform (connect (document.graph(), patch(), { *from.node, *from.port }, { *to.node, *to.port }));
        return;
    }
    if (! onChoose) return;
    const bool of_output = from.port->width == 3;
    const auto& vector = of_output ? from : to;
    constexpr std::array axes { ".x", ".y", ".z" };
    std::vector<PaletteEntry> entries;
    for (const auto* axis : axes)
        entries.push_back ({ vector.node->name + '.' + vector.port->id + axis,
                             {},
                             (of_output ? TRANS ("Send this component") : TRANS ("Feed this component")).toStdString() });
    const PortId out { from.node->id, Role::output, from.port->id }, in { to.node->id, to.port->role, to.port->id };
    onChoose (TRANS ("Which component?"), entries, [this, out, in, entries, of_output] (const std::string& chosen) {
        const auto component = static_cast<int> (std::ranges::find (entries, chosen, &PaletteEntry::type) - entries.begin());
        const auto a = shown->findPort (out), b = shown->findPort (in);
        if (component >= 3 || ! a || ! b) return;
        perform (connect (document.graph(), patch(), { *a.node, *a.port, of_output ? component : -1 }, { *b.node, *b.port, of_output ? -1 : component }));
    });
}

}   // namespace tactus::host
