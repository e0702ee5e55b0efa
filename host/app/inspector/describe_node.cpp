// SPDX-License-Identifier: GPL-3.0-or-later
#include "describe.hpp"
#include "header.hpp"

#include <framework/graph/text.hpp>
#include <host/app/model/node_doc.hpp>

#include <cmath>

namespace tactus::host
{

namespace
{
juce::String text (std::string_view s) { return juce::String::fromUTF8 (std::string (s).c_str()); }

const graph::Node* find (const Inspected& at, const std::string& name)
{
    const auto* in = at.in();
    return in == nullptr ? nullptr : in->find (name);
}

Slot settingSlot (const Inspected& at, const std::string& name, const std::string& id)
{
    return { [at, name, id]
             {
                 const auto* n = find (at, name);
                 return n != nullptr && n->settings.contains (id) ? Json (n->settings.at (id)) : Json();
             },
             [&document = at.document, patch = at.patch, name, id] (std::optional<Json> value, bool goes_on)
             { document.perform (graph::SetSetting { patch, name, id, std::move (value) }, goes_on ? graph::Step::joined : graph::Step::own); } };
}

/// A key of a node that holds a whole number.
Slot keySlot (const Inspected& at, const std::string& name, const std::string& key)
{
    return { [at, name, key]
             {
                 const auto* n = find (at, name);
                 return n != nullptr && n->extra.contains (key) ? Json (n->extra.at (key)) : Json();
             },
             [&document = at.document, patch = at.patch, name, key] (std::optional<Json> value, bool goes_on)
             {
                 if (value && value->is_number()) value = Json (static_cast<std::int64_t> (std::llround (value->get<double>())));
                 document.perform (graph::SetNodeKey { patch, name, key, std::move (value) }, goes_on ? graph::Step::joined : graph::Step::own);
             } };
}

/// What is wrong with a node, or to be said of it.
Remark complaints (const Inspected& at, const std::string& name)
{
    Remark r;
    if (! at.messages || ! at.patch.empty()) return r;
    const auto place = "/nodes/" + name;
    for (const auto& m : at.messages())
    {
        if (! m.where.starts_with (place) || (m.where.size() > place.size() && m.where[place.size()] != '/')) continue;
        r.text << (r.text.isEmpty() ? "" : "\n") << text (m.text) << (m.remedy.empty() ? juce::String() : "; " + text (m.remedy));
        r.is_wrong = true;
    }
    return r;
}

void explain (const std::vector<FacePort>& ports, const char* title, Column& column)
{
    if (ports.empty()) return;
    column.add (title, Words::Kind::heading);
    for (const auto& p : ports)
    {
        const auto unit = p.unit.kind == UnitRule::Kind::fixed ? std::string (p.unit.unit.symbol) : std::string ("as wired");
        column.add (text (p.id + (unit == "1" ? "" : ", " + unit) + (p.width == 3 ? ", vector" : "")), Words::Kind::text);
        column.add (text (p.about), Words::Kind::small);
    }
}

void describeSubgraphNode (const Inspected& at, const graph::Node& node, Column& column)
{
    column.add ("Runs", Words::Kind::heading);
    const auto whole = [&] (const char* key, const char* about, double most)
    { column.add (numberRow (key, sheetOfNumber (key, unit::count, about, { .hard = { 1, most }, .usual = { 1, 16 } }, 1.0), keySlot (at, node.name, key), at.refused)); };
    whole ("count", "instances, counted from 0", 1e6);
    whole ("every", "it runs on one tick in so many", 1e6);
    whole ("times", "it runs so many times in each tick, where nothing returns to the hand", 1e6);

    column.add ("Inside, set from here", Words::Kind::heading);
    const auto set = [&document = at.document, patch = at.patch, name = node.name] (const std::string& path, const juce::String& t)
    {
        const auto written = t.trim().toStdString();
        auto value = Json::parse (written, nullptr, false);
        if (value.is_discarded()) value = Json (written);
        document.perform (graph::SetOverride { patch, name, path, written.empty() ? std::nullopt : std::optional (std::move (value)) });
    };
    for (const auto& [path, value] : node.overrides.items())
        column.add (textRow (
            text (path), [at, name = node.name, path = path]
            {
            const auto* n = find (at, name);
            if (n == nullptr || ! n->overrides.contains (path)) return juce::String();
            const auto& v = n->overrides.at (path);
            return text (v.is_string() ? v.get<std::string>() : v.dump()); },
            [set, path = path] (const juce::String& t)
            { set (path, t); },
            "Of this node alone; empty: what the subgraph says"));
    column.add (textRow (
        "another", []
        { return juce::String(); },
        [set, refused = at.refused] (const juce::String& t)
        {
        if (t.trim().isEmpty()) return;
        if (! t.contains ("=")) return refused ("Write which and what: drag.mu = 0.4, or [3]/drag.mu = 0.4 of one instance");
        set (t.upToFirstOccurrenceOf ("=", false, false).trim().toStdString(), t.fromFirstOccurrenceOf ("=", false, false)); },
        "A parameter inside, for this node alone: drag.mu = 0.4, or [3]/drag.mu = 0.4 of one instance"));
}
}   // namespace

std::string shapeOf (const Inspected& at, const graph::Node& node)
{
    std::string shape = node.name + '|' + node.type + '|' + node.role;
    if (const auto inputs = node.settings.find ("inputs"); inputs != node.settings.end()) shape += inputs->dump();
    for (const auto& [role, description] : at.document.graph().devices)
        if (node.type.starts_with ("device."))
        {
            shape += '|' + role;
            if (role != node.role) continue;
            const auto flat = description.flatten();
            for (const auto& [path, value] : flat.items())
                shape += path;
        }
    for (const auto& [path, value] : node.overrides.items())
        shape += '|' + path;
    if (const auto* inside = node.type.starts_with ("graph:") ? at.document.graph().find (node.type.substr (6)) : nullptr)
        for (const auto& [name, end] : inside->expose.params)
            shape += name + '=' + graph::toText (end);
    return shape;
}

void describeNode (const Inspected& at, const graph::Node& node, bool help, const std::function<void()>& toggleHelp, Column& column)
{
    const auto face = faceOf (at.document.graph(), *at.in(), node, at.catalogue);
    column.add (nodeHeader (at, node, help, toggleHelp));
    if (face.type != nullptr) column.add (text (face.type->info.summary), Words::Kind::text);
    if (face.kind == Face::Kind::placeholder) column.add ("There is no such type here. The node keeps what it has and gives 0.", Words::Kind::text);
    if (face.kind == Face::Kind::subgraph) column.add ("A subgraph: double click it on the canvas to enter.", Words::Kind::text);
    column.add (remark ([at, name = node.name]
                        { return complaints (at, name); }));
    if (help)
    {
        explain (face.inputs, "Inputs", column);
        explain (face.params, "Parameters", column);
        explain (face.outputs, "Outputs", column);
    }

    if (! face.params.empty()) column.add (help ? "Their values" : "Parameters", Words::Kind::heading);
    for (const auto& p : face.params)
        if (p.sheet != nullptr) column.add (paramRow (at.document, at.patch, node.name, p, at.refused));
    if (face.kind == Face::Kind::subgraph) describeSubgraphNode (at, node, column);
    if (node.type.starts_with ("device.")) describeDevice (at, node, column);
    if (face.type == nullptr) return;
    if (! face.type->settings.empty()) column.add ("Settings", Words::Kind::heading);
    for (const auto& s : face.type->settings)
        column.add (settingEditor (s, settingSlot (at, node.name, std::string (s.id)), at.editors));
    if (const auto law = lawOf (node.type); ! law.empty())
    {
        column.add ("Law", Words::Kind::heading);
        for (const auto& line : law)
            column.add (juce::String::fromUTF8 (line.c_str()), Words::Kind::small);
    }
    column.add ("Source", Words::Kind::heading);
    column.add (text (face.type->info.source), Words::Kind::small);
}

}   // namespace tactus::host
