// SPDX-License-Identifier: GPL-3.0-or-later
#include "rows.hpp"
#include "setting_editor.hpp"
#include "table_row.hpp"
#include "tool_button.hpp"
#include <host/app/model/held.hpp>

#include <framework/graph/text.hpp>

#include <algorithm>

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

/// Its name, which a double click edits, its fader, and a cross.
class Head final : public Block
{
public:
    Head (Document& d, std::string i) : document (d), id (std::move (i))
    {
        name.setEditable (false, true, false);
        name.setBorderSize ({ 0, 0, 0, 0 });
        name.setTooltip ("Double click to rename");
        name.onTextChange = [this]
        { change (document, id, [text = name.getText().toStdString()] (auto& c)
                  { c.name = text; }); };
        fader.setSliderStyle (juce::Slider::LinearBar);
        fader.setRange (0.0, 1.0);
        fader.setNumDecimalPlacesToDisplay (2);
        fader.onDragStart = [this]
        { goes_on = false; };
        fader.onDragEnd = [this]
        { goes_on = false; };
        fader.onValueChange = [this]
        {
            change (
                document, id, [v = fader.getValue()] (auto& c)
                { c.value = v; },
                goes_on ? graph::Step::joined : graph::Step::own);
            goes_on = fader.isMouseButtonDown();
        };
        cross.onClick = [this]
        { document.perform (graph::RemoveControl { id }); };
        addAndMakeVisible (name);
        addAndMakeVisible (fader);
        addAndMakeVisible (cross);
    }

    int heightFor (int) override { return 28; }

    void refresh (const graph::Node*) override
    {
        const auto* c = find (document, id);
        if (c == nullptr) return;
        if (! name.isBeingEdited()) name.setText (c->name.empty() ? c->id : c->name, juce::dontSendNotification);
        fader.setValue (c->value, juce::dontSendNotification);
    }

    void resized() override
    {
        auto area = getLocalBounds().reduced (0, 2);
        cross.setBounds (area.removeFromRight (24));
        name.setBounds (area.removeFromLeft (getWidth() * 2 / 5).withTrimmedRight (4));
        fader.setBounds (area);
    }

private:
    Document& document;
    std::string id;
    juce::Label name;
    juce::Slider fader;
    ToolButton cross { juce::String::fromUTF8 ("\xc3\x97"), ToolButton::Kind::plain, "Remove this control; what it set keeps what is stored of it" };
    bool goes_on = false;
};

class ControlEditor final : public Stack
{
public:
    ControlEditor (Document& d, const Catalogue& c, std::string i, Refusal r) : document (d), catalogue (c), id (std::move (i)), refused (std::move (r)) {}

protected:
    std::string shape() const override
    {
        std::string all;
        if (const auto* c = find (document, id))
            for (const auto& t : c->to)
                all += t.path + '|';
        return all;
    }

    void fill() override
    {
        put (std::make_unique<Head> (document, id));
        const auto* c = find (document, id);
        if (c == nullptr) return;
        if (c->to.empty()) put (std::make_unique<Words> ("Moves nothing yet: press the right button on a parameter.", Words::Kind::small));
        for (std::size_t i = 0; i < c->to.size(); ++i)
        {
            const auto path = c->to[i].path;
            put (std::make_unique<Words> (juce::String (path) + ", from and to", Words::Kind::small));
            const auto end = [this, i] (Json graph::Control::Target::*which)
            {
                return Slot { [this, i, which]
                              {
                                  const auto* now = find (document, id);
                                  return now == nullptr || i >= now->to.size() ? Json() : now->to[i].*which;
                              },
                              [this, i, which] (std::optional<Json> v, bool goes_on)
                              {
                                  change (
                                      document, id, [&] (auto& to)
                                      {
                                      if (v && i < to.to.size()) to.to[i].*which = *v; },
                                      goes_on ? graph::Step::joined : graph::Step::own);
                              } };
            };
            const auto remove = [this, path]
            {
                if (auto command = removeTarget (document.graph(), id, path)) document.perform (std::move (*command));
            };
            const auto sheet = sheetOfTarget (path);
            put (std::make_unique<TableRow> (std::vector<TableRow::Cell> { { sheet, end (&graph::Control::Target::low) }, { sheet, end (&graph::Control::Target::high) } }, remove, refused));
        }
    }

private:
    PortSheet sheetOfTarget (const std::string& path) const
    {
        const auto e = graph::parseEndpoint (path);
        if (const auto* end = std::get_if<graph::Endpoint> (&e))
            if (const auto* node = document.graph().root.find (end->node))
            {
                const auto face = faceOf (document.graph(), document.graph().root, *node, catalogue);
                if (const auto* port = face.endOf (*end); port != nullptr && port->sheet != nullptr) return *port->sheet;
            }
        return sheetOfNumber ("value", UnitRule (UnitRule::Kind::open), path, {}, 0.0);
    }

    Document& document;
    const Catalogue& catalogue;
    std::string id;
    Refusal refused;
};
}   // namespace

std::unique_ptr<Block> controlEditor (Document& document, const Catalogue& catalogue, const std::string& id, const Refusal& refused) { return std::make_unique<ControlEditor> (document, catalogue, id, refused); }

}   // namespace tactus::host
