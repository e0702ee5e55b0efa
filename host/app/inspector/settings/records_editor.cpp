// SPDX-License-Identifier: GPL-3.0-or-later
#include "setting_editor.hpp"

#include <host/app/inspector/blocks/plot_block.hpp>
#include <host/app/inspector/blocks/table_row.hpp>
#include <host/app/model/readable.hpp>
#include <host/app/text/filled.hpp>

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
    RecordsEditor (const SettingSheet& s, Binding at, const EditorContext& c) : sheet (s), binding (std::move (at)), context (c) {}

protected:
    std::string shape() const override
    {
        const auto now = binding.get();
        return now.is_null() ? "default" : std::to_string (now.size());
    }

    void fill() override
    {
        const bool is_tones = fieldOf (sheet, "frequency") != nullptr && fieldOf (sheet, "amplitude") != nullptr;
        if (is_tones) add (std::make_unique<PlotBlock> ([this] { return tones(); }));
        std::vector<std::pair<juce::String, juce::String>> names;
        for (const auto& f : sheet.fields)
            names.emplace_back (juce::String (readable (f.id)), unitText (f.unit));
        add (std::make_unique<TableHead> (std::move (names)));
        const Binding all { [this] { return records(); },
                            binding.set };
        for (std::size_t i = 0; i < all.get().size(); ++i)
        {
            std::vector<TableRow::Cell> cells;
            for (const auto& f : sheet.fields)
                cells.push_back ({ sheetOf (f), all.entry (i).member (std::string (f.id)), ! isNumber (f) });
            const auto remove = [all, i] {
                auto left = all.get();
                left.erase (i);
                all.set (std::move (left), false);
            };
            add (std::make_unique<TableRow> (std::move (cells), remove, context.refused));
        }
        const auto append = [all] {
            auto more = all.get();
            more.push_back (more.empty() ? Json::object() : Json (more.back()));
            all.set (std::move (more), false);
        };
        const auto one = juce::String (std::string (sheet.id)).trimCharactersAtEnd ("s");
        add (buttonRow ("+ " + one, append, TRANS ("Append a copy of the last row")));
    }

private:
    /// The stored records, or the defaults if none are stored.
    Json records() const
    {
        auto now = binding.get();
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

    Result<PlotData> tones() const
    {
        PlotData f { PlotData::Kind::stems, {}, {}, {}, "Hz", std::string (fieldOf (sheet, "amplitude")->unit.unit.symbol), Quantity::force };
        const auto all = records();
        for (const auto& r : all)
        {
            if (! r.is_object()) continue;
            const auto number = [&] (const char* id) {
                const auto field = sheetOf (*fieldOf (sheet, id));
                return siOf (r.contains (id) ? Json (r.at (id)) : Json (field.initial[0]), field);
            };
            f.x.push_back (number ("frequency"));
            f.y.push_back (number ("amplitude"));
        }
        if (f.x.empty()) return Message::error ("plot/empty", {}, TRANS ("No tones.").toStdString());
        return f;
    }

    const SettingSheet& sheet;
    Binding binding;
    EditorContext context;
};
}   // namespace

std::unique_ptr<Block> recordsEditor (const SettingSheet& sheet, Binding binding, const EditorContext& context)
{
    return std::make_unique<RecordsEditor> (sheet, std::move (binding), context);
}

}   // namespace tactus::host
