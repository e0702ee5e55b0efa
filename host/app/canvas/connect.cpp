// SPDX-License-Identifier: GPL-3.0-or-later
// The canvas commands that add nodes and connect ports.
#include "canvas.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/model/fragment.hpp>
#include <host/app/model/obvious_wires.hpp>
#include <host/app/model/wire_rules.hpp>
#include <host/app/text/filled.hpp>
#include <host/app/text/find.hpp>

#include <algorithm>
#include <array>

namespace tactus::host
{

namespace
{
/// The entry for a new node behind an output: "friction.elasto_plastic (resistance)".
constexpr const char* before_port = " (";

/// The words of a query without those that name this output or say "new".
struct OutputQuery
{
    juce::StringArray words;
    bool names_it = false;

    OutputQuery (const std::string& query, const std::string& port)
    {
        for (const auto& word : juce::StringArray::fromTokens (fromUtf8 (query), " .", {}))
        {
            if (word.isEmpty() || word.equalsIgnoreCase (TRANS ("new"))) continue;
            if (fromUtf8 (port).equalsIgnoreCase (word))
                names_it = true;
            else
                words.add (word);
        }
    }
};

/// The entries that fit the query, without guesses. With `summaries`, these are searched, too.
std::vector<PaletteEntry> exactly (const std::vector<PaletteEntry>& entries, const std::string& query, bool summaries)
{
    std::vector<Findable> searched;
    for (const auto& e : entries)
        searched.push_back ({ {}, e.type, {}, summaries ? e.summary : std::string() });
    std::vector<PaletteEntry> found;
    for (const auto i : bestMatches (searched, query, false))
        found.push_back (entries[i]);
    return found;
}

void addOthers (std::vector<PaletteEntry>& all, std::vector<PaletteEntry> more)
{
    for (auto& e : more)
        if (std::ranges::count (all, e.type, &PaletteEntry::type) == 0) all.push_back (std::move (e));
}
}   // namespace

/// The new nodes that a query finds behind the outputs of a node, the best of each output first.
std::vector<PaletteEntry> CanvasCommands::newBehind (graph::Id id, const std::string& query) const
{
    const auto* from = canvas.scene().find (id);
    if (from == nullptr) return {};
    std::vector<std::vector<PaletteEntry>> columns;
    std::size_t most = 0;
    const bool is_named = std::ranges::any_of (from->face->outputs, [&] (const FacePort& out) { return OutputQuery (query, out.id).names_it; });
    for (const auto& out : from->face->outputs)
    {
        const OutputQuery asked (query, out.id);
        if (asked.words.isEmpty() || asked.names_it != is_named) continue;
        const std::vector<WireEnd> ends { { &out, from->quantityOf (out) } };
        auto& column = columns.emplace_back (
            searchPalette (asked.words.joinIntoString (" ").toStdString(), document.graph(), canvas.types(), ends, {}, canvas.patch()));
        for (auto& e : column)
        {
            e.name = from->name + '.' + out.id + " -> " + filled (TRANS ("new %1"), e.name).toStdString();
            e.type += before_port + out.id + ')';
        }
        most = std::max (most, column.size());
    }
    std::vector<PaletteEntry> all;
    for (std::size_t i = 0; i < most; ++i)
        for (auto& column : columns)
            if (i < column.size()) all.push_back (std::move (column[i]));
    return all;
}

void CanvasCommands::wireFromSelection()
{
    const auto nodes = selectedNodes();
    if (nodes.empty() || ! canvas.onChoose) return;
    const auto& from = *nodes.back();
    std::vector<std::pair<PortId, PortId>> wires;
    std::vector<PaletteEntry> entries;
    const auto list = [&] (const FacePort& out, bool whole) {   // else, one component of a vector
        for (const auto& n : canvas.scene().nodes())
            for (const auto* ports : { &n.face->inputs, &n.face->params })
                for (const auto& in : *ports)
                {
                    if (n.id == from.id || (out.width == in.width) != whole) continue;
                    if (! checkWireByComponent ({ &out, from.quantityOf (out) }, { &in, n.quantityOf (in) })) continue;
                    entries.push_back ({ from.name + '.' + out.id + " -> " + n.name + '.' + in.id, {}, in.about });
                    wires.push_back ({ { from.id, Role::output, out.id }, { n.id, in.role, in.id } });
                }
    };
    for (const bool whole : { true, false })
        for (const auto& out : from.face->outputs)
            list (out, whole);
    for (const auto& out : from.face->outputs)
    {
        entries.push_back ({ from.name + '.' + out.id + " -> " + TRANS ("new node").toStdString(), {}, TRANS ("Adds a node that fits.").toStdString() });
        wires.push_back ({ { from.id, Role::output, out.id }, {} });
    }
    // First the wires to what is there, by name; then new nodes; then wires whose description fits; and only then, guesses.
    const auto search = [this, entries, id = from.id] (const std::string& query) {
        if (fromUtf8 (query).trim().isEmpty()) return entries;
        auto found = exactly (entries, query, false);
        addOthers (found, newBehind (id, query));
        addOthers (found, exactly (entries, query, true));
        return found.empty() ? matching (entries, query) : found;
    };
    const auto beside = from.bounds().getTopRight().translated (3 * Box::grid, 0.0f);
    canvas.onChoose (filled (TRANS ("Connect %1 to..."), from.name), search, [this, wires, entries, beside, id = from.id] (const std::string& chosen) {
        const auto entry = std::ranges::find (entries, chosen, &PaletteEntry::type);
        if (entry == entries.end())
        {
            const auto end = chosen.rfind (before_port);
            if (end == chosen.npos) return;
            const auto port = chosen.substr (end + std::string_view (before_port).size());
            return addNodeAt (chosen.substr (0, end), { beside, PortId { id, Role::output, port.substr (0, port.size() - 1) } });
        }
        const auto& [out, in] = wires[static_cast<std::size_t> (entry - entries.begin())];
        if (in.node == 0) return requestNode ({ beside, out });
        const auto a = canvas.scene().findPort (out), b = canvas.scene().findPort (in);
        if (a && b) join (a, b);
    });
}

void CanvasCommands::exposeFromSelection()
{
    const auto nodes = selectedNodes();
    if (nodes.empty() || canvas.breadcrumbs().empty() || ! canvas.onChoose) return;
    const auto& node = *nodes.back();
    std::vector<PaletteEntry> entries;
    std::vector<PortId> ports;
    for (const auto role : { Role::input, Role::param, Role::output })
        for (const auto& p : node.face->of (role))
        {
            entries.push_back ({ node.name + '.' + p.id, {}, p.about });
            ports.push_back ({ node.id, role, p.id });
        }
    canvas.onChoose (TRANS ("Expose or hide port"), searchIn (entries), [this, entries, ports] (const std::string& chosen) {
        const auto entry = std::ranges::find (entries, chosen, &PaletteEntry::type);
        if (entry == entries.end() || canvas.breadcrumbs().empty()) return;
        const auto found = canvas.scene().findPort (ports[static_cast<std::size_t> (entry - entries.begin())]);
        if (found) perform (toggleExposed (document.graph(), canvas.patch(), found.node->name, *found.port));
    });
}

/// Wires run from left to right, so what is not wired yet gets into a row, as far as the view shows it: a hand at the left.
juce::Point<float> CanvasCommands::placeFor (const std::string& type, const NodeRequest& request) const
{
    if (request.wire != 0) return request.at;
    const auto below = freePlace (canvas.scene(), request.at);
    if (request.start) return below;
    const auto beside = placeInRow (canvas.scene(), request.at, type == "device.position");
    return canvas.isFitted() || canvas.getLocalBounds().toFloat().contains (canvas.view().toPixels (beside)) ? beside : below;
}

void CanvasCommands::addNodeAt (const std::string& type, const NodeRequest& request)
{
    graph::Id made = 0;
    const auto at = placeFor (type, request);
    if (! perform (addNode (document.graph(), canvas.patch(), type, at, made))) return;
    canvas.show (canvas.patch(), made);
    canvas.endEdit();   // undoing the edit brings back the view from before
    if (request.wire != 0)
    {
        if (auto command = insertInto (document.graph(), canvas.patch(), canvas.scene(), request.wire, made))
            perform (std::move (*command), graph::Step::joined);
        return;
    }
    const auto* node = canvas.scene().find (made);
    const auto other = request.start ? canvas.scene().findPort (*request.start) : ScenePort {};
    if (! other || node == nullptr) return;

    const bool is_output = other.port->role == Role::output;
    for (const auto& p : is_output ? node->face->inputs : node->face->outputs)
    {
        const ScenePort own { node, &p };
        const auto &from = is_output ? other : own, &to = is_output ? own : other;
        if (! checkWire (from.end(), to.end())) continue;
        const bool has_more = is_output && (other.port->id == "position" || other.port->id == "resistance");
        const auto name = node->name;
        perform (connect (document.graph(), canvas.patch(), { *from.node, *from.port }, { *to.node, *to.port }), graph::Step::joined);
        if (has_more)
            if (auto wires = wiring::obviousWires (document.graph(), canvas.patch(), name, canvas.types()); ! wires.commands.empty())
                perform (std::move (wires), graph::Step::joined);
        return;
    }
}

/// One step, also if it moves a wire. Where nothing would change, no step.
void CanvasCommands::connectInPlaceOf (graph::Id replaced, const Plug& from, const Plug& to)
{
    if (replaced == 0)
    {
        perform (connect (document.graph(), canvas.patch(), from, to));
        return;
    }
    const graph::RemoveWire removal { canvas.patch(), replaced };
    auto without = document.graph();
    const auto back = graph::apply (without, removal);
    const auto* was = back ? std::get_if<graph::AddWire> (&back->edit) : nullptr;
    if (was == nullptr) return;
    auto command = connect (without, canvas.patch(), from, to);
    auto& commands = std::get<graph::Batch> (command.edit).commands;
    const auto& now = std::get<graph::AddWire> (commands.back().edit).wire;
    if (commands.size() == 1 && now.from == was->wire.from && now.to == was->wire.to) return;
    commands.insert (commands.begin(), removal);
    perform (graph::Batch { NEEDS_TRANS ("re-plug wire"), std::move (commands) });
}

void CanvasCommands::join (const ScenePort& from, const ScenePort& to, graph::Id replaced)
{
    if (from.port->width == to.port->width) return connectInPlaceOf (replaced, { *from.node, *from.port }, { *to.node, *to.port });
    if (! canvas.onChoose) return;
    const bool of_output = from.port->width == 3;
    const auto& vector = of_output ? from : to;
    constexpr std::array axes { ".x", ".y", ".z" };
    std::vector<PaletteEntry> entries;
    for (const auto* axis : axes)
        entries.push_back ({ vector.node->name + '.' + vector.port->id + axis,
                             {},
                             (of_output ? TRANS ("Send this component") : TRANS ("Feed this component")).toStdString() });
    const PortId out { from.node->id, Role::output, from.port->id }, in { to.node->id, to.port->role, to.port->id };
    canvas.onChoose (TRANS ("Which component?"), searchIn (entries), [this, out, in, entries, of_output, replaced] (const std::string& chosen) {
        const auto component = static_cast<int> (std::ranges::find (entries, chosen, &PaletteEntry::type) - entries.begin());
        const auto a = canvas.scene().findPort (out), b = canvas.scene().findPort (in);
        if (component >= 3 || ! a || ! b) return;
        const int of_a = of_output ? component : -1, of_b = of_output ? -1 : component;
        connectInPlaceOf (replaced, { *a.node, *a.port, of_a }, { *b.node, *b.port, of_b });
    });
}

}   // namespace tactus::host
