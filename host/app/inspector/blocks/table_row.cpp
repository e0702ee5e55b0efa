// SPDX-License-Identifier: GPL-3.0-or-later
#include "table_row.hpp"

namespace tactus::host
{

namespace
{
constexpr int cross_width = 24;

std::vector<juce::Rectangle<int>> columnsOf (juce::Rectangle<int> area, std::size_t n)
{
    area.removeFromRight (cross_width);
    std::vector<juce::Rectangle<int>> all;
    for (std::size_t i = 0; i < n; ++i)
        all.push_back (area.removeFromLeft (area.getWidth() / static_cast<int> (n - i)).withTrimmedRight (2));
    return all;
}
}   // namespace

TableRow::TableRow (std::vector<Cell> c, std::function<void()> remove, const std::function<void (const juce::String&)>& refused)
    : cells (std::move (c))
{
    for (auto& cell : cells)
    {
        if (cell.is_text)
        {
            auto field = std::make_unique<TextField>();
            field->setTooltip (std::string (cell.sheet.about));
            field->setTitle (spokenName (cell.sheet));
            field->onApply = [binding = cell.binding] (const juce::String& text) { binding.set (parseText (text), false); };
            fields.push_back (std::move (field));
        }
        else
        {
            auto field = std::make_unique<NumberField> (cell.sheet);
            field->onChange = [binding = cell.binding, initial = cell.sheet.initial[0]] (std::optional<Json> v, bool continues) {
                if (! v) v = Json (initial);
                binding.set (std::move (v), continues);
            };
            field->onRefused = refused;
            fields.push_back (std::move (field));
        }
        addAndMakeVisible (*fields.back());
    }
    cross.onClick = std::move (remove);
    addAndMakeVisible (cross);
}

void TableRow::refresh (const graph::Node*)
{
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
        const auto now = cells[i].binding.get();
        if (auto* number = dynamic_cast<NumberField*> (fields[i].get()))
            number->show (now.is_null() ? Json (cells[i].sheet.initial[0]) : now);
        else if (auto* text = dynamic_cast<TextField*> (fields[i].get()))
            text->show (editText (now));
    }
}

void TableRow::resized()
{
    const auto columns = columnsOf (getLocalBounds().reduced (0, 1), fields.size());
    for (std::size_t i = 0; i < fields.size(); ++i)
        fields[i]->setBounds (columns[i]);
    cross.setBounds (getLocalBounds().removeFromRight (cross_width));
}

void TableHead::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    g.setFont (look.font (11.0f));
    g.setColour (look.theme().dim);
    const auto places = columnsOf (getLocalBounds(), columns.size());
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
        auto place = places[i].withTrimmedRight (4);
        g.drawText (columns[i].second, place.removeFromBottom (16), juce::Justification::centredRight, true);
        g.drawText (columns[i].first, place, juce::Justification::centredRight, true);
    }
}

}   // namespace tactus::host
