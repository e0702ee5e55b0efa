// SPDX-License-Identifier: GPL-3.0-or-later
#include "rows.hpp"
#include "number_field.hpp"

#include <algorithm>

namespace tactus::host
{

namespace
{
constexpr int row_height = 28;

/// Which entry of an array port an id names: 2 of "gain[2]", or none.
std::optional<std::size_t> entryOf (const std::string& id)
{
    const auto bracket = id.find ('[');
    return bracket == std::string::npos ? std::nullopt : std::optional (static_cast<std::size_t> (std::atoi (id.c_str() + bracket + 1)));
}

std::string baseOf (const std::string& id) { return id.substr (0, id.find ('[')); }

/// A label at the left and a field at the right.
class ParamRow final : public Block, public juce::SettableTooltipClient
{
public:
    using Change = std::function<void (std::optional<Json>, bool goes_on)>;

    ParamRow (const FacePort& p, const Change& change, const Refusal& refused) : port (p)
    {
        setTooltip (port.about);
        const int fields = port.isChoice() ? 0 : port.width;
        for (int i = 0; i < fields; ++i)
        {
            auto& f = *numbers.emplace_back (std::make_unique<NumberField> (*port.sheet));
            f.onChange = [this, change, i] (std::optional<Json> v, bool goes_on)
            { change (v && port.width == 3 ? std::optional (withComponent (static_cast<std::size_t> (i), *v)) : v, goes_on); };
            f.onRefused = refused;
            f.setTooltip (port.about);
            addAndMakeVisible (f);
        }
        if (! port.isChoice()) return;
        for (std::size_t i = 0; i < port.sheet->choices.size(); ++i)
            choice.addItem (juce::String (std::string (port.sheet->choices[i])), static_cast<int> (i) + 1);
        choice.onChange = [this, change]
        { change (Json (std::string (port.sheet->choices[static_cast<std::size_t> (choice.getSelectedId() - 1)])), false); };
        addAndMakeVisible (choice);
    }

    int heightFor (int) override { return row_height; }

    void refresh (const graph::Node* node) override
    {
        Json own;
        if (node != nullptr)
            if (const auto found = node->params.find (baseOf (port.id)); found != node->params.end()) own = *found;
        if (const auto entry = entryOf (port.id); entry && own.is_array()) own = *entry < own.size() ? Json (own[*entry]) : Json();
        is_set = ! own.is_null();
        current = own;
        if (port.isChoice())
        {
            const auto name = own.is_string() ? own.get<std::string>() : std::string (port.sheet->choices[static_cast<std::size_t> (port.sheet->initial[0])]);
            const auto at = std::ranges::find (port.sheet->choices, name);
            choice.setSelectedId (static_cast<int> (at - port.sheet->choices.begin()) + 1, juce::dontSendNotification);
        }
        for (std::size_t i = 0; i < numbers.size(); ++i)
            numbers[i]->show (componentOf (own, i));
        repaint();
    }

    void paint (juce::Graphics& g) override
    {
        const auto& look = lookOf (*this);
        g.setFont (look.font (12.0f, is_set));
        g.setColour (is_set ? look.theme().text : look.theme().dim);
        g.drawText (port.id, getLocalBounds().removeFromLeft (labelWidth()), juce::Justification::centredLeft, true);
    }

    void resized() override
    {
        auto area = getLocalBounds().withTrimmedLeft (labelWidth()).reduced (0, 2);
        if (port.isChoice())
        {
            choice.setBounds (area);
            return;
        }
        const int each = area.getWidth() / static_cast<int> (numbers.size());
        for (auto& n : numbers)
            n->setBounds (area.removeFromLeft (each).reduced (1, 0));
    }

private:
    int labelWidth() const { return getWidth() * 2 / 5; }

    Json componentOf (const Json& own, std::size_t i) const
    {
        if (port.width == 3) return own.is_array() && i < own.size() ? own[i] : Json (port.sheet->initial[i]);
        return own.is_null() ? Json (port.sheet->initial[0]) : own;
    }

    Json withComponent (std::size_t i, const Json& v) const
    {
        auto all = Json::array();
        for (std::size_t k = 0; k < 3; ++k)
            all.push_back (k == i ? v : componentOf (current, k));
        return all;
    }

    FacePort port;
    Json current;
    bool is_set = false;
    std::vector<std::unique_ptr<NumberField>> numbers;
    juce::ComboBox choice;
};

/// A setting, as text of a file.
class SettingRow final : public Block
{
public:
    SettingRow (const SettingSheet& s, std::function<void (std::optional<Json>)> change) : sheet (s)
    {
        text.setFont (lookOf (*this).font (12.0f));
        text.setMultiLine (true);
        text.setReturnKeyStartsNewLine (false);
        text.setIndents (8, 5);
        text.setTooltip (std::string (sheet.about));
        text.setTextToShowWhenEmpty (std::string (sheet.about), themeOf (*this).dim);
        const auto apply = [this, change = std::move (change)]
        {
            const auto written = text.getText().trim().toStdString();
            if (written == shown) return;
            if (written.empty()) return change (std::nullopt);
            const bool is_text = sheet.kind == SettingSheet::Kind::text;
            auto value = is_text ? Json (written) : Json::parse (written, nullptr, false);
            if (value.is_discarded()) value = Json (written);
            shown = written;
            change (std::move (value));
        };
        text.onReturnKey = apply;
        text.onFocusLost = apply;
        addAndMakeVisible (text);
    }

    int heightFor (int) override { return 20 + (shown.size() > 40 ? 64 : 28) + 4; }

    void refresh (const graph::Node* node) override
    {
        std::string now;
        if (node != nullptr)
            if (const auto own = node->settings.find (std::string (sheet.id)); own != node->settings.end()) now = own->is_string() ? own->get<std::string>() : own->dump();
        if (now == shown && text.getText().toStdString() == now) return;
        shown = now;
        if (! text.hasKeyboardFocus (true)) text.setText (now, false);
    }

    void paint (juce::Graphics& g) override
    {
        const auto& look = lookOf (*this);
        g.setFont (look.font (12.0f, ! shown.empty()));
        g.setColour (shown.empty() ? look.theme().dim : look.theme().text);
        g.drawText (std::string (sheet.id), getLocalBounds().removeFromTop (20), juce::Justification::centredLeft, true);
    }

    void resized() override { text.setBounds (getLocalBounds().withTrimmedTop (20).withTrimmedBottom (4)); }

private:
    const SettingSheet& sheet;
    std::string shown;
    juce::TextEditor text;
};

/// A macro of the graph: one fader.
class ControlRow final : public Block
{
public:
    ControlRow (Document& d, std::string i) : document (d), id (std::move (i))
    {
        fader.setSliderStyle (juce::Slider::LinearBar);
        fader.setRange (0.0, 1.0);
        fader.setNumDecimalPlacesToDisplay (2);
        fader.onDragStart = [this]
        { goes_on = false; };
        fader.onValueChange = [this]
        {
            const auto& all = document.graph().controls;
            const auto found = std::ranges::find (all, id, &graph::Control::id);
            if (found == all.end()) return;
            auto to = *found;
            to.value = fader.getValue();
            document.perform (graph::ChangeControl { id, to }, goes_on ? graph::Step::joined : graph::Step::own);
            goes_on = true;
        };
        addAndMakeVisible (fader);
        refresh (nullptr);
    }

    int heightFor (int) override { return row_height; }

    void refresh (const graph::Node*) override
    {
        const auto& all = document.graph().controls;
        const auto found = std::ranges::find (all, id, &graph::Control::id);
        if (found == all.end()) return;
        label = found->name.empty() ? found->id : found->name;
        fader.setValue (found->value, juce::dontSendNotification);
        repaint();
    }

    void paint (juce::Graphics& g) override
    {
        const auto& look = lookOf (*this);
        g.setFont (look.font (12.0f));
        g.setColour (look.theme().text);
        g.drawText (label, getLocalBounds().removeFromLeft (getWidth() * 2 / 5), juce::Justification::centredLeft, true);
    }

    void resized() override { fader.setBounds (getLocalBounds().withTrimmedLeft (getWidth() * 2 / 5).reduced (0, 2)); }

private:
    Document& document;
    std::string id, label;
    juce::Slider fader;
    bool goes_on = false;
};

/// An array with one entry changed, and what stood before it filled up with defaults.
Json withEntry (Json all, std::size_t entry, const Json& value, double initial)
{
    if (! all.is_array()) all = Json::array();
    while (all.size() <= entry)
        all.push_back (initial);
    all[entry] = value;
    return all;
}
}   // namespace

std::unique_ptr<Block> paramRow (Document& document, const std::string& patch, const std::string& node, const FacePort& port, const Refusal& refused)
{
    const auto change = [&document, patch, node, port] (std::optional<Json> value, bool goes_on)
    {
        const auto base = baseOf (port.id);
        if (const auto entry = entryOf (port.id); entry && value)
        {
            const auto* in = patch.empty() ? &document.graph().root : document.graph().find (patch);
            const auto* n = in == nullptr ? nullptr : in->find (node);
            const auto own = n == nullptr || ! n->params.contains (base) ? Json() : Json (n->params.at (base));
            value = withEntry (own, *entry, *value, port.sheet->initial[0]);
        }
        document.perform (graph::SetParam { patch, node, base, std::move (value) }, goes_on ? graph::Step::joined : graph::Step::own);
    };
    return std::make_unique<ParamRow> (port, change, refused);
}

std::unique_ptr<Block> settingRow (Document& document, const std::string& patch, const std::string& node, const SettingSheet& sheet)
{
    return std::make_unique<SettingRow> (sheet, [&document, patch, node, id = std::string (sheet.id)] (std::optional<Json> value)
                                         { document.perform (graph::SetSetting { patch, node, id, std::move (value) }); });
}

std::unique_ptr<Block> controlRow (Document& document, const std::string& id) { return std::make_unique<ControlRow> (document, id); }

}   // namespace tactus::host
