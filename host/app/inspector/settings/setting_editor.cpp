// SPDX-License-Identifier: GPL-3.0-or-later
#include "setting_editor.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/look/tool_button.hpp>
#include <host/app/model/readable.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/plan/settings.hpp>

#include <array>
#include <cmath>

namespace tactus::host
{

namespace
{
using Kind = SettingSheet::Kind;

bool isFile (Kind k) { return k == Kind::signal || k == Kind::image || k == Kind::table; }

/// A value as JSON with a space between its parts, so that a field can break it into lines.
juce::String spacedJson (const Json& value)
{
    if (value.is_null() || value.is_string()) return editText (value);
    const auto text = value.dump();
    std::string spaced;
    bool is_quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i)
    {
        spaced += text[i];
        if (is_quoted && text[i] == '\\' && i + 1 < text.size())
            spaced += text[++i];
        else if (text[i] == '"')
            is_quoted = ! is_quoted;
        else if (! is_quoted && (text[i] == ',' || text[i] == ':'))
            spaced += ' ';
    }
    return fromUtf8 (spaced);
}

/// A value as JSON. Of a long one, it shows the beginning until the user asks for all of it.
class JsonText final : public Block
{
public:
    JsonText (const SettingSheet& s, Binding at) : binding (std::move (at))
    {
        field.setMultiLine (true);
        field.setReturnKeyStartsNewLine (false);
        field.setTooltip (std::string (s.about));
        field.setTextToShowWhenEmpty (filled ("JSON: %1", name (s.kind)), themeOf (*this).dim);
        field.onApply = [this] (const juce::String& text) {
            binding.set (text.trim().isEmpty() ? std::nullopt : std::optional (parseText (text)), false);
        };
        all.onClick = [this] {
            shows_all = true;
            refresh (nullptr);
            resized();
            if (onHeight) onHeight();
            takeFocus (field);
        };
        addAndMakeVisible (field);
        addChildComponent (all);
    }

    int heightFor (int) override
    {
        if (is_short) return 152 + button_height;
        if (length > 160) return 152;
        return length > 40 ? 80 : 32;
    }

    void refresh (const graph::Node*) override
    {
        const auto text = spacedJson (binding.get());
        length = text.length();
        is_short = ! shows_all && length > most_shown;
        field.setReadOnly (is_short);
        field.show (is_short ? text.substring (0, most_shown).trimEnd() + fromUtf8 (" \xe2\x80\xa6") : text);
        all.setButtonText (filled (TRANS ("Edit all %1 characters"), length));
        all.setVisible (is_short);
    }

    void resized() override
    {
        auto area = getLocalBounds();
        if (is_short) all.setBounds (area.removeFromBottom (button_height).withWidth (std::min (getWidth(), all.bestWidth())).reduced (0, 2));
        field.setBounds (area.reduced (0, 2));
    }

private:
    static constexpr int most_shown = 2000, button_height = 28;

    Binding binding;
    TextField field;
    ToolButton all { TRANS ("Edit all"), ToolButton::Kind::framed, TRANS ("Opens the whole value. A field with a very long text is slow.") };
    int length = 0;
    bool is_short = false, shows_all = false;
};

/// Three numbers.
class VectorBlock final : public Block
{
public:
    VectorBlock (const SettingSheet& s, Binding at, const EditorContext& context) : binding (std::move (at))
    {
        const auto* v = std::get_if<Vec3> (&s.initial);
        initial = v == nullptr ? Vec3 (Vec3::Zero()) : *v;
        for (int i = 0; i < 3; ++i)
            sheets.push_back (sheetOfNumber (s.id, s.unit, s.about, s.limits, initial[i]));
        for (std::size_t i = 0; i < 3; ++i)
        {
            auto& f = *fields.emplace_back (std::make_unique<NumberField> (sheets[i]));
            f.onRefused = context.refused;
            f.onChange = [this, i] (std::optional<Json> value, bool continues) {
                auto all = written();
                all[i] = value ? *value : Json (sheets[i].initial[0]);
                binding.set (std::move (all), continues);
            };
            addAndMakeVisible (f);
        }
    }

    int heightFor (int) override { return 28; }

    void refresh (const graph::Node*) override
    {
        const auto now = written();
        for (std::size_t i = 0; i < 3; ++i)
            fields[i]->show (now[i]);
    }

    void resized() override
    {
        auto area = getLocalBounds().reduced (0, 2);
        for (std::size_t i = 0; i < 3; ++i)
            fields[i]->setBounds (area.removeFromLeft (area.getWidth() / static_cast<int> (3 - i)).reduced (1, 0));
    }

private:
    Json written() const
    {
        const auto now = binding.get();
        return now.is_array() && now.size() == 3 ? now : Json::array ({ initial.x(), initial.y(), initial.z() });
    }

    Binding binding;
    Vec3 initial;
    std::vector<PortSheet> sheets;
    std::vector<std::unique_ptr<NumberField>> fields;
};

/// The fields of a record, each with its own editor.
class RecordEditor final : public Stack
{
public:
    RecordEditor (const SettingSheet& s, Binding at, const EditorContext& c) : Stack (8), sheet (s), binding (std::move (at)), context (c) {}

protected:
    std::string shape() const override { return {}; }

    void fill() override
    {
        for (const auto& f : sheet.fields)
            add (settingEditor (f, binding.member (std::string (f.id)), context));
    }

private:
    const SettingSheet& sheet;
    Binding binding;
    EditorContext context;
};

/// The mesh of a surface, its deflection ratio, and its laws if they are the same at all nodes.
class SurfaceEditor final : public Stack
{
public:
    SurfaceEditor (const SettingSheet&, Binding at, const EditorContext& c) : Stack (8), binding (std::move (at)), context (c)
    {
        law.kind = Kind::law;
        law.describe ("law", unit::newton, lasting (TRANS ("force against deflection")), {});
        law.x_unit = unit::metre;
        law.initial = Law {};
    }

protected:
    std::string shape() const override
    {
        const auto now = binding.get();
        std::string text = now.is_object() && now.contains ("nodes") ? "inline" : "mesh";
        if (now.is_object() && now.contains ("mu")) text += now["mu"].is_array() ? "list" : "one";
        return text + std::to_string (tools (now));
    }

    void fill() override
    {
        const auto now = binding.get();
        if (now.is_object() && now.contains ("nodes"))
        {
            const auto count = [&] (const char* key) { return now.contains (key) && now[key].is_array() ? now[key].size() : 0; };
            const auto text = TRANS ("%1 nodes and %2 triangles, stored in the graph. Edit them as JSON.");
            add (filled (text, count ("nodes"), count ("triangles")), TextBlock::Kind::small);
        }
        else
            add (fileRow (TRANS ("mesh"), Kind::surface, mesh(), context, TRANS ("OBJ, OFF, PLY or STL")));
        const auto mu = sheetOfNumber ("mu", unit::gain, lasting (TRANS ("lateral deflection of the contact over its depth")),
                                       { .hard = { 0, inf }, .usual = { 0, 1 } }, 0.0);
        if (! now.is_object() || ! now.contains ("mu") || ! now["mu"].is_array()) add (numberRow ("mu", mu, binding.member ("mu"), context.refused));
        const std::array axes { TRANS ("x, along"), TRANS ("y, across"), TRANS ("z, inward") };
        const auto n = tools (now);
        for (std::size_t tool = 0; tool < n; ++tool)
            for (std::size_t axis = 0; axis < 3; ++axis)
            {
                add (n > 1 ? filled (TRANS ("tool %1, %2"), tool, axes[axis]) : axes[axis], TextBlock::Kind::heading);
                add (lawEditor (law, binding.member ("curves").entry (tool).entry (axis), context));
            }
    }

private:
    /// A mesh alone cannot be felt: with the first one come the curves and the ratio of the default surface, which the fields below then show.
    Binding mesh() const
    {
        auto made = binding.member ("mesh");
        made.set = [all = binding, set = made.set] (std::optional<Json> to, bool continues) {
            auto now = all.get();
            if (! to || (now.is_object() && now.contains ("curves"))) return set (std::move (to), continues);
            if (! now.is_object()) now = Json::object();
            const auto across = Json::parse (R"({ "power": [500, 1] })"), along = Json::parse (R"({ "power": [1000, 1] })");
            now["mesh"] = *to;
            now["curves"] = Json::array ({ Json::array ({ across, across, along }) });
            if (! now.contains ("mu")) now["mu"] = 0.5;
            all.set (std::move (now), continues);
        };
        return made;
    }

    /// The number of tools if each has one triple of laws for all nodes, else 0.
    static std::size_t tools (const Json& now)
    {
        if (! now.is_object() || ! now.contains ("curves") || ! now["curves"].is_array()) return 0;
        const auto& curves = now["curves"];
        for (const auto& tool : curves)
            if (! tool.is_array() || tool.size() != 3 || ! tool[0].is_object()) return 0;
        return curves.size();
    }

    Binding binding;
    EditorContext context;
    SettingSheet law {};
};

/// A setting's name over its editor, with buttons to edit it as JSON and to reset it.
class SettingBlock final : public Block
{
public:
    SettingBlock (const SettingSheet& s, Binding at, const EditorContext& context, std::unique_ptr<Block> b)
        : sheet (s), binding (std::move (at)), folder (context.folder), assets (&context.assets), body (std::move (b)), text (s, binding)
    {
        as_text.onClick = [this] {
            as_text.setToggleState (! as_text.getToggleState(), juce::dontSendNotification);
            choose();
            if (onHeight) onHeight();
        };
        reset.onClick = [this] { binding.set (std::nullopt, false); };
        body->onHeight = [this] {
            if (onHeight) onHeight();
        };
        text.onHeight = body->onHeight;
        addChildComponent (*body);
        addChildComponent (text);
        addAndMakeVisible (as_text);
        addChildComponent (reset);
        choose();
    }

    int heightFor (int width) override { return 28 + shown().heightFor (width) + (problem.isEmpty() ? 4 : 34); }

    void refresh (const graph::Node* node) override
    {
        const auto now = binding.get();
        is_set = ! now.is_null();
        reset.setVisible (is_set);
        if (now != checked)   // called after every edit, and checking may read files
        {
            checked = now;
            problem = {};
            std::string where;
            if (is_set)
                if (const auto read = plan::readSetting (now, sheet, { assets, folder() }, where); ! read)
                    problem = fromUtf8 (where.empty() ? "" : where + ": ") + fromUtf8 (read.error().text);
        }
        body->refresh (node);
        if (as_text.getToggleState()) text.refresh (node);
        repaint();
    }

    void paint (juce::Graphics& g) override
    {
        const auto& look = lookOf (*this);
        g.setFont (look.font (12.0f, is_set));
        g.setColour (is_set ? look.theme().text : look.theme().dim);
        g.drawText (fromUtf8 (readable (sheet.id)), getLocalBounds().removeFromTop (28).withTrimmedRight (108), juce::Justification::centredLeft, true);
        if (problem.isEmpty()) return;
        g.setFont (look.font (11.0f));
        g.setColour (look.theme().warning);
        g.drawFittedText (problem, getLocalBounds().removeFromBottom (32), juce::Justification::topLeft, 2, 1.0f);
    }

    void resized() override
    {
        auto area = getLocalBounds();
        auto top = area.removeFromTop (28).reduced (0, 2);
        as_text.setBounds (top.removeFromRight (44));
        reset.setBounds (top.removeFromRight (60).withTrimmedRight (4));
        shown().setBounds (area.removeFromTop (shown().heightFor (getWidth())));
    }

private:
    Block& shown() { return as_text.getToggleState() ? static_cast<Block&> (text) : *body; }

    void choose()
    {
        if (as_text.getToggleState()) text.refresh (nullptr);   // while it is hidden, it is not kept up to date, because a large value takes long
        body->setVisible (! as_text.getToggleState());
        text.setVisible (as_text.getToggleState());
        resized();
    }

    const SettingSheet& sheet;
    Binding binding;
    std::function<std::string()> folder;
    Assets* assets;
    std::unique_ptr<Block> body;
    JsonText text;
    ToolButton as_text { "JSON", ToolButton::Kind::toggle, TRANS ("Edit as JSON") };
    ToolButton reset { TRANS ("reset"), ToolButton::Kind::plain, TRANS ("Reset to default") };
    juce::String problem;
    Json checked;
    bool is_set = false;
};

std::unique_ptr<Block> bodyOf (const SettingSheet& sheet, const Binding& binding, const EditorContext& context)
{
    switch (sheet.kind)
    {
    case Kind::vector:
        return std::make_unique<VectorBlock> (sheet, binding, context);
    case Kind::curve:
        return curveEditor (sheet, binding, context);
    case Kind::law:
        return lawEditor (sheet, binding, context);
    case Kind::record:
        return std::make_unique<RecordEditor> (sheet, binding, context);
    case Kind::records:
        return recordsEditor (sheet, binding, context);
    case Kind::surface:
        return std::make_unique<SurfaceEditor> (sheet, binding, context);
    default:
        return nullptr;
    }
}
}   // namespace

std::unique_ptr<Block> settingEditor (const SettingSheet& sheet, Binding binding, const EditorContext& context)
{
    const juce::String label (fromUtf8 (readable (sheet.id))), about (std::string (sheet.about));
    if (isFile (sheet.kind)) return fileRow (label, sheet.kind, std::move (binding), context, about, sheet.id == "clip");
    if (sheet.kind == Kind::number || sheet.kind == Kind::integer)
    {
        auto number = sheetOfNumber (sheet.id, sheet.unit, sheet.about, sheet.limits, std::get<double> (sheet.initial));
        return numberRow (label, number, sheet.kind == Kind::integer ? binding.asInteger() : binding, context.refused);
    }
    if (sheet.kind == Kind::text)
    {
        const auto get = [binding] {
            const auto now = binding.get();
            return now.is_string() ? fromUtf8 (now.get<std::string>()) : juce::String();
        };
        const auto set = [binding] (const juce::String& t) {
            const auto text = t.trim();
            binding.set (text.isEmpty() ? std::nullopt : std::optional<Json> (text.toStdString()), false);
        };
        return textRow (label, get, set, about, 2);
    }
    auto body = bodyOf (sheet, binding, context);
    if (! body) body = std::make_unique<JsonText> (sheet, binding);
    return std::make_unique<SettingBlock> (sheet, std::move (binding), context, std::move (body));
}

}   // namespace tactus::host
