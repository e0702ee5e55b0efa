// SPDX-License-Identifier: GPL-3.0-or-later
#include "step_text.hpp"
#include "face.hpp"
#include "patch.hpp"
#include "quantity_text.hpp"
#include "readable.hpp"

#include <host/app/text/filled.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/text/list_text.hpp>

#include <algorithm>
#include <cstdio>
#include <optional>

namespace tactus::host
{

namespace
{
constexpr auto value_arrow = " -> ";

/// A value as a field shows it, in two parts: the number, and the unit.
struct ShownValue
{
    std::string number, unit;

    std::string text() const { return unit.empty() ? number : number + ' ' + unit; }
};

/// Empty if the value is not a number.
std::optional<ShownValue> shownValue (const Json& value, const PortSheet& sheet)
{
    if (! sheet.choices.empty()) return value.is_string() ? std::optional (ShownValue { value.get<std::string>(), {} }) : std::nullopt;
    const auto read = readQuantity (value, sheet);
    if (! read) return {};
    auto shown = withBestPrefix (*read, sheet);
    shown.number = rounded (shown.number);
    const bool has_unit = sheet.unit.kind == UnitRule::Kind::fixed && sheet.unit.unit.symbol != "1";
    const auto unit = shown.unit.empty() && has_unit ? unitShown (std::string (sheet.unit.unit.symbol)) : unitShown (shown.unit);
    return ShownValue { QuantityText { shown.number, {}, 1.0 }.toText(), unit };
}

std::string changeText (const std::string& what, const ShownValue& before, const ShownValue& after)
{
    return what + ' ' + (before.unit == after.unit ? before.number : before.text()) + value_arrow + after.text();
}

/// The entry in which two values differ: the values themselves, or one entry of two lists. Nothing if more than one entry differs.
struct Difference
{
    Json before, after;
    std::string index;
};

std::optional<Difference> differenceOf (const Json& before, const Json& after, double initial)
{
    if (! before.is_array() && ! after.is_array()) return Difference { before, after, {} };
    std::optional<Difference> found;
    const auto at = [initial] (const Json& list, std::size_t i) { return list.is_array() && i < list.size() ? Json (list[i]) : Json (initial); };
    for (std::size_t i = 0; i < std::max (before.is_array() ? before.size() : 0, after.is_array() ? after.size() : 0); ++i)
    {
        const auto b = at (before, i), a = at (after, i);
        if (b == a) continue;
        if (found) return {};
        found = Difference { b, a, '[' + std::to_string (i) + ']' };
    }
    return found;
}

/// The graph that a command opens, or brings back. Null if it does neither.
const graph::Graph* openedBy (const graph::Command& command)
{
    if (const auto* replaces = std::get_if<graph::ReplaceGraph> (&command.edit)) return replaces->to.get();
    const auto* batch = std::get_if<graph::Batch> (&command.edit);
    return batch != nullptr && batch->commands.size() == 1 ? openedBy (batch->commands.front()) : nullptr;
}

/// The graph that a step edits: another one may have been opened since, or before a step that has been undone.
const graph::Graph& graphOf (const graph::History& history, std::size_t step)
{
    const auto done = history.position();
    if (step < done)
        for (auto later = step + 1; later < done; ++later)
            for (const auto& c : history.inversesOf (later))
                if (const auto* before = openedBy (c)) return *before;
    for (auto earlier = step; earlier-- > done;)
        for (const auto& c : history.commandsOf (earlier))
            if (const auto* opened = openedBy (c)) return *opened;
    return history.graph();
}

/// A param for people: "Gain of Big drum" for an entry of a node that names its channels, "Gain[3]" for another one.
std::string paramText (const graph::Node& node, const std::string& param, const std::string& index)
{
    const auto names = node.settings.find ("names");
    if (index.empty() || names == node.settings.end() || ! names->is_string()) return readable (param) + index;
    const auto name = juce::StringArray::fromTokens (juce::String::fromUTF8 (names->asString().c_str()), ",", {})[std::stoi (index.substr (1))].trim();
    return name.isEmpty() ? readable (param) + index : filled (TRANS ("%1 of %2"), readable (param), name).toStdString();
}

std::optional<std::string> textOf (const graph::SetParam& back, const graph::SetParam& to, const graph::Graph& g, const Catalogue& catalogue)
{
    if (back.patch != to.patch || back.node != to.node || back.param != to.param) return {};
    const auto* patch = findPatch (g, to.patch);
    const auto* node = patch == nullptr ? nullptr : patch->find (to.node);
    if (node == nullptr) return {};
    const auto face = faceOf (g, *patch, *node, catalogue);
    const auto at = std::ranges::find_if (face.params, [&] (const FacePort& p) { return p.id == to.param || p.id.starts_with (to.param + '['); });
    if (at == face.params.end() || at->sheet == nullptr) return {};
    const double initial = at->sheet->initial[0];
    const Json otherwise = at->isChoice() ? Json (std::string (at->sheet->choices[static_cast<std::size_t> (initial)])) : Json (initial);
    const auto change = differenceOf (back.value.value_or (otherwise), to.value.value_or (otherwise), initial);
    const auto before = change ? shownValue (change->before, *at->sheet) : std::nullopt;
    const auto after = change ? shownValue (change->after, *at->sheet) : std::nullopt;
    if (! before || ! after) return {};
    return changeText (to.node + ": " + paramText (*node, to.param, change->index), *before, *after);
}

std::optional<std::string> textOf (const graph::ChangeControl& back, const graph::ChangeControl& to)
{
    if (back.control != to.control || back.to.value == to.to.value || back.to.to.size() != to.to.to.size()) return {};
    char text[48];
    std::snprintf (text, sizeof text, " %.2f%s%.2f", back.to.value, value_arrow, to.to.value);
    return (to.to.name.empty() ? to.control : to.to.name) + text;
}

std::optional<std::string> textOf (const graph::SetHeader& back, const graph::SetHeader& to)
{
    if (to.name && back.name) return TRANS ("rename the graph").toStdString() + ": " + *back.name + value_arrow + *to.name;
    if (to.about) return TRANS ("describe the graph").toStdString();
    if (to.tags) return TRANS ("change the tags").toStdString();
    if (to.rate_hz && back.rate_hz)
        return TRANS ("change the rate").toStdString() + ": " + shownQuantity (*back.rate_hz, "Hz") + value_arrow + shownQuantity (*to.rate_hz, "Hz");
    return {};
}

std::string textOf (const graph::CollapseNodes& to)
{
    std::string text = TRANS ("group").toStdString();
    if (to.nodes.size() > 3) return text + ' ' + std::to_string (to.nodes.size()) + ' ' + TRANS ("nodes").toStdString();
    for (std::size_t i = 0; i < to.nodes.size(); ++i)
        text += (i == 0 ? " " : ", ") + to.nodes[i];
    return text;
}

/// The canvas stores where it shows the nodes together with the first edit, and the document keeps what `ui` stores by the names of nodes
/// together with an edit of names. That is not what the step is about: returns the edit alone.
const graph::Command& withoutPlaces (const graph::Command& command)
{
    const auto* batch = std::get_if<graph::Batch> (&command.edit);
    if (batch == nullptr || batch->commands.size() != 2) return command;
    for (const std::size_t places : { 0U, 1U })   // or after it, with where a new node goes
    {
        const auto* moves = std::get_if<graph::Batch> (&batch->commands[places].edit);
        const bool is_keep = std::holds_alternative<graph::SetHeader> (batch->commands[places].edit);
        if (is_keep || (moves != nullptr && moves->name != batch->name && moves->name.starts_with ("move node")))
            return withoutPlaces (batch->commands[1 - places]);
    }
    return command;
}

/// Empty if the step is more than a change of one value.
std::optional<std::string> textOf (const graph::History& history, std::size_t step, const Catalogue& catalogue)
{
    const auto commands = history.commandsOf (step), inverses = history.inversesOf (step);
    if (commands.empty() || inverses.empty()) return {};
    const auto& first = withoutPlaces (commands.front()).edit;
    const auto* last = &commands.front();
    for (const auto& c : commands)
        if (! onlyMoves (c)) last = &c;   // what an edit moves aside is not what it is about
    if (std::ranges::any_of (commands, [&] (const graph::Command& c) { return ! onlyMoves (c) && withoutPlaces (c).edit.index() != first.index(); })) return {};
    const auto &back = withoutPlaces (inverses.front()).edit, &to = withoutPlaces (*last).edit;
    if (const auto* a = std::get_if<graph::SetParam> (&back), *b = std::get_if<graph::SetParam> (&to); a != nullptr && b != nullptr)
        return textOf (*a, *b, graphOf (history, step), catalogue);
    if (const auto* a = std::get_if<graph::ChangeControl> (&back), *b = std::get_if<graph::ChangeControl> (&to); a != nullptr && b != nullptr)
        return textOf (*a, *b);
    if (const auto* a = std::get_if<graph::SetHeader> (&back), *b = std::get_if<graph::SetHeader> (&to); a != nullptr && b != nullptr) return textOf (*a, *b);
    if (const auto* groups = std::get_if<graph::CollapseNodes> (&to); groups != nullptr && commands.size() == 1) return textOf (*groups);
    return {};
}

/// The objects of a step: the nodes and wires that its commands name. If there are more than a name can list, the first ones and the last one.
struct Objects
{
    static constexpr std::size_t most = 3;

    std::vector<std::string> nodes, wires, new_wires;

    static void add (std::vector<std::string>& to, const std::string& what)
    {
        if (std::ranges::count (to, what) > 0) return;
        if (to.size() > most) to.pop_back();
        to.push_back (what);
    }

    void collect (const graph::Command& command)
    {
        if (const auto* batch = std::get_if<graph::Batch> (&command.edit))
        {
            if (const auto& edit = withoutPlaces (command); &edit != &command) return collect (edit);
            for (const auto& c : batch->commands)
                collect (c);
        }
        else if (const auto* added = std::get_if<graph::AddNode> (&command.edit))
            add (nodes, added->node.name);
        else if (const auto* removed = std::get_if<graph::RemoveNode> (&command.edit))
            add (nodes, removed->name);
        else if (const auto* renamed = std::get_if<graph::RenameNode> (&command.edit))
            add (nodes, renamed->name);
        else if (const auto* changed = std::get_if<graph::SetNodeKey> (&command.edit))
            add (nodes, changed->node);
        else if (const auto* wired = std::get_if<graph::AddWire> (&command.edit))
            for (auto* to : { &wires, &new_wires })
                add (*to, graph::toText (wired->wire));
        else if (const auto* rewired = std::get_if<graph::ChangeWire> (&command.edit))
            add (wires, graph::toText (rewired->to));
    }
};

/// "a, b, c", and "..." if there are more.
std::string briefList (const std::vector<std::string>& objects)
{
    std::string text;
    for (std::size_t i = 0; i < std::min (objects.size(), Objects::most); ++i)
        addToList (text, objects[i]);
    return objects.size() > Objects::most ? text + ", ..." : text;
}

/// The name of a step of the canvas with what it was done to: "delete drag". New wires are their own name, with those that they replace.
std::string withObjects (const std::string& name, const graph::History& history, std::size_t step)
{
    Objects done, undone;
    const bool is_move = std::ranges::all_of (history.commandsOf (step), onlyMoves);
    for (const auto& c : history.commandsOf (step))
        if (is_move || ! onlyMoves (c)) done.collect (c);
    for (const auto& c : history.inversesOf (step))
        if (is_move || ! onlyMoves (c)) undone.collect (c);
    const bool connects = name == "connect" && ! done.wires.empty();
    const bool is_of_wires = connects || (done.nodes.empty() && ! done.wires.empty());
    const auto& wires = done.wires.empty() ? undone.wires : done.wires;
    auto objects = done.nodes.empty() || connects ? wires : done.nodes;
    auto text = connects ? std::string() : juce::translate (valueText (name)).toStdString();
    std::erase_if (objects, [&name] (const std::string& o) { return name.find (o) != std::string::npos; });
    if (connects || (! objects.empty() && objects.size() <= Objects::most)) text += (connects ? "" : " ") + briefList (objects);
    std::erase_if (undone.new_wires, [&] (const std::string& wire) { return std::ranges::count (done.wires, wire) > 0; });
    return is_of_wires && ! undone.new_wires.empty() ? filled (TRANS ("%1 in place of %2"), text, briefList (undone.new_wires)).toStdString() : text;
}

/// Collects what commands change, by patch.
struct PartsByPatch
{
    std::map<std::string, StepParts>& parts;
    std::set<std::string>& notes;   ///< of the root, as texts: more than one if they change

    void operator() (const graph::AddNode& c) const { parts[c.patch].nodes.insert (c.node.name); }
    void operator() (const graph::RemoveNode& c) const { parts[c.patch].nodes.insert (c.name); }
    void operator() (const graph::ExpandNode& c) const { parts[c.patch].nodes.insert (c.name); }
    void operator() (const graph::RenameNode& c) const { parts[c.patch].nodes.insert ({ c.name, c.to }); }
    void operator() (const graph::CollapseNodes& c) const { parts[c.patch].nodes.insert (c.name); }
    void operator() (const graph::AddWire& c) const { parts[c.patch].wires.insert (c.wire.id); }
    void operator() (const graph::Batch& c) const
    {
        for (const auto& command : c.commands)
            std::visit (*this, withoutPlaces (command).edit);
    }

    /// The header of the root stores more than its notes, such as snapshots, which no patch shows.
    void operator() (const graph::SetHeader& c) const
    {
        if (! c.patch.empty())
            parts[c.patch];
        else if (c.ui)
            notes.insert (c.ui->is_object() ? c.ui->value ("notes", Json()).dump() : Json().dump());
    }

    template <typename Other>
    void operator() (const Other& c) const
    {
        if constexpr (requires { parts[c.patch].nodes.insert (c.node); })
            parts[c.patch].nodes.insert (c.node);
        else if constexpr (requires { parts[c.patch].wires.insert (c.wire); })
            parts[c.patch].wires.insert (c.wire);
        else if constexpr (requires { parts[c.patch]; })
            parts[c.patch];
    }
};
}   // namespace

bool onlyMoves (const graph::Command& c)
{
    if (const auto* key = std::get_if<graph::SetNodeKey> (&c.edit)) return key->key == "ui";
    const auto* batch = std::get_if<graph::Batch> (&c.edit);
    return batch != nullptr && std::ranges::all_of (batch->commands, onlyMoves);
}

std::map<std::string, StepParts> partsOf (const graph::History& history, std::size_t step)
{
    std::map<std::string, StepParts> parts;
    std::set<std::string> notes;
    for (const auto& all : { history.commandsOf (step), history.inversesOf (step) })
        for (const auto& c : all)
            std::visit (PartsByPatch { parts, notes }, withoutPlaces (c).edit);
    if (notes.size() > 1) parts[""];
    return parts;
}

std::string stepName (const graph::History& history, std::size_t step, const Catalogue& catalogue)
{
    auto change = textOf (history, step, catalogue);
    return change ? *std::move (change) : withObjects (history.stepName (step), history, step);
}

}   // namespace tactus::host
