// SPDX-License-Identifier: GPL-3.0-or-later
#include "figure_block.hpp"
#include "law_shape.hpp"
#include "setting_editor.hpp"
#include "table_row.hpp"

#include <framework/plan/settings.hpp>

namespace tactus::host
{

namespace
{
juce::String symbolOf (const UnitRule& r) { return r.kind == UnitRule::Kind::fixed && r.unit.symbol != "1" ? juce::String (std::string (r.unit.symbol)) : juce::String(); }

PortSheet cellSheet (const UnitRule& unit, std::string_view about) { return sheetOfNumber ("value", unit, about, {}, 0.0); }

/// Lines of x and y in two arrays, a curve's or a table law's.
template <typename Put>
void putPoints (Slot lists, const SettingSheet& sheet, const EditorContext& context, Put&& put)
{
    const auto now = lists.get();
    const std::size_t n = now.is_array() && now.size() == 2 && now[0].is_array() && now[1].is_array() ? std::min (now[0].size(), now[1].size()) : 0;
    put (std::make_unique<TableHead> (std::vector<std::pair<juce::String, juce::String>> { { "at", symbolOf (sheet.x_unit) }, { "value", symbolOf (sheet.unit) } }));
    for (std::size_t i = 0; i < n; ++i)
    {
        const auto remove = [lists, i]
        {
            auto all = lists.get();
            for (auto& list : all)
                list.erase (i);
            lists.set (std::move (all), false);
        };
        put (std::make_unique<TableRow> (std::vector<TableRow::Cell> { { cellSheet (sheet.x_unit, "where"), lists.entry (0).entry (i) }, { cellSheet (sheet.unit, "how much there"), lists.entry (1).entry (i) } }, remove, context.refused));
    }
    const auto add = [lists]
    {
        auto all = lists.get();
        if (! all.is_array() || all.size() != 2 || ! all[0].is_array() || ! all[1].is_array()) all = Json::array ({ Json::array(), Json::array() });
        // As far beyond the last point as that is beyond the one before.
        const auto next = [] (const Json& list, double first)
        {
            const auto number = [] (const Json& v)
            {
                const auto read = readQuantity (v, sheetOfNumber ("value", UnitRule (UnitRule::Kind::open), "", {}, 0.0));
                const auto* q = std::get_if<QuantityText> (&read);
                return q == nullptr ? QuantityText {} : *q;
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
    put (buttonRow ("+ point", add, "A point beyond the last"));
}

/// The curve of a setting, drawn.
template <typename T>
std::unique_ptr<Block> figure (const SettingSheet& sheet, const Slot& slot, const std::string& without)
{
    return std::make_unique<FigureBlock> ([&sheet, slot, without]() -> FigureBlock::Shown
                                          {
        const auto now = slot.get();
        if (now.is_null()) return without;
        std::string where;
        const auto read = plan::readSetting (now, sheet, {}, where);
        if (const auto* problem = std::get_if<std::string> (&read)) return *problem;
        const auto* value = std::get_if<T> (&std::get<SettingValue> (read));
        if (value == nullptr) return without;
        auto f = figureOf (*value, sheet.x_unit, sheet.unit);
        if (f.x.empty()) return without;
        return f; });
}

class LawEditor final : public Stack
{
public:
    LawEditor (const SettingSheet& s, Slot at, const EditorContext& c) : sheet (s), slot (std::move (at)), context (c) {}

protected:
    std::string shape() const override
    {
        const auto now = slot.get();
        const auto kind = lawKindOf (now);
        if (kind != "table") return kind;
        const auto& lists = now["table"];
        return kind + (lists.is_array() && ! lists.empty() && lists[0].is_array() ? std::to_string (lists[0].size()) : "");
    }

    void fill() override
    {
        const auto get = [slot = slot]
        { return lawKindOf (slot.get()); };
        const auto set = [this] (const std::string& kind)
        {
            if (kind == lawKindOf (slot.get())) return;
            auto law = lawOfKind (kind, now());
            slot.set (law.is_null() ? std::nullopt : std::optional (std::move (law)), false);
        };
        put (choiceRow ("kind", lawKinds(), get, set, "none: not given; power: k e^n; exponential: a (exp (b e) - 1); table: straight between points; dissipation: a times the stiffness law"));
        const auto kind = get();
        const auto numbers = slot.member (kind);
        const auto number = [&] (const char* label, Slot at, const UnitRule& unit, const char* about, Limits limits)
        { put (numberRow (label, sheetOfNumber (label, unit, about, limits, 0.0), std::move (at), context.refused)); };
        if (kind == "power")
        {
            number ("k", numbers.entry (0), UnitRule (UnitRule::Kind::open), "factor of k e^n", { .hard = { 0, inf } });
            number ("n", numbers.entry (1), unit::count, "exponent of k e^n", { .hard = { 0, inf }, .usual = { 0.5, 4 } });
        }
        if (kind == "exponential")
        {
            number ("a", numbers.entry (0), sheet.unit, "of a (exp (b e) - 1)", { .hard = { 0, inf } });
            number ("b", numbers.entry (1), UnitRule (UnitRule::Kind::open), "how fast it stiffens: of a (exp (b e) - 1)", { .hard = { 0, inf } });
        }
        if (kind == "dissipation") number ("a", numbers, UnitRule (UnitRule::Kind::open), "times the law of stiffness", { .hard = { 0, inf } });
        if (kind == "table") putPoints (numbers, sheet, context, [this] (auto b)
                                        { put (std::move (b)); });
        if (kind != "none") put (figure<Law> (sheet, slot, "a factor of the stiffness law; it has no curve of its own"));
    }

private:
    Law now() const
    {
        std::string where;
        const auto read = plan::readSetting (slot.get(), sheet, {}, where);
        const auto* value = std::get_if<SettingValue> (&read);
        const auto* law = value == nullptr ? nullptr : std::get_if<Law> (value);
        return law == nullptr ? Law {} : *law;
    }

    const SettingSheet& sheet;
    Slot slot;
    EditorContext context;
};

class CurveEditor final : public Stack
{
public:
    CurveEditor (const SettingSheet& s, Slot at, const EditorContext& c) : sheet (s), slot (std::move (at)), context (c) {}

protected:
    std::string shape() const override
    {
        const auto now = slot.get();
        return now.is_array() && ! now.empty() && now[0].is_array() ? std::to_string (now[0].size()) : "";
    }

    void fill() override
    {
        put (figure<Curve> (sheet, slot, "No points yet."));
        putPoints (slot, sheet, context, [this] (auto b)
                   { put (std::move (b)); });
    }

private:
    const SettingSheet& sheet;
    Slot slot;
    EditorContext context;
};
}   // namespace

std::unique_ptr<Block> lawEditor (const SettingSheet& sheet, Slot slot, const EditorContext& context) { return std::make_unique<LawEditor> (sheet, std::move (slot), context); }
std::unique_ptr<Block> curveEditor (const SettingSheet& sheet, Slot slot, const EditorContext& context) { return std::make_unique<CurveEditor> (sheet, std::move (slot), context); }

}   // namespace tactus::host
