// SPDX-License-Identifier: GPL-3.0-or-later
#include "setting_editor.hpp"
#include "tool_button.hpp"

#include <framework/plan/settings.hpp>

#include <array>
#include <cmath>

namespace tactus::host
{

namespace
{
using Kind = SettingSheet::Kind;

bool isFile (Kind k) { return k == Kind::signal || k == Kind::image || k == Kind::table; }

/// A value as in the file.
class JsonText final : public Block
{
public:
    JsonText (const SettingSheet& s, Slot at) : slot (std::move (at))
    {
        field.setMultiLine (true);
        field.setReturnKeyStartsNewLine (false);
        field.setTooltip (std::string (s.about));
        field.setTextToShowWhenEmpty ("as the file has it: " + std::string (name (s.kind)), themeOf (*this).dim);
        field.onApply = [this] (const juce::String& text)
        {
            const auto written = text.trim().toStdString();
            auto value = Json::parse (written, nullptr, false);
            if (value.is_discarded()) value = Json (written);
            slot.set (written.empty() ? std::nullopt : std::optional (std::move (value)), false);
        };
        addAndMakeVisible (field);
    }

    int heightFor (int) override { return length > 160 ? 152 : length > 40 ? 80
                                                                           : 32; }

    void refresh (const graph::Node*) override
    {
        const auto now = slot.get();
        const auto text = now.is_null() ? std::string() : now.is_string() ? now.get<std::string>()
                                                                          : now.dump();
        length = text.size();
        field.show (text);
    }

    void resized() override { field.setBounds (getLocalBounds().reduced (0, 2)); }

private:
    Slot slot;
    TextField field;
    std::size_t length = 0;
};

/// Three numbers.
class VectorBlock final : public Block
{
public:
    VectorBlock (const SettingSheet& s, Slot at, const EditorContext& context) : slot (std::move (at))
    {
        const auto* v = std::get_if<Vec3> (&s.initial);
        initial = v == nullptr ? Vec3 (Vec3::Zero()) : *v;
        for (int i = 0; i < 3; ++i)
            sheets.push_back (sheetOfNumber (s.id, s.unit, s.about, s.limits, initial[i]));
        for (std::size_t i = 0; i < 3; ++i)
        {
            auto& f = *fields.emplace_back (std::make_unique<NumberField> (sheets[i]));
            f.onRefused = context.refused;
            f.onChange = [this, i] (std::optional<Json> value, bool goes_on)
            {
                auto all = written();
                all[i] = value ? *value : Json (sheets[i].initial[0]);
                slot.set (std::move (all), goes_on);
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
        const auto now = slot.get();
        return now.is_array() && now.size() == 3 ? now : Json::array ({ initial.x(), initial.y(), initial.z() });
    }

    Slot slot;
    Vec3 initial;
    std::vector<PortSheet> sheets;
    std::vector<std::unique_ptr<NumberField>> fields;
};

/// The fields of a record, each with its own editor.
class RecordEditor final : public Stack
{
public:
    RecordEditor (const SettingSheet& s, Slot at, const EditorContext& c) : sheet (s), slot (std::move (at)), context (c) { indent = 8; }

protected:
    std::string shape() const override { return {}; }

    void fill() override
    {
        for (const auto& f : sheet.fields)
            put (settingEditor (f, slot.member (std::string (f.id)), context));
    }

private:
    const SettingSheet& sheet;
    Slot slot;
    EditorContext context;
};

/// The mesh of a surface, its deflection ratio, and the laws it gives by where these are the same everywhere.
class SurfaceEditor final : public Stack
{
public:
    SurfaceEditor (const SettingSheet&, Slot at, const EditorContext& c) : slot (std::move (at)), context (c)
    {
        indent = 8;
        law.kind = Kind::law;
        law.describe ("law", unit::newton, "force over deflection", {});
        law.x_unit = unit::metre;
        law.initial = Law {};
    }

protected:
    std::string shape() const override
    {
        const auto now = slot.get();
        std::string text = now.is_object() && now.contains ("nodes") ? "inline" : "mesh";
        if (now.is_object() && now.contains ("mu")) text += now["mu"].is_array() ? "list" : "one";
        return text + std::to_string (tools (now));
    }

    void fill() override
    {
        const auto now = slot.get();
        if (now.is_object() && now.contains ("nodes"))
        {
            const auto count = [&] (const char* key)
            { return std::to_string (now.contains (key) && now[key].is_array() ? now[key].size() : 0); };
            put (std::make_unique<Words> (juce::String (count ("nodes") + " nodes and " + count ("triangles") + " triangles, written in the graph itself. Its text has them all."), Words::Kind::small));
        }
        else
            put (fileRow ("mesh", Kind::surface, slot.member ("mesh"), context, "OBJ, OFF, PLY or STL"));
        if (! now.is_object() || ! now.contains ("mu") || ! now["mu"].is_array()) put (numberRow ("mu", sheetOfNumber ("mu", unit::gain, "how far the contact gives sideways, over its depth", { .hard = { 0, inf }, .usual = { 0, 1 } }, 0.0), slot.member ("mu"), context.refused));
        static constexpr std::array axes { "x, along", "y, across", "z, inward" };
        const auto n = tools (now);
        for (std::size_t tool = 0; tool < n; ++tool)
            for (std::size_t axis = 0; axis < 3; ++axis)
            {
                put (std::make_unique<Words> ((n > 1 ? "tool " + juce::String (static_cast<int> (tool)) + ", " : juce::String()) + axes[axis], Words::Kind::heading));
                put (lawEditor (law, slot.member ("curves").entry (tool).entry (axis), context));
            }
    }

private:
    /// How many tools have one triple of laws for all nodes; 0 if any has more.
    static std::size_t tools (const Json& now)
    {
        if (! now.is_object() || ! now.contains ("curves") || ! now["curves"].is_array()) return 0;
        const auto& curves = now["curves"];
        for (const auto& tool : curves)
            if (! tool.is_array() || tool.size() != 3 || ! tool[0].is_object()) return 0;
        return curves.size();
    }

    Slot slot;
    EditorContext context;
    SettingSheet law {};
};

/// A head with the setting's name over its editor, which the text of the file can take the place of.
class Titled final : public Block
{
public:
    Titled (const SettingSheet& s, Slot at, const EditorContext& context, std::unique_ptr<Block> b) : sheet (s), slot (std::move (at)), folder (context.folder), assets (&context.assets), body (std::move (b)), text (s, slot)
    {
        as_text.onClick = [this]
        {
            as_text.setToggleState (! as_text.getToggleState(), juce::dontSendNotification);
            choose();
            if (onHeight) onHeight();
        };
        reset.onClick = [this]
        { slot.set (std::nullopt, false); };
        body->onHeight = [this]
        {
            if (onHeight) onHeight();
        };
        addChildComponent (*body);
        addChildComponent (text);
        addAndMakeVisible (as_text);
        addChildComponent (reset);
        choose();
    }

    int heightFor (int width) override { return 28 + shown().heightFor (width) + (problem.isEmpty() ? 4 : 34); }

    void refresh (const graph::Node* node) override
    {
        const auto now = slot.get();
        is_set = ! now.is_null();
        reset.setVisible (is_set);
        if (now != checked)   // it may name files, and each edit of the graph comes by here
        {
            checked = now;
            problem = {};
            std::string where;
            if (is_set)
                if (const auto read = plan::readSetting (now, sheet, { assets, folder() }, where); const auto* why = std::get_if<std::string> (&read)) problem = juce::String::fromUTF8 ((where.empty() ? *why : where + ": " + *why).c_str());
        }
        body->refresh (node);
        text.refresh (node);
        repaint();
    }

    void paint (juce::Graphics& g) override
    {
        const auto& look = lookOf (*this);
        g.setFont (look.font (12.0f, is_set));
        g.setColour (is_set ? look.theme().text : look.theme().dim);
        g.drawText (std::string (sheet.id), getLocalBounds().removeFromTop (28).withTrimmedRight (108), juce::Justification::centredLeft, true);
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
        body->setVisible (! as_text.getToggleState());
        text.setVisible (as_text.getToggleState());
        resized();
    }

    const SettingSheet& sheet;
    Slot slot;
    std::function<std::string()> folder;
    Assets* assets;
    std::unique_ptr<Block> body;
    JsonText text;
    ToolButton as_text { "text", ToolButton::Kind::toggle, "Write it as in the file" }, reset { "reset", ToolButton::Kind::plain, "Back to the default" };
    juce::String problem;
    Json checked;
    bool is_set = false;
};

std::unique_ptr<Block> bodyOf (const SettingSheet& sheet, const Slot& slot, const EditorContext& context)
{
    switch (sheet.kind)
    {
    case Kind::vector:
        return std::make_unique<VectorBlock> (sheet, slot, context);
    case Kind::curve:
        return curveEditor (sheet, slot, context);
    case Kind::law:
        return lawEditor (sheet, slot, context);
    case Kind::record:
        return std::make_unique<RecordEditor> (sheet, slot, context);
    case Kind::records:
        return recordsEditor (sheet, slot, context);
    case Kind::surface:
        return std::make_unique<SurfaceEditor> (sheet, slot, context);
    default:
        return nullptr;
    }
}
}   // namespace

std::unique_ptr<Block> settingEditor (const SettingSheet& sheet, Slot slot, const EditorContext& context)
{
    const juce::String label (std::string (sheet.id)), about (std::string (sheet.about));
    if (isFile (sheet.kind)) return fileRow (label, sheet.kind, std::move (slot), context, about);
    if (sheet.kind == Kind::number || sheet.kind == Kind::integer)
    {
        auto number = sheetOfNumber (sheet.id, sheet.unit, sheet.about, sheet.limits, std::get<double> (sheet.initial));
        if (sheet.kind == Kind::integer)
            slot.set = [set = slot.set] (std::optional<Json> v, bool goes_on)
            {
                if (v && v->is_number()) v = Json (static_cast<std::int64_t> (std::llround (v->get<double>())));
                set (std::move (v), goes_on);
            };
        return numberRow (label, number, std::move (slot), context.refused);
    }
    if (sheet.kind == Kind::text)
    {
        const auto get = [slot]
        {
            const auto now = slot.get();
            return now.is_string() ? juce::String::fromUTF8 (now.get<std::string>().c_str()) : juce::String();
        };
        return textRow (
            label, get, [slot] (const juce::String& t)
            { slot.set (t.trim().isEmpty() ? std::nullopt : std::optional<Json> (t.trim().toStdString()), false); },
            about, 2);
    }
    auto body = bodyOf (sheet, slot, context);
    if (! body) body = std::make_unique<JsonText> (sheet, slot);
    return std::make_unique<Titled> (sheet, std::move (slot), context, std::move (body));
}

}   // namespace tactus::host
