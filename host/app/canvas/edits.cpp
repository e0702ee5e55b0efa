// SPDX-License-Identifier: GPL-3.0-or-later
// The canvas commands that edit the selection.
#include "arrange.hpp"
#include "canvas.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/model/clipboard.hpp>
#include <host/app/model/fragment.hpp>
#include <host/app/model/param_now.hpp>
#include <host/app/model/patch.hpp>
#include <host/app/model/quantity_text.hpp>
#include <host/app/model/step_text.hpp>
#include <host/app/model/value_in_effect.hpp>
#include <host/app/storage/carry_files.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/run/turn.hpp>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <vector>

namespace tactus::host
{

namespace
{
const std::vector<std::filesystem::path> no_files;   // that are copied when a graph is carried to another folder

/// A value that was typed over the one that a node shows: a quantity, or a vector such as "(0, 0, 1)", with or without its parentheses and commas.
Result<Json> readTyped (const std::string& text, const std::string& shown, const FacePort& port)
{
    const auto read = [&] (const std::string& part) -> Result<Json> {
        const auto quantity = readQuantity (readValue (part), *port.sheet);
        if (! quantity) return quantity.error();
        return quantity->toJson();
    };
    if (port.width == 1)
    {
        const auto before = readQuantity (readValue (shown), *port.sheet);
        const auto typed = before ? host::readTyped (text, *before, *port.sheet) : readQuantity (readValue (text), *port.sheet);
        return typed ? Result<Json> (typed->toJson()) : typed.error();
    }
    auto all = Json::array();
    for (const auto& part : juce::StringArray::fromTokens (fromUtf8 (text).removeCharacters ("()"), text.find (',') == text.npos ? " " : ",", {}))
    {
        if (part.trim().isEmpty()) continue;
        auto component = read (part.trim().toStdString());
        if (! component) return component;
        all.push_back (std::move (*component));
    }
    if (static_cast<int> (all.size()) != port.width)
        return Message::error ("param/components", {}, TRANS ("a vector has three components, such as (0, 0, 1)").toStdString());
    return all;
}
}   // namespace

const graph::Patch& CanvasCommands::patchShown() const
{
    const auto* in = findPatch (document.graph(), canvas.patch());
    return in == nullptr ? document.graph().root : *in;
}

std::vector<const SceneNode*> CanvasCommands::selectedNodes() const
{
    std::vector<const SceneNode*> nodes;
    for (const auto& n : canvas.scene().nodes())
        if (canvas.selection().contains (n.id)) nodes.push_back (&n);
    return nodes;
}

std::optional<graph::Command> CanvasCommands::storePositions() const
{
    std::vector<std::pair<graph::Id, juce::Point<float>>> places;
    for (const auto& n : patchShown().nodes)
        if (const auto* node = canvas.scene().find (n.id); node != nullptr && ! positionOf (n)) places.emplace_back (n.id, node->at);
    if (places.empty()) return std::nullopt;
    return placeNodes (document.graph(), canvas.patch(), places);
}

bool CanvasCommands::perform (graph::Command command, graph::Step step)
{
    auto stored = storePositions();
    if (! stored) return document.perform (std::move (command), step);
    graph::Batch all { graph::nameOf (command), {} };
    all.commands.push_back (std::move (*stored));
    all.commands.push_back (std::move (command));
    return document.perform (std::move (all), step);
}

graph::Graph CanvasCommands::graphWithPlaces() const
{
    auto shown = document.graph();
    if (const auto stored = storePositions()) (void)graph::apply (shown, *stored);
    return shown;
}

Selection CanvasCommands::performPlaced (graph::Command command)
{
    auto then = graphWithPlaces();
    graph::Batch all { graph::nameOf (command), { command } };
    std::vector<std::pair<graph::Id, juce::Point<float>>> places;
    if (graph::apply (then, command))
    {
        const auto* patch = findPatch (then, canvas.patch());
        const auto scene = canvas.sceneOf (then);
        for (const auto& n : scene->nodes())
            if (const auto* node = patch->find (n.name); node != nullptr && ! positionOf (*node)) places.emplace_back (n.id, n.at);
        if (! places.empty()) all.commands.push_back (placeNodes (then, canvas.patch(), places));
    }
    if (! perform (std::move (all))) return {};
    Selection made;
    juce::Rectangle<float> area;
    for (const auto& [id, place] : places)
        if (const auto* node = canvas.scene().find (id))
        {
            made.insert (id);
            area = area.isEmpty() ? node->bounds() : area.getUnion (node->bounds());
        }
    if (! made.empty()) canvas.bringIntoView (area);
    return made;
}

void CanvasCommands::makeRoom (const Scene& before)
{
    const auto& nodes = canvas.scene().nodes();
    std::vector<juce::Rectangle<float>> was, boxes;
    for (const auto& n : nodes)
    {
        const auto* old = before.find (n.id);
        boxes.push_back (n.bounds());
        was.push_back (old != nullptr && old->at == n.at ? old->bounds() : n.bounds());
    }
    if (was == boxes) return;
    pushApart (was, boxes);
    std::vector<std::pair<graph::Id, juce::Point<float>>> places;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (boxes[i].getPosition() != nodes[i].at) places.emplace_back (nodes[i].id, boxes[i].getPosition());
    if (! places.empty()) perform (placeNodes (graphWithPlaces(), canvas.patch(), places), graph::Step::joined);
}

bool CanvasCommands::performBeside (graph::Command command, const Selection& made)
{
    auto then = graphWithPlaces();
    graph::Batch all { graph::nameOf (command), { command } };
    if (graph::apply (then, command))
    {
        const auto scene = canvas.sceneOf (then);
        std::vector<juce::Rectangle<float>> added, others;
        juce::Rectangle<float> block;
        const auto add = [&] (graph::Id id, juce::Rectangle<float> box) {
            (made.contains (id) ? added : others).push_back (box);
            if (made.contains (id)) block = block.isEmpty() ? box : block.getUnion (box);
        };
        auto notes = scene->notes();
        for (const auto& n : scene->nodes())
            add (n.id, n.bounds());
        for (std::size_t i = 0; i < notes.size(); ++i)
            if (! notes[i].isRegion()) add (noteId (i), notes[i].area);
        const auto isCovering = [&] (const auto& box) { return std::ranges::any_of (others, [&] (const auto& o) { return o.intersects (box); }); };
        if (std::ranges::any_of (added, isCovering))
        {
            const auto by = clearPlace (block, others) - block.getPosition();
            all.commands.push_back (moved (then, canvas.patch(), movedParts (then, canvas.patch(), *scene, made), by));
            bool has_notes = false;
            for (std::size_t i = 0; i < notes.size(); ++i)
                if (made.contains (noteId (i)))
                {
                    notes[i].area += by;
                    has_notes = true;
                }
            if (has_notes) all.commands.push_back (setNotes (then, canvas.patch(), notes, NEEDS_TRANS ("move")));
        }
    }
    return perform (std::move (all));
}

graph::Graph CanvasCommands::graphAsShown() const
{
    return withValuesInEffect (graphWithPlaces(), canvas.seen(), canvas.types());
}

void CanvasCommands::removeSelection()
{
    if (canvas.selection().empty()) return;
    if (const auto bend = canvas.highlighted().bend) return removeBend (*bend);
    graph::Batch all { NEEDS_TRANS ("delete"), {} };
    if (std::ranges::any_of (canvas.selection(), isNote))
    {
        std::vector<Note> left;
        for (std::size_t i = 0; i < canvas.scene().notes().size(); ++i)
            if (! canvas.selection().contains (noteId (i))) left.push_back (canvas.scene().notes()[i]);
        all.commands.push_back (setNotes (document.graph(), canvas.patch(), left, NEEDS_TRANS ("delete")));
    }
    all.commands.push_back (removeSelected (document.graph(), canvas.patch(), canvas.scene(), canvas.selection()));
    if (canvas.completeRemoval)
        perform (canvas.completeRemoval (std::move (all)));
    else
        perform (std::move (all));
}

void CanvasCommands::duplicateSelection()
{
    Selection made;
    auto command = duplicate (graphAsShown(), canvas.patch(), canvas.scene(), canvas.selection(), made);
    if (command && performBeside (*std::move (command), made)) canvas.select (made);
}

/// If settings name files by relative paths, the text says from which folder, so that another program that pastes it finds them.
void CanvasCommands::copySelection() const
{
    if (canvas.selection().empty()) return;
    auto graph = fragmentOf (graphAsShown(), canvas.patch(), canvas.selection());
    std::error_code failed;
    const auto folder = std::filesystem::absolute (graph.folder, failed);
    if (! graph.folder.empty() && writeGraph (carriedTo (folder.root_path(), graph, no_files).graph) != writeGraph (graph))
        graph.extra["ui"] = Json { { "folder", folder.string() } };
    copyToClipboard (writeGraph (graph));
}

/// The graph in the clipboard, with the paths of its files as this graph has to say them. Says why there is none.
std::optional<graph::Graph> CanvasCommands::copied() const
{
    auto read = readCopied (textFromClipboard());
    if (! read)
    {
        canvas.notice (filled (TRANS ("Nothing to paste: %1"), fromUtf8 (read.error().text)));
        return std::nullopt;
    }
    const auto ui = read->extra.find ("ui");
    if (ui == read->extra.end() || ! ui->is_object()) return std::move (*read);
    const auto folder = ui->find ("folder");
    if (folder == ui->end() || ! folder->is_string() || ! std::filesystem::path (folder->asString()).is_absolute()) return std::move (*read);
    read->folder = folder->asString();
    auto made = carriedTo (document.graph().folder, *read, no_files).graph;
    made.folder = document.graph().folder;
    return made;
}

void CanvasCommands::pasteText()
{
    auto graph = copied();
    if (! graph) return;
    juce::Point<double> offset { 32.0, 32.0 };   // next to the original
    if (const auto corner = cornerOf (graph->root); corner && canvas.isMouseOver())
    {
        const auto at = (pointerOrCentre() / Box::grid).roundToInt().toDouble() * static_cast<double> (Box::grid);
        offset = at - *corner;
    }
    const auto isMotor = [] (const graph::Node& n) { return n.type == "device.force" || n.type == "device.effort" || n.type == "device.signal_out"; };
    const bool brings_motor = std::ranges::any_of (graph->root.nodes, isMotor) && std::ranges::any_of (document.graph().root.nodes, isMotor);
    Selection made;
    auto command = paste (document.graph(), canvas.patch(), *std::move (graph), offset, made);
    if (! command)
        return canvas.notice (filled (TRANS ("Nothing to paste: %1"), fromUtf8 (command.error().text)));
    if (made.empty() || ! performBeside (*std::move (command), made)) return;
    canvas.select (made);
    if (brings_motor) canvas.notice (TRANS ("Pasted with a motor of its own. Ctrl+Shift+V pastes a whole effect as a node and a layer of the mixer instead."));
}

void CanvasCommands::pasteLayer()
{
    if (auto graph = copied(); graph && canvas.onLayerPasted) canvas.onLayerPasted (*graph);
}

void CanvasCommands::bypassSelection() { perform (toggleBypass (document.graph(), canvas.patch(), canvas.selection())); }

void CanvasCommands::groupSelection()
{
    auto command = group (document.graph(), canvas.patch(), canvas.selection());
    if (! command) return;
    const auto name = std::get<graph::CollapseNodes> (command->edit).name;
    juce::Rectangle<float> all;
    for (const auto* n : selectedNodes())
        all = all.isEmpty() ? n->bounds() : all.getUnion (n->bounds());
    auto then = graphWithPlaces();
    graph::Batch batch { NEEDS_TRANS ("group"), { *command } };
    if (graph::apply (then, *command))
    {
        const auto scene = canvas.sceneOf (then);
        const SceneNode* made = nullptr;
        std::vector<juce::Rectangle<float>> others;
        for (const auto& n : scene->nodes())
            n.name == name ? void (made = &n) : others.push_back (n.bounds());
        if (made != nullptr)   // where they were
            batch.commands.push_back (
                placeNodes (then, canvas.patch(), { { made->id, clearPlace (made->bounds().withCentre (all.getCentre()), others) } }));
    }
    if (! perform (std::move (batch))) return;
    const auto& nodes = canvas.scene().nodes();
    if (const auto made = std::ranges::find (nodes, name, &SceneNode::name); made != nodes.end())
    {
        canvas.select ({ made->id });
        canvas.bringIntoView (made->bounds());
    }
}

void CanvasCommands::expandSelection()
{
    const auto nodes = selectedNodes();
    if (nodes.empty()) return;
    const graph::Command command = graph::ExpandNode { canvas.patch(), nodes[0]->name };
    graph::Batch batch { NEEDS_TRANS ("ungroup"), { command } };
    Selection made;
    juce::Rectangle<float> all;
    auto then = graphWithPlaces();
    if (graph::apply (then, command))
    {
        const auto scene = canvas.sceneOf (then);
        std::vector<juce::Rectangle<float>> others;
        for (const auto& n : scene->nodes())
            if (canvas.scene().find (n.id) != nullptr)
                others.push_back (n.bounds());
            else
            {
                made.insert (n.id);
                all = all.isEmpty() ? n.bounds() : all.getUnion (n.bounds());
            }
        const auto to = clearPlace (all.withCentre (nodes[0]->bounds().getCentre()), others);   // where the subgraph was
        const auto by = to - all.getPosition();
        batch.commands.push_back (moved (then, canvas.patch(), movedParts (then, canvas.patch(), *scene, made), by));
        all += by;
    }
    Selection before, added;
    for (const auto& n : canvas.scene().nodes())
        before.insert (n.id);
    if (! perform (std::move (batch))) return;
    for (const auto& n : canvas.scene().nodes())   // those of a subgraph that others use are copies, which have ids of their own
        if (! before.contains (n.id)) added.insert (n.id);
    canvas.select (added);
    canvas.bringIntoView (all);
}

void CanvasCommands::alignSelection (Alignment how)
{
    const auto nodes = selectedNodes();
    std::vector<juce::Rectangle<float>> boxes;
    for (const auto* n : nodes)
        boxes.push_back (n->bounds());
    boxes = aligned (std::move (boxes), how);
    std::vector<std::pair<graph::Id, juce::Point<float>>> places;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        places.emplace_back (nodes[i]->id, boxes[i].getPosition());
    auto command = placeNodes (document.graph(), canvas.patch(), places);
    std::get<graph::Batch> (command.edit).name = NEEDS_TRANS ("align");
    perform (std::move (command));
}

void CanvasCommands::arrangeAll()
{
    std::vector<juce::Point<float>> sizes;
    std::vector<std::pair<int, int>> wires;
    for (const auto& n : canvas.scene().nodes())
        sizes.emplace_back (n.box.width, n.box.height);
    for (const auto& w : canvas.scene().wires())
        if (w.delay == 0) wires.emplace_back (w.start, w.end);
    const auto places = arrange (sizes, wires);
    std::vector<std::pair<graph::Id, juce::Point<float>>> to;
    for (std::size_t i = 0; i < places.size(); ++i)
        to.emplace_back (canvas.scene().nodes()[i].id, places[i]);
    auto command = placeNodes (document.graph(), canvas.patch(), to);
    auto& all = std::get<graph::Batch> (command.edit);
    all.name = NEEDS_TRANS ("arrange");
    for (const auto& w : canvas.scene().wires())   // they were made for other places
        if (w.has_bends) all.commands.push_back (bendWire (document.graph(), canvas.patch(), w.id, {}));
    perform (std::move (command));
    canvas.frameAll();
    canvas.endEdit();
}

void CanvasCommands::nudgeSelection (juce::Point<float> by)
{
    if (const auto bend = canvas.highlighted().bend) return nudgeBend (*bend, by);
    auto all = moved (document.graph(), canvas.patch(), movedParts (document.graph(), canvas.patch(), canvas.scene(), canvas.selection()), by);
    if (std::ranges::any_of (canvas.selection(), isNote))
    {
        auto notes = canvas.scene().notes();
        for (std::size_t i = 0; i < notes.size(); ++i)
            if (canvas.selection().contains (noteId (i))) notes[i].area += by;
        all.commands.push_back (setNotes (document.graph(), canvas.patch(), notes, NEEDS_TRANS ("move")));
    }
    perform (std::move (all));
}

void CanvasCommands::delaySelection (int ticks)
{
    graph::Batch all { ticks > 0 ? NEEDS_TRANS ("increase delay") : NEEDS_TRANS ("decrease delay"), {} };
    for (const auto& w : patchShown().wires)
        if (canvas.selection().contains (w.id) && w.delay + ticks >= 0)
        {
            auto to = w;
            to.delay += ticks;
            all.commands.push_back (graph::ChangeWire { canvas.patch(), w.id, std::move (to) });
        }
    if (! all.commands.empty()) perform (std::move (all));
}

void CanvasCommands::toggleWires()
{
    bool any_on = false;
    for (const auto& w : patchShown().wires)
        any_on = any_on || (canvas.selection().contains (w.id) && w.enabled.value_or (true));
    graph::Batch all { any_on ? NEEDS_TRANS ("switch wires off") : NEEDS_TRANS ("switch wires on"), {} };
    for (const auto& w : patchShown().wires)
        if (canvas.selection().contains (w.id) && w.enabled.value_or (true) == any_on)
        {
            auto to = w;
            to.enabled = any_on ? std::optional (false) : std::nullopt;
            all.commands.push_back (graph::ChangeWire { canvas.patch(), w.id, std::move (to) });
        }
    if (! all.commands.empty()) perform (std::move (all));
}

void CanvasCommands::addNote()
{
    juce::Rectangle<float> around;
    for (const auto* n : selectedNodes())
        around = around.isEmpty() ? n->bounds() : around.getUnion (n->bounds());
    constexpr float margin = 3 * Box::grid, width = 200.0f, height = 56.0f;
    auto notes = canvas.scene().notes();
    if (around.isEmpty())
        notes.push_back ({ juce::Rectangle<float> (width, height).withPosition (freePlace (canvas.scene(), pointerOrCentre())), {}, {} });
    else
    {
        const auto area = around.expanded (margin).withTop (around.getY() - margin - Box::header_height);
        notes.push_back ({ area, {}, std::string (note_colours[notes.size() % std::size (note_colours)]) });
    }
    perform (setNotes (document.graph(), canvas.patch(), notes, NEEDS_TRANS ("add note")));
    canvas.select ({ noteId (notes.size() - 1) });
    editNote (notes.size() - 1);
}

void CanvasCommands::recolourNotes()
{
    auto notes = canvas.scene().notes();
    for (std::size_t i = 0; i < notes.size(); ++i)
        if (canvas.selection().contains (noteId (i)))
        {
            const auto* next = notes[i].isRegion() ? std::ranges::find (note_colours, notes[i].colour) + 1 : std::begin (note_colours);
            notes[i].colour = next == std::end (note_colours) ? std::string() : std::string (*next);
        }
    perform (setNotes (document.graph(), canvas.patch(), notes, NEEDS_TRANS ("colour region")));
}

void CanvasCommands::editNote (std::size_t i)
{
    if (i >= canvas.scene().notes().size()) return;
    const auto& note = canvas.scene().notes()[i];
    const auto area = note.isRegion() ? note.area.withHeight (Box::header_height) : note.area;
    const auto typed = std::make_shared<TypedStep> (document);
    const auto kind = note.isRegion() ? TextOverlay::Kind::title : TextOverlay::Kind::lines;
    canvas.openEditor (area, juce::String::fromUTF8 (note.text.c_str()), kind, [this, i, typed] (const juce::String& text) {
        auto notes = canvas.scene().notes();
        if (i >= notes.size() || notes[i].text == text.toStdString()) return true;
        notes[i].text = text.toStdString();
        const auto command = setNotes (document.graph(), canvas.patch(), notes, NEEDS_TRANS ("edit note"));
        return typed->perform ([&] (graph::Step step) { return perform (command, step); });
    });
}

void CanvasCommands::renameSelection()
{
    const auto nodes = selectedNodes();
    for (std::size_t i = 0; nodes.empty() && i < canvas.scene().notes().size(); ++i)
        if (canvas.selection().contains (noteId (i))) return editNote (i);
    if (nodes.size() != 1) return;
    const auto done = [this, id = nodes[0]->id] (const juce::String& text) {
        const auto* node = canvas.scene().find (id);
        const auto name = asNodeName (text);
        return node == nullptr || name == node->name || perform (graph::RenameNode { canvas.patch(), node->name, name });
    };
    canvas.openEditor (nodes[0]->bounds().withHeight (Box::header_height), juce::String (nodes[0]->name), TextOverlay::Kind::value, done);
}

bool CanvasCommands::setParam (const SceneNode& shown_node, const FacePort& port, const std::optional<Json>& value, graph::Step step)
{
    const auto* node = patchShown().find (shown_node.name);
    if (node == nullptr) return false;
    if (auto command = changeParam (document.graph(), canvas.seen(), *node, port, value)) return perform (std::move (*command), step);
    canvas.notice (juce::String (outOfRangeText (document.graph(), canvas.seen(), *node, port)));
    return false;
}

void CanvasCommands::editParam (const SceneNode& node, const Socket& socket)
{
    const auto* sheet = socket.port->sheet;
    if (sheet == nullptr || socket.port->isChoice()) return;
    if (! socket.driver.empty()) return canvas.notice (drivenText (socket.driver));
    const PortId id { node.id, Role::param, socket.port->id };
    const juce::String before (socket.value);
    const auto apply = [this, id, before] (const juce::String& text) {
        const auto param = canvas.scene().findPort (id);
        if (text == before || ! param || param.port->sheet == nullptr) return true;   // what is shown may be rounded
        const auto value = readTyped (text.trim().toStdString(), before.toStdString(), *param.port);
        if (! value)
        {
            canvas.notice (juce::String (param.node->name + '.' + id.port + ": ") + fromUtf8 (value.error().text));
            return false;
        }
        return setParam (*param.node, *param.port, *value);
    };
    const auto area = socket.row.translated (node.at.x, node.at.y);
    canvas.openEditor (area, before, TextOverlay::Kind::value, apply, [this, id] (int step) { editParamBeside (id, step); });
}

/// Edits the next param of the node that can be typed, or with a step of -1 the previous one.
void CanvasCommands::editParamBeside (const PortId& id, int step)
{
    const auto* node = canvas.scene().find (id.node);
    if (node == nullptr) return;
    std::vector<const Socket*> params;
    for (const auto& s : node->box.sockets)
        if (s.port->role == Role::param && s.port->sheet != nullptr && ! s.port->isChoice() && s.driver.empty()) params.push_back (&s);
    const auto here = std::ranges::find (params, id.port, [] (const Socket* s) { return s->port->id; });
    if (here == params.end()) return;
    const auto count = std::ssize (params), next = (here - params.begin() + step + count) % count;
    editParam (*node, *params[static_cast<std::size_t> (next)]);
}

}   // namespace tactus::host
