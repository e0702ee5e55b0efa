// SPDX-License-Identifier: GPL-3.0-or-later
#include "law_shape.hpp"
#include "setting_editor.hpp"

#include <host/app/inspector/blocks/plot_block.hpp>
#include <host/app/inspector/blocks/table_row.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/plan/settings.hpp>

namespace tactus::host
{

namespace
{
PortSheet cellSheet (const UnitRule& unit, std::string_view about) { return sheetOfNumber ("value", unit, about, {}, 0.0); }

/// Adds rows for the points of a curve or of a table law, which are stored as one array of x and one of y.
void addPoints (Binding lists, const SettingSheet& sheet, const EditorContext& context, Column& column)
{
    const auto now = lists.get();
    const std::size_t n = now.is_array() && now.size() == 2 && now[0].is_array() && now[1].is_array() ? std::min (now[0].size(), now[1].size()) : 0;
    std::vector<std::pair<juce::String, juce::String>> head { { "x", unitText (sheet.x_unit) }, { "y", unitText (sheet.unit) } };
    column.add (std::make_unique<TableHead> (std::move (head)));
    for (std::size_t i = 0; i < n; ++i)
    {
        const auto remove = [lists, i] {
            auto all = lists.get();
            for (auto& list : all)
                list.erase (i);
            lists.set (std::move (all), false);
        };
        std::vector<TableRow::Cell> cells { { cellSheet (sheet.x_unit, "x"), lists.entry (0).entry (i) },
                                            { cellSheet (sheet.unit, "y"), lists.entry (1).entry (i) } };
        column.add (std::make_unique<TableRow> (std::move (cells), remove, context.refused));
    }
    const auto append = [lists] {
        auto all = lists.get();
        if (! all.is_array() || all.size() != 2 || ! all[0].is_array() || ! all[1].is_array()) all = Json::array ({ Json::array(), Json::array() });
        // Extrapolates from the last two points.
        const auto next = [] (const Json& list, double first) {
            const auto number = [] (const Json& v) {
                const auto read = readQuantity (v, cellSheet (UnitRule (UnitRule::Kind::open), ""));
                return read ? *read : QuantityText {};
            };
            const auto n_before = list.size();
            if (n_before == 0) return Json (0.0);
            const auto last = number (list[n_before - 1]);
            const double step = n_before > 1 ? last.si() - number (list[n_before - 2]).si() : first;
            return last.moved (last.si() + step).toJson();
        };
        const auto x = next (all[0], 1e-3), y = next (all[1], 1.0);
        all[0].push_back (x);
        all[1].push_back (y);
        lists.set (std::move (all), false);
    };
    column.add (buttonRow (TRANS ("+ point"), append, TRANS ("Append a point")));
}

/// A plot of a curve or law setting. `without` is shown if there is nothing to plot.
template <typename T>
std::unique_ptr<Block> plot (const SettingSheet& sheet, const Binding& binding, const std::string& without)
{
    return std::make_unique<PlotBlock> ([&sheet, binding, without]() -> Result<PlotData> {
        const auto nothing = Message::error ("plot/empty", {}, without);
        const auto now = binding.get();
        if (now.is_null()) return nothing;
        std::string where;
        const auto read = plan::readSetting (now, sheet, {}, where);
        if (! read) return read.error();
        const auto* value = std::get_if<T> (&*read);
        if (value == nullptr) return nothing;
        auto data = plotOf (*value, sheet.x_unit, sheet.unit);
        if (data.x.empty()) return nothing;
        return data;
    });
}

const char* const law_help =
    NEEDS_TRANS ("none: no law; power: k e^n; exponential: a (exp (b e) - 1); table: linear between points; dissipation: a times the stiffness law");

class LawEditor final : public Stack
{
public:
    LawEditor (const SettingSheet& s, Binding at, const EditorContext& c) : sheet (s), binding (std::move (at)), context (c) {}

protected:
    std::string shape() const override
    {
        const auto now = binding.get();
        const auto kind = lawKindOf (now);
        if (kind != "table") return kind;
        const auto& lists = now["table"];
        return kind + (lists.is_array() && ! lists.empty() && lists[0].is_array() ? std::to_string (lists[0].size()) : "");
    }

    void fill() override
    {
        const auto get = [binding = binding] { return lawKindOf (binding.get()); };
        const auto set = [this] (const std::string& kind) {
            if (kind == lawKindOf (binding.get())) return;
            auto law = lawOfKind (kind, now());
            binding.set (law.is_null() ? std::nullopt : std::optional (std::move (law)), false);
        };
        add (choiceRow (TRANS ("kind"), lawKinds(), get, set, juce::translate (law_help)));
        const auto kind = get();
        const auto numbers = binding.member (kind);
        const auto number = [&] (const char* label, Binding at, const UnitRule& unit, const juce::String& about, Limits limits) {
            add (numberRow (label, sheetOfNumber (label, unit, lasting (about), limits, 0.0), std::move (at), context.refused));
        };
        if (kind == "power")
        {
            number ("k", numbers.entry (0), UnitRule (UnitRule::Kind::open), TRANS ("factor of k e^n"), { .hard = { 0, inf } });
            number ("n", numbers.entry (1), unit::count, TRANS ("exponent of k e^n"), { .hard = { 0, inf }, .usual = { 0.5, 4 } });
        }
        if (kind == "exponential")
        {
            number ("a", numbers.entry (0), sheet.unit, TRANS ("factor of a (exp (b e) - 1)"), { .hard = { 0, inf } });
            number ("b", numbers.entry (1), UnitRule (UnitRule::Kind::open), TRANS ("exponent of a (exp (b e) - 1)"), { .hard = { 0, inf } });
        }
        if (kind == "dissipation") number ("a", numbers, UnitRule (UnitRule::Kind::open), TRANS ("factor of the stiffness law"), { .hard = { 0, inf } });
        if (kind == "table") addPoints (numbers, sheet, context, *this);
        if (kind != "none") add (plot<Law> (sheet, binding, TRANS ("A factor of the stiffness law, without its own curve.").toStdString()));
    }

private:
    Law now() const
    {
        std::string where;
        const auto read = plan::readSetting (binding.get(), sheet, {}, where);
        const auto* law = read ? std::get_if<Law> (&*read) : nullptr;
        return law == nullptr ? Law {} : *law;
    }

    const SettingSheet& sheet;
    Binding binding;
    EditorContext context;
};

class CurveEditor final : public Stack
{
public:
    CurveEditor (const SettingSheet& s, Binding at, const EditorContext& c) : sheet (s), binding (std::move (at)), context (c) {}

protected:
    std::string shape() const override
    {
        const auto now = binding.get();
        return now.is_array() && ! now.empty() && now[0].is_array() ? std::to_string (now[0].size()) : "";
    }

    void fill() override
    {
        add (plot<Curve> (sheet, binding, TRANS ("No points.").toStdString()));
        addPoints (binding, sheet, context, *this);
    }

private:
    const SettingSheet& sheet;
    Binding binding;
    EditorContext context;
};
}   // namespace

std::unique_ptr<Block> lawEditor (const SettingSheet& sheet, Binding binding, const EditorContext& context)
{
    return std::make_unique<LawEditor> (sheet, std::move (binding), context);
}

std::unique_ptr<Block> curveEditor (const SettingSheet& sheet, Binding binding, const EditorContext& context)
{
    return std::make_unique<CurveEditor> (sheet, std::move (binding), context);
}

}   // namespace tactus::host
