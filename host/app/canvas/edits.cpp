// SPDX-License-Identifier: GPL-3.0-or-later
// What a canvas does to what is selected: its part of the commands.
#include "arrange.hpp"
#include "canvas.hpp"

#include <framework/graph/endpoints.hpp>
#include <framework/graph/text.hpp>
#include <framework/turn.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/model/clipboard.hpp>
#include <host/app/model/fragment.hpp>
#include <host/app/model/param_now.hpp>
#include <host/app/model/quantity_text.hpp>
#include <host/app/model/wire_rules.hpp>

#include <array>

namespace tactus::host
{

const graph::Patch& Canvas::patchShown() const
{
    const auto& g = document.graph();
    const auto* in = entered.empty() ? &g.root : g.find (entered.back().second);
    return in == nullptr ? g.root : *in;
}

std::optional<graph::Command> Canvas::settle() const
{
    std::vector<std::pair<graph::Id, juce::Point<float>>> places;
    for (const auto& n : patchShown().nodes)
        if (const auto* node = shown->find (n.id); node != nullptr && ! placeOf (n)) places.emplace_back (n.id, node->at);
    if (places.empty()) return std::nullopt;
    return placeNodes (document.graph(), patch(), places);
}

bool Canvas::perform (graph::Command command, graph::Step step)
{
    auto settled = settle();
    if (! settled) return document.perform (std::move (command), step);
    auto name = graph::nameOf (command);
    graph::Batch all { std::move (name), {} };
    all.commands.push_back (std::move (*settled));
    all.commands.push_back (std::move (command));
    return document.perform (std::move (all), step);
}

graph::Graph Canvas::placedGraph() const
{
    auto placed = document.graph();
    if (const auto settled = settle()) graph::apply (placed, *settled);
    return placed;
}

void Canvas::removeSelection()
{
    if (highlights.selected.empty()) return;
    graph::Batch all { "delete", {} };
    if (std::ranges::any_of (highlights.selected, isNote))
    {
        std::vector<Note> left;
        for (std::size_t i = 0; i < shown->notes().size(); ++i)
            if (! highlights.selected.contains (noteId (i))) left.push_back (shown->notes()[i]);
        all.commands.push_back (setNotes (document.graph(), patch(), left, "delete"));
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
    double right = 32.0, down = 32.0;   // beside what it was copied from
    if (const auto corner = cornerOf (text); corner && isMouseOver())
    {
        const auto at = (pointerOrCentre() / Box::grid).roundToInt().toDouble() * static_cast<double> (Box::grid);
        right = at.x - corner->first;
        down = at.y - corner->second;
    }
    Selection made;
    auto command = paste (document.graph(), patch(), text, right, down, made);
    if (const auto* problem = std::get_if<Message> (&command))
        notice ("Nothing to paste: " + juce::String (problem->text));
    else if (! made.empty() && perform (std::get<graph::Command> (std::move (command))))
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
    for (const auto& n : shown->nodes())
        if (highlights.selected.contains (n.id))
        {
            perform (graph::ExpandNode { patch(), n.name });
            return;
        }
}

void Canvas::enterSelection()
{
    for (const auto& n : shown->nodes())
        if (highlights.selected.contains (n.id)) return enter (n);
}

void Canvas::alignSelection (Alignment how)
{
    std::vector<graph::Id> ids;
    std::vector<juce::Rectangle<float>> boxes;
    for (const auto& n : shown->nodes())
        if (highlights.selected.contains (n.id))
        {
            ids.push_back (n.id);
            boxes.push_back (n.bounds());
        }
    boxes = aligned (std::move (boxes), how);
    std::vector<std::pair<graph::Id, juce::Point<float>>> places;
    for (std::size_t i = 0; i < ids.size(); ++i)
        places.emplace_back (ids[i], boxes[i].getPosition());
    auto command = placeNodes (document.graph(), patch(), places);
    std::get<graph::Batch> (command.edit).name = "align";
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
    std::get<graph::Batch> (command.edit).name = "arrange";
    perform (std::move (command));
    frameAll();
}

void Canvas::nudgeSelection (juce::Point<float> by)
{
    graph::Batch all { "move", {} };
    std::vector<std::pair<graph::Id, juce::Point<float>>> places;
    for (const auto& n : shown->nodes())
        if (highlights.selected.contains (n.id)) places.emplace_back (n.id, n.at + by);
    all.commands.push_back (placeNodes (document.graph(), patch(), places));
    if (std::ranges::any_of (highlights.selected, isNote))
    {
        auto notes = shown->notes();
        for (std::size_t i = 0; i < notes.size(); ++i)
            if (highlights.selected.contains (noteId (i))) notes[i].area += by;
        all.commands.push_back (setNotes (document.graph(), patch(), notes, "move"));
    }
    perform (std::move (all));
}

void Canvas::delaySelection (int ticks)
{
    graph::Batch all { ticks > 0 ? "delay" : "less delay", {} };
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
    graph::Batch all { any_on ? "switch off" : "switch on", {} };
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
    for (const auto& n : shown->nodes())
        if (highlights.selected.contains (n.id)) around = around.isEmpty() ? n.bounds() : around.getUnion (n.bounds());
    constexpr float margin = 3 * Box::grid, width = 200.0f, height = 56.0f;
    auto notes = shown->notes();
    if (around.isEmpty())
        notes.push_back ({ juce::Rectangle<float> (width, height).withPosition (freePlace (pointerOrCentre())), {}, {} });
    else
        notes.push_back ({ around.expanded (margin).withTop (around.getY() - margin - Box::header_height), {}, std::string (note_colours[notes.size() % std::size (note_colours)]) });
    perform (setNotes (document.graph(), patch(), notes, "add a note"));
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
    perform (setNotes (document.graph(), patch(), notes, "colour a note"));
}

void Canvas::editNote (std::size_t i)
{
    if (i >= shown->notes().size()) return;
    const auto& note = shown->notes()[i];
    const auto area = note.isRegion() ? note.area.withHeight (Box::header_height) : note.area;
    type (area, juce::String::fromUTF8 (note.text.c_str()), ! note.isRegion(), [this, i] (const juce::String& text)
          {
        auto notes = shown->notes();
        if (i >= notes.size()) return;
        notes[i].text = text.toStdString();
        perform (setNotes (document.graph(), patch(), notes, "write a note")); });
}

void Canvas::setParam (const SceneNode& shown_node, const FacePort& port, const std::optional<Json>& value, graph::Step step)
{
    const auto* node = patchShown().find (shown_node.name);
    if (node == nullptr) return;
    if (auto command = changeParam (document.graph(), patch(), *node, port, value))
        perform (std::move (*command), step);
    else
        notice (juce::String (beyondReach (document.graph(), *node, port)));
}

void Canvas::editParam (const SceneNode& node, const Socket& socket)
{
    const auto* sheet = socket.port->sheet;
    if (sheet == nullptr || socket.port->width != 1 || socket.port->isChoice()) return;
    type (socket.row.translated (node.at.x, node.at.y), socket.value, false, [this, id = node.id, port = socket.port->id] (const juce::String& text)
          {
        const auto* now = shown->find (id);
        const auto* p = now == nullptr ? nullptr : now->face->find (Role::param, port);
        if (p == nullptr || p->sheet == nullptr) return;
        const auto read = readQuantity (readValue (text.trim().toStdString()), *p->sheet);
        if (const auto* problem = std::get_if<std::string> (&read)) return notice (juce::String (now->name + '.' + p->id + ": " + *problem));
        setParam (*now, *p, std::get<QuantityText> (read).toJson()); });
}

void Canvas::type (juce::Rectangle<float> area, const juce::String& text, bool several_lines, std::function<void (const juce::String&)> typed)
{
    endTyping (true);
    on_typed = std::move (typed);
    typing = std::make_unique<juce::TextEditor>();
    typing->setMultiLine (several_lines);
    typing->setReturnKeyStartsNewLine (false);
    typing->setFont (lookOf (*this).font (13.0f));
    typing->setText (text, false);
    const auto box = juce::Rectangle<float> (window.toPixels (area.getTopLeft()), window.toPixels (area.getBottomRight())).toNearestInt();
    typing->setBounds (box.withWidth (std::max (120, box.getWidth())).withHeight (std::max (24, box.getHeight())));
    typing->onReturnKey = typing->onFocusLost = [this]
    { endTyping (true); };
    typing->onEscapeKey = [this]
    { endTyping (false); };
    addAndMakeVisible (*typing);
    takeFocus (*typing);
    typing->selectAll();
}

void Canvas::endTyping (bool keep)
{
    const std::shared_ptr<juce::TextEditor> ended = std::move (typing);
    if (! ended) return;
    ended->onFocusLost = nullptr;
    removeChildComponent (ended.get());
    juce::MessageManager::callAsync ([ended] {});   // only after the event that ends it, which may be its own
    const auto typed = std::exchange (on_typed, nullptr);
    if (keep) typed (ended->getText());
}

void Canvas::probeSelection()
{
    std::vector<std::string> ports;
    for (const auto& w : patchShown().wires)
        if (highlights.selected.contains (w.id)) ports.push_back (address (graph::toText (w.from)));
    for (const auto& n : shown->nodes())
        if (highlights.selected.contains (n.id) && ! n.face->outputs.empty()) ports.push_back (address (n.name + '.' + n.face->outputs.front().id));
    if (! ports.empty() && onProbe) onProbe (std::move (ports));
}

void Canvas::wireFromSelection()
{
    const SceneNode* from = nullptr;
    for (const auto& n : shown->nodes())
        if (highlights.selected.contains (n.id)) from = &n;
    if (from == nullptr || ! onChoose) return;

    struct Way
    {
        graph::Id to;
        std::string out, in;
    };
    auto ways = std::make_shared<std::vector<Way>>();
    std::vector<PaletteEntry> entries;
    for (const auto& out : from->face->outputs)
        for (const auto& n : shown->nodes())
            for (const auto* ports : { &n.face->inputs, &n.face->params })
                for (const auto& in : *ports)
                {
                    if (n.id == from->id || whyNot ({ &out, from->quantityOf (out) }, { &in, n.quantityOf (in) })) continue;
                    entries.push_back ({ from->name + '.' + out.id + " -> " + n.name + '.' + in.id, {}, in.about });
                    ways->push_back ({ n.id, out.id, in.id });
                }
    const auto texts = std::make_shared<std::vector<PaletteEntry>> (entries);
    onChoose ("Wire from " + juce::String (from->name), std::move (entries), [this, id = from->id, ways, texts] (const std::string& chosen)
              {
        const auto place = std::ranges::find (*texts, chosen, &PaletteEntry::type);
        if (place == texts->end()) return;
        const auto& way = (*ways)[static_cast<std::size_t> (place - texts->begin())];
        const auto *a = shown->find (id), *b = shown->find (way.to);
        if (a == nullptr || b == nullptr) return;
        const auto* out = a->face->find (Role::output, way.out);
        const auto* in = b->face->find (Role::input, way.in);
        if (in == nullptr) in = b->face->find (Role::param, way.in);
        if (out != nullptr && in != nullptr) join (*a, *out, *b, *in); });
}

void Canvas::exposeFromSelection()
{
    const SceneNode* node = nullptr;
    for (const auto& n : shown->nodes())
        if (highlights.selected.contains (n.id)) node = &n;
    if (node == nullptr || entered.empty() || ! onChoose) return;
    std::vector<PaletteEntry> entries;
    for (const auto* ports : { &node->face->inputs, &node->face->params, &node->face->outputs })
        for (const auto& p : *ports)
            entries.push_back ({ node->name + '.' + p.id, {}, p.about });
    onChoose ("Show outside, or hide", std::move (entries), [this, id = node->id] (const std::string& chosen)
              {
        const auto* now = shown->find (id);
        if (now == nullptr || entered.empty()) return;
        for (const auto* ports : { &now->face->inputs, &now->face->params, &now->face->outputs })
            for (const auto& p : *ports)
                if (now->name + '.' + p.id == chosen)
                {
                    perform (toggleExposed (document.graph(), patch(), now->name, p));
                    return;
                } });
}

juce::Point<float> Canvas::freePlace (juce::Point<float> at) const
{
    const juce::Point<float> usual_size { 160.0f, 96.0f };
    const auto isTaken = [&]
    {
        const juce::Rectangle<float> box { at, at + usual_size };
        return std::ranges::any_of (shown->nodes(), [&] (const SceneNode& n)
                                    { return n.bounds().intersects (box); })
               || std::ranges::any_of (shown->notes(), [&] (const Note& n)
                                       { return ! n.isRegion() && n.area.intersects (box); });
    };
    while (isTaken())
        at.y += 2 * Box::grid;
    return at;
}

void Canvas::addNodeAt (const std::string& type, const NodeWish& wish)
{
    graph::Id made = 0;
    if (! perform (addNode (document.graph(), patch(), type, wish.wire != 0 ? wish.at : freePlace (wish.at), made))) return;
    select ({ made });
    if (wish.wire != 0)
    {
        if (auto command = insertInto (document.graph(), patch(), *shown, wish.wire, made)) perform (std::move (*command), graph::Step::joined);
        return;
    }
    const auto *node = shown->find (made), *other = wish.start ? shown->find (wish.start->node) : nullptr;
    const auto* port = other == nullptr ? nullptr : other->face->find (wish.start->role, wish.start->port);
    if (port == nullptr || node == nullptr) return;

    const WireEnd there { port, other->quantityOf (*port) };
    const auto& ports = wish.start->role == Role::output ? node->face->inputs : node->face->outputs;
    for (const auto& p : ports)
    {
        const WireEnd here { &p, node->quantityOf (p) };
        if (wish.start->role == Role::output ? whyNot (there, here) : whyNot (here, there)) continue;
        perform (wish.start->role == Role::output ? connect (document.graph(), patch(), *other, *port, *node, p) : connect (document.graph(), patch(), *node, p, *other, *port), graph::Step::joined);
        return;
    }
}

void Canvas::join (const SceneNode& from, const FacePort& out, const SceneNode& to, const FacePort& in)
{
    if (out.width == in.width)
    {
        perform (connect (document.graph(), patch(), from, out, to, in));
        return;
    }
    if (! onChoose) return;
    const bool of_output = out.width == 3;
    const auto vector = of_output ? from.name + '.' + out.id : to.name + '.' + in.id;
    constexpr std::array axes { ".x", ".y", ".z" };
    std::vector<PaletteEntry> entries;
    for (const auto* axis : axes)
        entries.push_back ({ vector + axis, {}, of_output ? "This component goes out" : "This component takes it in; the others stay as they are" });
    onChoose ("Which component?", entries, [this, a = from.id, b = to.id, out_id = out.id, in_role = in.role, in_id = in.id, entries, of_output] (const std::string& chosen)
              {
        const auto component = static_cast<int> (std::ranges::find (entries, chosen, &PaletteEntry::type) - entries.begin());
        const auto *start = shown->find (a), *end = shown->find (b);
        const auto* o = start == nullptr ? nullptr : start->face->find (Role::output, out_id);
        const auto* i = end == nullptr ? nullptr : end->face->find (in_role, in_id);
        if (component < 3 && o != nullptr && i != nullptr) perform (connect (document.graph(), patch(), *start, *o, *end, *i, of_output ? component : -1, of_output ? -1 : component)); });
}

}   // namespace tactus::host
