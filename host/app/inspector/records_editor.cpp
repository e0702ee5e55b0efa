// SPDX-License-Identifier: GPL-3.0-or-later
#include "figure_block.hpp"
#include "setting_editor.hpp"
#include "table_row.hpp"

#include <algorithm>

namespace tactus::host
{

namespace
{
PortSheet sheetOf (const SettingSheet& field)
{
    const auto* initial = std::get_if<double> (&field.initial);
    return sheetOfNumber (field.id, field.unit, field.about, field.limits, initial == nullptr ? 0.0 : *initial);
}

bool isNumber (const SettingSheet& field) { return field.kind == SettingSheet::Kind::number || field.kind == SettingSheet::Kind::integer; }

const SettingSheet* fieldOf (const SettingSheet& sheet, std::string_view id)
{
    const auto at = std::ranges::find (sheet.fields, id, &SettingSheet::id);
    return at == sheet.fields.end() ? nullptr : &*at;
}

class RecordsEditor final : public Stack
{
public:
    RecordsEditor (const SettingSheet& s, Slot at, const EditorContext& c) : sheet (s), slot (std::move (at)), context (c) {}

protected:
    std::string shape() const override
    {
        const auto now = slot.get();
        return now.is_null() ? "default" : std::to_string (now.size());
    }

    void fill() override
    {
        if (fieldOf (sheet, "frequency") != nullptr && fieldOf (sheet, "amplitude") != nullptr) put (std::make_unique<FigureBlock> ([this]
                                                                                                                                    { return tones(); }));
        std::vector<std::pair<juce::String, juce::String>> names;
        for (const auto& f : sheet.fields)
            names.emplace_back (std::string (f.id), f.unit.kind == UnitRule::Kind::fixed && f.unit.unit.symbol != "1" ? std::string (f.unit.unit.symbol) : std::string());
        put (std::make_unique<TableHead> (std::move (names)));
        const Slot all { [this]
                         { return records(); },
                         slot.set };
        for (std::size_t i = 0; i < all.get().size(); ++i)
        {
            std::vector<TableRow::Cell> cells;
            for (const auto& f : sheet.fields)
                cells.push_back ({ sheetOf (f), all.entry (i).member (std::string (f.id)), ! isNumber (f) });
            const auto remove = [all, i]
            {
                auto left = all.get();
                left.erase (i);
                all.set (std::move (left), false);
            };
            put (std::make_unique<TableRow> (std::move (cells), remove, context.refused));
        }
        const auto add = [all]
        {
            auto more = all.get();
            more.push_back (more.empty() ? Json::object() : Json (more.back()));
            all.set (std::move (more), false);
        };
        const auto one = juce::String (std::string (sheet.id)).trimCharactersAtEnd ("s");
        put (buttonRow ("+ " + one, add, "Another one, as the last"));
    }

private:
    /// What is written, or else the records that a node has by itself.
    Json records() const
    {
        auto now = slot.get();
        if (now.is_array()) return now;
        now = Json::array();
        if (const auto* initial = std::get_if<Records> (&sheet.initial))
            for (const auto& values : *initial)
            {
                auto record = Json::object();
                for (std::size_t i = 0; i < sheet.fields.size(); ++i)
                {
                    const auto id = std::string (sheet.fields[i].id);
                    if (const auto* v = std::get_if<double> (&values[i])) record[id] = *v;
                    if (const auto* v = std::get_if<std::vector<double>> (&values[i])) record[id] = *v;
                    if (const auto* v = std::get_if<std::string> (&values[i])) record[id] = *v;
                }
                now.push_back (record);
            }
        return now;
    }

    FigureBlock::Shown tones() const
    {
        Figure f { Figure::Kind::stems, {}, {}, {}, "Hz", std::string (fieldOf (sheet, "amplitude")->unit.unit.symbol), Quantity::force };
        const auto all = records();
        for (const auto& r : all)
        {
            if (! r.is_object()) continue;
            const auto number = [&] (const char* id)
            {
                const auto field = sheetOf (*fieldOf (sheet, id));
                const auto read = readQuantity (r.contains (id) ? Json (r.at (id)) : Json (field.initial[0]), field);
                const auto* q = std::get_if<QuantityText> (&read);
                return q == nullptr ? 0.0 : q->si();
            };
            f.x.push_back (number ("frequency"));
            f.y.push_back (number ("amplitude"));
        }
        if (f.x.empty()) return "No tones yet: it is silent.";
        return f;
    }

    const SettingSheet& sheet;
    Slot slot;
    EditorContext context;
};
}   // namespace

std::unique_ptr<Block> recordsEditor (const SettingSheet& sheet, Slot slot, const EditorContext& context) { return std::make_unique<RecordsEditor> (sheet, std::move (slot), context); }

}   // namespace tactus::host
