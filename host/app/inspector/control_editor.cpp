// SPDX-License-Identifier: GPL-3.0-or-later
#include "control_value.hpp"
#include "rows.hpp"

#include <host/app/inspector/blocks/fields.hpp>
#include <host/app/inspector/blocks/table_row.hpp>
#include <host/app/inspector/settings/setting_editor.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/look/tool_button.hpp>
#include <host/app/model/param_now.hpp>
#include <host/app/model/value_in_effect.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/endpoints.hpp>
#include <tactus/graph/inside.hpp>
#include <tactus/plan/values.hpp>

#include <algorithm>
#include <set>

namespace tactus::host
{

namespace
{
const graph::Control* find (const Document& d, const std::string& id)
{
    const auto at = std::ranges::find (d.graph().controls, id, &graph::Control::id);
    return at == d.graph().controls.end() ? nullptr : &*at;
}

void change (Document& d, const std::string& id, const std::function<void (graph::Control&)>& f, graph::Step step = graph::Step::own)
{
    const auto* now = find (d, id);
    if (now == nullptr) return;
    auto to = *now;
    f (to);
    d.perform (graph::ChangeControl { id, std::move (to) }, step);
}

/// The control's name, value and delete button.
class Header final : public Block
{
public:
    Header (Document& d, const Catalogue& c, std::string i, const Refusal& refused) : document (d), catalogue (c), id (std::move (i))
    {
        getProperties().set (shown_control, fromUtf8 (id));
        name.setTitle (TRANS ("Name of the control"));
        name.setTooltip (TRANS ("The name of the control"));
        name.onApply = [this] (const juce::String& text) { change (document, id, [to = text.trim().toStdString()] (auto& c) { c.name = to; }); };
        value.read = readControl;
        value.onRefused = refused;
        value.onChange = [this] (const std::optional<Json>& to, bool continues) {
            if (! to) return;   // a control has no default
            change (
                document, id, [v = siOf (*to, controlSheet())] (auto& c) { c.value = v; },
                continues ? graph::Step::joined : graph::Step::own);
        };
        cross.onClick = [this] { document.perform (removeControl (document.graph(), id, catalogue)); };
        addAndMakeVisible (name);
        addAndMakeVisible (value);
        addAndMakeVisible (cross);
    }

    int heightFor (int) override { return 28; }

    void refresh (const graph::Node*) override
    {
        const auto* c = find (document, id);
        if (c == nullptr) return;
        name.show (fromUtf8 (c->name.empty() ? c->id : c->name));
        value.setTitle (fromUtf8 (c->name.empty() ? c->id : c->name));
        const auto drivers = driversOf (document.graph(), *c);
        value.setDriver (isOverridden (document.graph(), *c) ? drivers.front() : std::string());
        value.show (Json (c->value));
        const auto overridden = overriddenText (document.graph(), *c);
        value.setTooltip (tooltipOf (controlSheet()) + (overridden.isEmpty() ? "" : "\n" + overridden));
    }

    void resized() override
    {
        auto area = getLocalBounds().reduced (0, 2);
        cross.setBounds (area.removeFromRight (24));
        name.setBounds (area.removeFromLeft (getWidth() * 2 / 5).withTrimmedRight (4));
        value.setBounds (area);
    }

private:
    Document& document;
    const Catalogue& catalogue;
    std::string id;
    TextField name;
    NumberField value { controlSheet() };
    ToolButton cross { juce::String::fromUTF8 ("\xc3\x97"), ToolButton::Kind::plain,
                       TRANS ("Delete this control. Its parameters keep the values that it sets.") };
};

class ControlEditor final : public Stack
{
public:
    ControlEditor (Document& d, const Catalogue& c, std::string i, Refusal r)
        : document (d), catalogue (c), id (std::move (i)), refused (std::move (r))
    {
    }

protected:
    std::string shape() const override
    {
        std::string all;
        if (const auto* c = find (document, id))
            for (const auto& t : c->to)
                all += t.path + '|';
        if (const auto* c = find (document, id))
            for (const auto& driver : driversOf (document.graph(), *c))
                all += driver + '|';
        return all;
    }

    void fill() override
    {
        add (std::make_unique<Header> (document, catalogue, id, refused));
        const auto* c = find (document, id);
        if (c == nullptr) return;
        if (c->to.empty()) add (TRANS ("No targets yet. Right-click a parameter to add one."), TextBlock::Kind::small);
        const auto drivers = driversOf (document.graph(), *c);
        for (std::size_t i = 0; i < c->to.size(); ++i)
        {
            const auto path = c->to[i].path;
            add (drivers[i].empty() ? filled (TRANS ("%1, range"), path) : filled (TRANS ("%1, without effect: a wire from %2 sets it"), path, drivers[i]),
                 TextBlock::Kind::small);
            const auto end = [this, i] (Json graph::Control::Target::*which) {
                return Binding { [this, i, which] {
                                    const auto* now = find (document, id);
                                    return now == nullptr || i >= now->to.size() ? Json() : now->to[i].*which;
                                },
                                 [this, i, which] (std::optional<Json> v, bool continues) {
                                     change (
                                         document, id, [&] (auto& to) {
                                      if (v && i < to.to.size()) to.to[i].*which = *v; },
                                         continues ? graph::Step::joined : graph::Step::own);
                                 } };
            };
            const auto remove = [this, path] {
                if (auto command = removeTarget (document.graph(), id, path, catalogue)) document.perform (std::move (*command));
            };
            const auto sheet = sheetOfTarget (c->to[i]);
            std::vector<TableRow::Cell> cells { { sheet, end (&graph::Control::Target::low) }, { sheet, end (&graph::Control::Target::high) } };
            add (std::make_unique<TableRow> (std::move (cells), remove, refused));
        }
    }

private:
    /// The datasheet row for both ends of a range. If wires decide the unit, it is the one in which an end is written.
    PortSheet sheetOfTarget (const graph::Control::Target& target)
    {
        auto sheet = sheetOfParam (target.path);
        for (const auto* end : { &target.low, &target.high })
            if (const auto read = plan::readNumber (*end); read && sheet.unit.kind != UnitRule::Kind::fixed)
                if (const auto unit = read->dimension.value_or (Dimension {}); unit != Dimension {})
                    sheet.unit = Unit { Quantity::any, unit, *symbols.insert (symbolOf (unit)).first };
        return sheet;
    }

    /// The datasheet row of a parameter, which may be inside of subgraphs, as in "grain/wave/drag.mu".
    PortSheet sheetOfParam (const std::string& path) const
    {
        const auto end = graph::parseEndpoint (path);
        graph::Inside in { &document.graph(), &document.graph().root };
        for (auto names = end ? end->node : std::string(); in && ! names.empty();)
        {
            const auto* node = in.patch->find (graph::firstNameOf (names));
            if (node == nullptr) break;
            if (const auto slash = names.find ('/'); slash != std::string::npos)
            {
                names.erase (0, slash + 1);
                in = graph::insideOf (*in.owner, *node);
                continue;
            }
            const auto face = faceOf (*in.owner, *in.patch, *node, catalogue);
            if (const auto* port = face.endOf (*end); port != nullptr && port->sheet != nullptr) return *port->sheet;
            break;
        }
        return sheetOfNumber ("value", UnitRule (UnitRule::Kind::open), path, {}, 0.0);
    }

    Document& document;
    const Catalogue& catalogue;
    std::string id;
    Refusal refused;
    std::set<std::string> symbols;   // of units of sheets
};
}   // namespace

std::unique_ptr<Block> controlEditor (Document& document, const Catalogue& catalogue, const std::string& id, const Refusal& refused)
{
    return std::make_unique<ControlEditor> (document, catalogue, id, refused);
}

}   // namespace tactus::host
