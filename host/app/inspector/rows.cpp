// SPDX-License-Identifier: GPL-3.0-or-later
#include "rows.hpp"
#include "fields.hpp"
#include <host/app/model/held.hpp>
#include <host/app/model/param_now.hpp>
#include <host/app/model/param_value.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
const graph::Node* find (const Document& document, const std::string& patch, const std::string& node)
{
    const auto* in = patch.empty() ? &document.graph().root : document.graph().find (patch);
    return in == nullptr ? nullptr : in->find (node);
}

/// As many digits as a hand can mean.
double rounded (double v) { return v == 0.0 ? 0.0 : std::stod (juce::String::formatted ("%.3e", v).toStdString()); }

/// A label at the left and a field at the right.
class ParamRow final : public SetRow
{
public:
    ParamRow (Document& d, std::string p, std::string n, const FacePort& f, const Refusal& r) : SetRow (f.id), document (d), patch (std::move (p)), node_name (std::move (n)), port (f), refused (r)
    {
        setTooltip (tooltipOf (*port.sheet));
        onReset = [this]
        { change (std::nullopt, false); };
        if (patch.empty() && port.width == 1 && ! port.isChoice())
            onWantsMenu = [this] (juce::PopupMenu& menu)
            { fill (menu); };
        const int fields = port.isChoice() ? 0 : port.width;
        for (int i = 0; i < fields; ++i)
        {
            auto& field = *numbers.emplace_back (std::make_unique<NumberField> (*port.sheet));
            field.onChange = [this, i] (std::optional<Json> v, bool goes_on)
            { change (v && port.width == 3 ? std::optional (withComponent (static_cast<std::size_t> (i), *v)) : std::move (v), goes_on); };
            field.onRefused = refused;
            addAndMakeVisible (field);
        }
        if (! port.isChoice()) return;
        for (std::size_t i = 0; i < port.sheet->choices.size(); ++i)
            choice.addItem (juce::String (std::string (port.sheet->choices[i])), static_cast<int> (i) + 1);
        choice.onChange = [this]
        { change (Json (std::string (port.sheet->choices[static_cast<std::size_t> (choice.getSelectedId() - 1)])), false); };
        choice.setTooltip (getTooltip());
        addAndMakeVisible (choice);
    }

    void refresh (const graph::Node*) override
    {
        const auto* node = find (document, patch, node_name);
        if (node == nullptr) return;
        auto now = paramNow (document.graph(), patch, *node, port);
        current = std::move (now.value);
        setIsSet (now.is_set);
        setNote (now.held ? "by " + juce::String (now.held->name) : juce::String(), themeOf (*this).accent);
        if (port.isChoice())
        {
            const auto at = std::ranges::find (port.sheet->choices, current.is_string() ? current.get<std::string>() : std::string());
            choice.setSelectedId (static_cast<int> (at - port.sheet->choices.begin()) + 1, juce::dontSendNotification);
        }
        for (std::size_t i = 0; i < numbers.size(); ++i)
        {
            numbers[i]->show (componentOf (i));
            numbers[i]->setStrong (isSet());
        }
    }

    void place (juce::Rectangle<int> area) override
    {
        choice.setBounds (area);
        for (std::size_t i = 0; i < numbers.size(); ++i)
            numbers[i]->setBounds (area.removeFromLeft (area.getWidth() / static_cast<int> (numbers.size() - i)).reduced (numbers.size() > 1 ? 1 : 0, 0));
    }

private:
    std::optional<Held> heldNow() const { return patch.empty() ? heldBy (document.graph(), node_name + '.' + port.id) : std::nullopt; }

    void change (std::optional<Json> value, bool goes_on)
    {
        const auto* node = find (document, patch, node_name);
        if (node == nullptr) return;
        if (auto command = changeParam (document.graph(), patch, *node, port, value))
        {
            document.perform (std::move (*command), goes_on ? graph::Step::joined : graph::Step::own);
            return;
        }
        refresh (nullptr);
        if (refused) refused (beyondReach (document.graph(), *node, port));
    }

    void fill (juce::PopupMenu& menu)
    {
        if (const auto held = heldNow())
        {
            menu.addItem ("Release from " + juce::String (held->name), [safe = juce::Component::SafePointer (this)]
                          {
                if (safe != nullptr) release (safe->document, safe->node_name, safe->port); });
            return;
        }
        menu.addSectionHeader (juce::String::fromUTF8 ("Control this by\xe2\x80\xa6"));
        const auto item = [&] (const juce::String& what, const std::string& id)
        {
            menu.addItem (what, [safe = juce::Component::SafePointer (this), id]
                          {
                if (safe != nullptr) controlBy (safe->document, safe->node_name, safe->port, id); });
        };
        for (const auto& c : document.graph().controls)
            item (c.name.empty() ? c.id : c.name, c.id);
        item ("a new control", {});
    }

    Json componentOf (std::size_t i) const { return port.width == 3 ? current.is_array() && i < current.size() ? Json (current[i]) : Json (port.sheet->initial[i]) : current; }

    Json withComponent (std::size_t i, const Json& v) const
    {
        auto all = Json::array();
        for (std::size_t k = 0; k < 3; ++k)
            all.push_back (k == i ? v : componentOf (k));
        return all;
    }

    Document& document;
    std::string patch, node_name;
    FacePort port;
    Refusal refused;
    Json current;
    std::vector<std::unique_ptr<NumberField>> numbers;
    juce::ComboBox choice;
};
}   // namespace

std::unique_ptr<Block> paramRow (Document& document, const std::string& patch, const std::string& node, const FacePort& port, const Refusal& refused) { return std::make_unique<ParamRow> (document, patch, node, port, refused); }

void controlBy (Document& document, const std::string& name, const FacePort& port, const std::string& control)
{
    const auto* node = find (document, {}, name);
    if (node == nullptr || port.sheet == nullptr) return;
    const auto own = writtenValue (*node, port);
    const auto now = own.is_null() ? initialValue (document.graph(), *node, port) : own;
    const auto [low, high] = sweepOf (now, *port.sheet);
    const auto path = name + '.' + port.id;
    const auto read = readQuantity (now, *port.sheet);
    const auto* q = std::get_if<QuantityText> (&read);
    auto command = control.empty() ? std::optional (newControlFor (document.graph(), path, low, high, q == nullptr ? 0.0 : q->si())) : addTarget (document.graph(), control, path, low, high);
    if (command) document.perform (std::move (*command));
}

void release (Document& document, const std::string& name, const FacePort& port)
{
    const auto path = name + '.' + port.id;
    const auto held = heldBy (document.graph(), path);
    const auto* node = find (document, {}, name);
    if (! held || node == nullptr || port.sheet == nullptr) return;
    auto without = removeTarget (document.graph(), held->control, path);
    if (! without) return;
    // What the control made of it, it keeps.
    const auto read = readQuantity (held->low_text, *port.sheet);
    const auto* unit = std::get_if<QuantityText> (&read);
    const auto value = unit == nullptr ? Json (rounded (held->value)) : unit->moved (held->value).toJson();
    document.perform (graph::Batch { "release " + path, { std::move (*without), graph::SetParam { {}, name, baseOf (port.id), withValue (*node, port, value) } } });
}

}   // namespace tactus::host
