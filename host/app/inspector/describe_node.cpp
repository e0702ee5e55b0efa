// SPDX-License-Identifier: GPL-3.0-or-later
#include "describe.hpp"

#include <host/app/inspector/blocks/formula_block.hpp>
#include <host/app/inspector/blocks/limit_block.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/look/glyph.hpp>
#include <host/app/look/tool_button.hpp>
#include <host/app/model/fragment.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/model/node_doc.hpp>
#include <host/app/model/quantity_text.hpp>
#include <host/app/model/readable.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/node/claims_passive.hpp>

#include <cmath>
#include <span>

namespace tactus::host
{

namespace
{
/// The header of a node: icon, editable name, type, and buttons for bypass and help.
class NodeHeader final : public Block
{
public:
    NodeHeader (const InspectorContext& at, const graph::Node& node, bool help_shown, std::function<void()> toggleHelp) : type (node.type)
    {
        auto& document = at.document;
        name.setFont (lookOf (*this).font (15.0f, true));
        name.setTitle (TRANS ("Name of the node"));
        name.setTooltip (TRANS ("Node name: lower-case letters, digits and _"));
        name.onApply = [&document, patch = at.patch, before = node.name, this] (const juce::String& to) {
            if (! document.perform (graph::RenameNode { patch, before, asNodeName (to) })) name.refuse();
        };
        bypass.onClick = [&document, patch = at.patch, n = node.name, this] {
            const auto value = bypass.getToggleState() ? std::nullopt : std::optional<Json> (true);
            document.perform (graph::SetNodeKey { patch, n, "bypass", value });
        };
        help.setToggleState (help_shown, juce::dontSendNotification);
        help.onClick = std::move (toggleHelp);
        addAndMakeVisible (name);
        addAndMakeVisible (bypass);
        addAndMakeVisible (help);
        bypass.setColour ([] (const Theme& t) { return t.warning; });
        NodeHeader::refresh (&node);
    }

    int heightFor (int) override { return 60; }

    void refresh (const graph::Node* node) override
    {
        if (node == nullptr) return;
        name.show (node->name);
        bypass.setToggleState (node->bypass, juce::dontSendNotification);
    }

    void paint (juce::Graphics& g) override
    {
        const auto& look = lookOf (*this);
        const auto cut = type.find_first_of (".:");
        auto glyph = glyphOf (type.starts_with ("file:") ? "graph" : type.substr (0, cut));
        glyph.applyTransform (juce::AffineTransform::translation (2.0f, 9.0f));
        g.setColour (look.theme().dim);
        g.strokePath (glyph, juce::PathStrokeType (1.5f, juce::PathStrokeType::curved, juce::PathStrokeType::rounded));
        g.setFont (look.font (12.0f));
        g.drawText (type, getLocalBounds().removeFromTop (56).removeFromBottom (22), juce::Justification::centredLeft, true);
    }

    void resized() override
    {
        auto top = getLocalBounds().removeFromTop (32).reduced (0, 2);
        help.setBounds (top.removeFromRight (28));
        top.removeFromRight (4);
        bypass.setBounds (top.removeFromRight (60));
        top.removeFromRight (4);
        name.setBounds (top.withTrimmedLeft (24));
    }

private:
    std::string type;
    TextField name;
    ToolButton bypass { TRANS ("bypass"), ToolButton::Kind::toggle, TRANS ("Pass the input through unchanged") };
    ToolButton help { "?", ToolButton::Kind::toggle, TRANS ("Describe all ports") };
};

/// Binds a setting or another key of a node; Edit is SetSetting or SetNodeKey.
template <typename Edit, typename Values>
Binding bindingOf (const InspectorContext& at, const std::string& name, const std::string& key, Values graph::Node::*values)
{
    const auto get = [at, name, key, values] {
        const auto* n = at.node (name);
        return n != nullptr && (n->*values).contains (key) ? Json ((n->*values).at (key)) : Json();
    };
    const auto set = [&document = at.document, patch = at.patch, name, key] (std::optional<Json> value, bool continues) {
        const auto step = continues ? graph::Step::joined : graph::Step::own;
        document.perform (Edit { patch, name, key, std::move (value) }, step);
    };
    return { get, set };
}

/// The messages about a node.
Remark problemsOf (const InspectorContext& at, const std::string& name)
{
    Remark r;
    if (! at.messages || ! at.patch.empty()) return r;
    const auto place = "/nodes/" + name;
    for (const auto& m : at.messages())
    {
        if (! m.where.starts_with (place) || (m.where.size() > place.size() && m.where[place.size()] != '/')) continue;
        r.text << (r.text.isEmpty() ? "" : "\n") << messageText (m);
        r.is_problem = true;
    }
    return r;
}

void listPorts (const std::vector<FacePort>& ports, const juce::String& title, Column& column)
{
    if (ports.empty()) return;
    column.add (title, TextBlock::Kind::heading);
    for (const auto& p : ports)
    {
        const auto unit = p.unit.kind == UnitRule::Kind::fixed ? unitShown (std::string (p.unit.unit.symbol)) : TRANS ("any unit").toStdString();
        column.add (fromUtf8 (readableName (p) + (unit == "1" ? "" : ", " + unit)) + (p.width == 3 ? ", " + TRANS ("vector") : juce::String()),
                    TextBlock::Kind::text);
        column.add (fromUtf8 (p.about), TextBlock::Kind::small);
    }
}

void describeSubgraphNode (const InspectorContext& at, const graph::Node& node, Column& column)
{
    column.add (TRANS ("Instances and rate"), TextBlock::Kind::heading);
    column.add (TRANS ("count: how many copies of the subgraph run side by side, such as one per finger or thread. every: they run only on every n-th tick, "
                       "for slow parts that cost much. times: they run n times per tick, for sounds that are faster than the rate."),
                TextBlock::Kind::small);
    const auto addInteger = [&] (const char* key, const juce::String& about) {
        const auto sheet = sheetOfNumber (key, unit::count, lasting (about), { .hard = { 1, 1e6 }, .usual = { 1, 16 } }, 1.0);
        column.add (numberRow (key, sheet, bindingOf<graph::SetNodeKey> (at, node.name, key, &graph::Node::extra).asInteger(), at.refused));
    };
    addInteger ("count", TRANS ("number of instances, numbered from 0"));
    addInteger ("every", TRANS ("the node runs on every n-th tick"));
    addInteger ("times", TRANS ("the node runs n times per tick; allowed only without feedback to the hand"));

    column.add (TRANS ("Overrides"), TextBlock::Kind::heading);
    column.add (TRANS ("An override gives a parameter inside the subgraph another value, for this node only; other nodes with the same subgraph keep theirs. "
                       "[3]/drag.mu is the parameter of one instance."),
                TextBlock::Kind::small);
    const auto set = [&document = at.document, patch = at.patch, name = node.name] (const std::string& path, const juce::String& t) {
        auto value = t.trim().isEmpty() ? std::nullopt : std::optional (parseText (t));
        document.perform (graph::SetOverride { patch, name, path, std::move (value) });
    };
    for (const auto& [path, value] : node.overrides.items())
        column.add (textRow (
            fromUtf8 (path), [at, name = node.name, path = path] {
            const auto* n = at.node (name);
            return n == nullptr || ! n->overrides.contains (path) ? juce::String() : editText (n->overrides.at (path)); },
            [set, path = path] (const juce::String& t) { set (path, t); },
            TRANS ("For this node only. Leave empty to use the subgraph's value.")));
    column.add (textRow (
        TRANS ("add override"), [] { return juce::String(); },
        [set, refused = at.refused] (const juce::String& t) {
        if (t.trim().isEmpty()) return;
        if (! t.contains ("=")) return refused (TRANS ("Write a parameter and a value: drag.mu = 0.4, or [3]/drag.mu = 0.4 for one instance"));
        set (t.upToFirstOccurrenceOf ("=", false, false).trim().toStdString(), t.fromFirstOccurrenceOf ("=", false, false)); },
        TRANS ("Overrides a parameter inside the subgraph, for this node only: drag.mu = 0.4, or [3]/drag.mu = 0.4 for one instance")));
}
}   // namespace

std::string shapeOf (const InspectorContext& at, const graph::Node& node)
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

void describeNode (const InspectorContext& at, const graph::Node& node, bool help, const std::function<void()>& toggleHelp, Column& column)
{
    const auto face = faceOf (at.document.graph(), *at.in(), node, at.catalogue);
    column.add (std::make_unique<NodeHeader> (at, node, help, toggleHelp));
    if (face.type != nullptr) column.add (fromUtf8 (face.type->info.summary), TextBlock::Kind::text);
    if (face.type != nullptr && claimsPassive (*face.type))
        column.add (TRANS ("Passive with its default parameters: it generates no energy over any closed path."), TextBlock::Kind::small);
    if (face.kind == Face::Kind::placeholder)
        column.add (TRANS ("Unknown node type. The node keeps its parameters and wires. A graph with it does not start."), TextBlock::Kind::text);
    if (face.kind == Face::Kind::subgraph) column.add (TRANS ("A subgraph. Double-click it on the canvas to enter."), TextBlock::Kind::text);
    if (help)
    {
        listPorts (face.inputs, TRANS ("Inputs"), column);
        listPorts (face.params, TRANS ("Parameters"), column);
        listPorts (face.outputs, TRANS ("Outputs"), column);
    }

    if (! face.params.empty()) column.add (help ? TRANS ("Parameter values") : TRANS ("Parameters"), TextBlock::Kind::heading);
    for (const auto& p : face.params)
    {
        if (p.sheet == nullptr) continue;
        auto fillMenu = [fill = at.menuOfParam, n = node.name, id = p.id] (auto& menu) {
            if (fill) fill (menu, n, id);
        };
        column.add (paramRow (at.document, at.catalogue, { at.patch, at.path }, node.name, p, at.refused, at.live, std::move (fillMenu)));
    }
    if (face.kind == Face::Kind::subgraph) describeSubgraphNode (at, node, column);
    if (node.type.starts_with ("device.")) describeDevice (at, node, column);
    const auto settings = face.type != nullptr ? std::span<const SettingSheet> (face.type->settings) : std::span<const SettingSheet> {};
    if (! settings.empty()) column.add (TRANS ("Settings"), TextBlock::Kind::heading);
    for (const auto& s : settings)
        column.add (settingEditor (s, bindingOf<graph::SetSetting> (at, node.name, std::string (s.id), &graph::Node::settings), at.editors));
    // Below what can be changed: these come a moment later, and nothing moves under the pointer.
    column.add (remark ([at, name = node.name] { return problemsOf (at, name); }));
    if (at.contacts && at.patch.empty())
        column.add (std::make_unique<LimitBlock> ([contacts = at.contacts, name = node.name] { return contacts (name); }));
    if (face.type == nullptr) return;
    if (const auto law = lawOf (node.type); ! law.empty())
    {
        column.add (TRANS ("Law"), TextBlock::Kind::heading);
        column.add (std::make_unique<FormulaBlock> (law));
    }
    column.add (TRANS ("Source"), TextBlock::Kind::heading);
    column.add (fromUtf8 (face.type->info.source), TextBlock::Kind::small);
}

}   // namespace tactus::host
