// SPDX-License-Identifier: GPL-3.0-or-later
#include "fields.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/look/tool_button.hpp>
#include <host/app/look/typing_timer.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace tactus::host
{

Binding Binding::member (const std::string& key) const
{
    return { [get = get, key] {
                const auto all = get();
                return all.is_object() && all.contains (key) ? Json (all.at (key)) : Json();
            },
             [get = get, set = set, key] (std::optional<Json> value, bool continues) {
                 auto all = get();
                 if (! all.is_object()) all = Json::object();
                 if (value)
                     all[key] = *value;
                 else
                     all.erase (key);
                 set (all.empty() ? std::nullopt : std::optional (std::move (all)), continues);
             } };
}

Binding Binding::entry (std::size_t i) const
{
    return { [get = get, i] {
                const auto all = get();
                return all.is_array() && i < all.size() ? Json (all[i]) : Json();
            },
             [get = get, set = set, i] (std::optional<Json> value, bool continues) {
                 auto all = get();
                 if (! all.is_array() || i >= all.size()) return;
                 all[i] = value ? *value : Json();
                 set (std::move (all), continues);
             } };
}

Binding Binding::asInteger() const
{
    return { get, [set = set] (std::optional<Json> value, bool continues) {
                if (value && value->is_number()) value = Json (static_cast<std::int64_t> (std::llround (value->get<double>())));
                set (std::move (value), continues);
            } };
}

Json parseText (const juce::String& text)
{
    const auto trimmed = text.trim().toStdString();
    return Json::tryParse (trimmed).value_or (Json (trimmed));
}

juce::String editText (const Json& value)
{
    if (value.is_null()) return {};
    return fromUtf8 (value.is_string() ? value.get<std::string>() : value.dump());
}

TextField::TextField()
{
    setFont (lookOf (*this).font (12.0f));
    setIndents (8, 5);
    setSelectAllWhenFocused (true);
    onFocusLost = [this] { apply(); };
    onReturnKey = [this] {
        const juce::Component::SafePointer<TextField> field (this);   // what is applied may delete the field, and this function with it
        // NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage): SafePointer also takes null, but this field is not
        apply();
        if (field == nullptr) return;
        if (refused)
            selectAll();
        else
            letGoOfFocus (*field);
    };
    onEscapeKey = [this] {
        put (shown);
        letGoOfFocus (*this);
    };
}

void TextField::put (const juce::String& text)
{
    if (getText() != text) setText (text, false);
    before_typing = getText();
}

void TextField::show (const juce::String& text)
{
    shown = text;
    const bool is_typed = getText() != before_typing;   // and not yet applied: JUCE tells a field only later that it has lost the focus
    if (! hasKeyboardFocus (true) && ! is_typed) put (text);
}

void TextField::apply()
{
    refused = false;
    removeColour (focusedOutlineColourId);
    const auto text = getText();
    if (text == shown) return;
    const auto before = std::exchange (shown, text);
    before_typing = text;
    const juce::Component::SafePointer<TextField> field (this);   // what is applied may delete the field
    if (onApply) onApply (text);
    if (field == nullptr || ! refused) return;
    shown = before;
    if (! hasKeyboardFocus (true)) put (before);
}

void TextField::refuse()
{
    refused = true;
    setColour (focusedOutlineColourId, themeOf (*this).stop);
}

namespace
{
class TextRow final : public SetRow
{
public:
    TextRow (const juce::String& l, std::function<juce::String()> g, std::function<void (const juce::String&)> set, const juce::String& about, int n)
        : SetRow (l), get (std::move (g)), lines (n)
    {
        setTooltip (about);
        field.setTooltip (about);
        stacked = lines > 2;
        if (lines > 1)
        {
            field.setMultiLine (true);
            field.setReturnKeyStartsNewLine (false);
        }
        if (stacked) typing.emplace (field, [this] { field.apply(); });
        field.onApply = [this, set = std::move (set)] (const juce::String& text) {
            const auto before = get();
            const juce::Component::SafePointer<TextRow> row (this);   // what is set may delete the row
            set (text);
            if (row != nullptr && get() == before && text.trim() != before.trim()) field.refuse();
        };
        addAndMakeVisible (field);
        TextRow::refresh (nullptr);
    }

    int heightFor (int width) override
    {
        if (lines < 2) return row_height;
        // As high as the text, up to a limit; beyond that it scrolls.
        const auto& look = lookOf (*this);
        const auto layout = wrapText (field.getText(), look.font (12.0f), look.theme().text, static_cast<float> ((stacked ? width : width * 3 / 5) - 32));
        const int text = std::clamp (static_cast<int> (std::ceil (layout.getHeight())), 16, 200);
        return (stacked ? 24 : 4) + text + 16;
    }

    void refresh (const graph::Node*) override { field.show (get()); }
    void place (juce::Rectangle<int> area) override { field.setBounds (area); }

private:
    std::function<juce::String()> get;
    int lines;
    TextField field;
    std::optional<TypingTimer> typing;   // of a long text
};

class ChoiceRow final : public SetRow
{
public:
    ChoiceRow (const juce::String& l, std::vector<std::string> c, std::function<std::string()> g, std::function<void (const std::string&)> set,
               const juce::String& about)
        : SetRow (l), choices (std::move (c)), get (std::move (g))
    {
        setTooltip (about);
        box.setTooltip (about);
        for (std::size_t i = 0; i < choices.size(); ++i)
            box.addItem (choices[i], static_cast<int> (i) + 1);
        box.onChange = [this, set = std::move (set)] {
            shown.reset();
            if (const int i = box.getSelectedId(); i > 0) set (choices[static_cast<std::size_t> (i - 1)]);
        };
        addAndMakeVisible (box);
        ChoiceRow::refresh (nullptr);
    }

    void refresh (const graph::Node*) override
    {
        const auto now = get();
        if (shown == now) return;   // what the user has just chosen arrives later
        shown = now;
        const auto at = std::ranges::find (choices, now);
        if (at == choices.end())
            box.setText (now, juce::dontSendNotification);
        else
            box.setSelectedId (static_cast<int> (at - choices.begin()) + 1, juce::dontSendNotification);
    }

    void place (juce::Rectangle<int> area) override { box.setBounds (area); }

private:
    std::vector<std::string> choices;
    std::function<std::string()> get;
    std::optional<std::string> shown;   // by refresh(); empty after the user has chosen
    juce::ComboBox box;
};

class SwitchRow final : public SetRow
{
public:
    SwitchRow (const juce::String& l, std::function<bool()> g, std::function<void (bool)> set, const juce::String& about)
        : SetRow (l), get (std::move (g))
    {
        setTooltip (about);
        button.setTooltip (about);
        button.onClick = [this, set = std::move (set)] { set (! button.getToggleState()); };
        addAndMakeVisible (button);
        SwitchRow::refresh (nullptr);
    }

    void refresh (const graph::Node*) override
    {
        button.setToggleState (get(), juce::dontSendNotification);
        button.setButtonText (button.getToggleState() ? TRANS ("on") : TRANS ("off"));
    }

    void place (juce::Rectangle<int> area) override { button.setBounds (area.removeFromLeft (56)); }

private:
    std::function<bool()> get;
    ToolButton button { TRANS ("off"), ToolButton::Kind::toggle };
};

class NumberRow final : public SetRow
{
public:
    NumberRow (const juce::String& l, const PortSheet& s, Binding at, std::function<void (const juce::String&)> refused)
        : SetRow (l), sheet (s), binding (std::move (at)), field (sheet)
    {
        setTooltip (field.getTooltip());
        onReset = [this] { binding.set (std::nullopt, false); };
        field.onChange = binding.set;
        field.onRefused = std::move (refused);
        addAndMakeVisible (field);
        NumberRow::refresh (nullptr);
    }

    void refresh (const graph::Node*) override
    {
        const auto now = binding.get();
        setIsSet (! now.is_null());
        field.setBold (isSet());
        field.show (now.is_null() ? Json (sheet.initial[0]) : now);
    }

    void place (juce::Rectangle<int> area) override { field.setBounds (area); }

private:
    PortSheet sheet;
    Binding binding;
    NumberField field;
};

class ButtonRow final : public Block
{
public:
    ButtonRow (const juce::String& text, std::function<void()> press, const juce::String& about) : button (text, ToolButton::Kind::framed, about)
    {
        button.onClick = std::move (press);
        addAndMakeVisible (button);
    }

    int heightFor (int) override { return 36; }
    void resized() override { button.setBounds (getLocalBounds().reduced (0, 4).withWidth (std::min (getWidth(), button.bestWidth()))); }

private:
    ToolButton button;
};
}   // namespace

std::unique_ptr<Block> textRow (const juce::String& label, std::function<juce::String()> get, std::function<void (const juce::String&)> set,
                                const juce::String& about, int lines)
{
    return std::make_unique<TextRow> (label, std::move (get), std::move (set), about, lines);
}

std::unique_ptr<Block> choiceRow (const juce::String& label, std::vector<std::string> choices, std::function<std::string()> get,
                                  std::function<void (const std::string&)> set, const juce::String& about)
{
    return std::make_unique<ChoiceRow> (label, std::move (choices), std::move (get), std::move (set), about);
}

std::unique_ptr<Block> switchRow (const juce::String& label, std::function<bool()> get, std::function<void (bool)> set, const juce::String& about)
{
    return std::make_unique<SwitchRow> (label, std::move (get), std::move (set), about);
}

std::unique_ptr<Block> numberRow (const juce::String& label, const PortSheet& sheet, Binding binding, std::function<void (const juce::String&)> refused)
{
    return std::make_unique<NumberRow> (label, sheet, std::move (binding), std::move (refused));
}

std::unique_ptr<Block> buttonRow (const juce::String& text, std::function<void()> press, const juce::String& about)
{
    return std::make_unique<ButtonRow> (text, std::move (press), about);
}

PortSheet sheetOfNumber (std::string_view id, UnitRule unit, std::string_view about, Limits limits, double initial)
{
    return { Role::param, id, unit, about, limits, {}, 1, false, 0, { initial, 0.0, 0.0 } };
}

}   // namespace tactus::host
