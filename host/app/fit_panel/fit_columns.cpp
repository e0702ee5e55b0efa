// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_columns.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/look.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
constexpr int label_height = 18, cell_gap = 12, unit_width = 64, sign_width = 28, unit_gap = 4;
constexpr int not_recorded = 1, first_column = 2;   // ids in the list

juce::String roleName (const FitColumn& column) { return fromUtf8 (column.role == "t" ? "time" : column.role); }
}   // namespace

void FitColumns::clear()
{
    cells.clear();
    repaint();
}

void FitColumns::show (const Table& table, FitKind kind)
{
    cells.clear();
    names = table.columns;
    for (const auto& wanted : infoOf (kind).columns)
    {
        auto& cell = *cells.emplace_back (std::make_unique<Cell>());
        cell.wanted = wanted;
        const auto role = roleName (wanted);
        cell.column.setTitle (filled (TRANS ("Column of %1"), role));
        cell.column.setTooltip (filled (TRANS ("The column with the %1"), fromUtf8 (wanted.about)));
        cell.column.setTextWhenNothingSelected (TRANS ("Choose"));
        if (! wanted.required) cell.column.addItem (TRANS ("not recorded"), not_recorded);
        for (std::size_t i = 0; i < names.size(); ++i)
            cell.column.addItem (fromUtf8 (names[i]), first_column + static_cast<int> (i));
        const auto found = findColumn (table, wanted);
        const int nothing = wanted.required ? 0 : not_recorded;
        cell.column.setSelectedId (found ? first_column + static_cast<int> (*found) : nothing, juce::dontSendNotification);
        const auto written = found ? unitIn (names[*found]) : std::string();
        cell.unit.setTitle (filled (TRANS ("Unit of %1"), role));
        cell.unit.setTooltip (TRANS ("What 1 in this column means, such as mm, gf or 0.5 N"));
        cell.unit.show (fromUtf8 (written.empty() ? wanted.unit : written));
        cell.column.onChange = [this, &cell] {
            const auto i = static_cast<std::size_t> (std::max (0, cell.column.getSelectedId() - first_column));
            const auto of_column = cell.column.getSelectedId() >= first_column ? unitIn (names[i]) : std::string();
            cell.unit.show (fromUtf8 (of_column.empty() ? cell.wanted.unit : of_column));
            cell.turned.reset();
            changed();
        };
        cell.sign.setTitle (filled (TRANS ("Sign of %1"), role));
        cell.sign.onClick = [this, &cell] {
            cell.turned = ! cell.sign.getToggleState();
            changed();
        };
        cell.unit.onEscapeKey = [this] {
            if (onEscape) onEscape();
        };
        cell.unit.onApply = [this, &cell] (const juce::String& text) {
            if (const auto typed = text.trimStart(); cell.wanted.is_positive && typed.startsWithChar ('-'))   // "-1 mm": the button shows the sign
            {
                cell.turned = true;
                cell.unit.setText (typed.substring (1).trimStart(), false);
                cell.unit.show (cell.unit.getText());
            }
            changed();
        };
        addAndMakeVisible (cell.column);
        if (! wanted.unit.empty()) addAndMakeVisible (cell.unit);
        if (wanted.is_positive) addAndMakeVisible (cell.sign);
    }
    showTurned ({});
    resized();
    repaint();
}

void FitColumns::changed()
{
    for (auto& cell : cells)
    {
        cell->unit.setEnabled (cell->column.getSelectedId() >= first_column);
        cell->sign.setEnabled (cell->unit.isEnabled());
    }
    if (onChange) onChange();
}

FitColumns::Cell* FitColumns::find (const std::string& role)
{
    const auto found = std::ranges::find (cells, role, [] (const auto& cell) { return cell->wanted.role; });
    return found == cells.end() ? nullptr : found->get();
}

void FitColumns::chooseColumn (const std::string& role, const juce::String& column)
{
    auto* cell = find (role);
    if (! cell) return;
    const auto at = std::ranges::find (names, column.toStdString());
    if (at != names.end()) cell->column.setSelectedId (first_column + static_cast<int> (at - names.begin()), juce::sendNotificationSync);
    if (column.isEmpty() && ! cell->wanted.required) cell->column.setSelectedId (not_recorded, juce::sendNotificationSync);
}

void FitColumns::setUnit (const std::string& role, const juce::String& unit)
{
    auto* cell = find (role);
    if (! cell) return;
    cell->unit.setText (unit, false);
    cell->unit.apply();
}

void FitColumns::turn (const std::string& role)
{
    if (auto* cell = find (role); cell && cell->wanted.is_positive && cell->sign.isEnabled()) cell->sign.onClick();
}

void FitColumns::showTurned (const std::set<std::string>& roles)
{
    for (auto& cell : cells)
    {
        const bool is_turned = roles.contains (cell->wanted.role);
        cell->sign.setToggleState (is_turned, juce::dontSendNotification);
        cell->sign.setTooltip (is_turned ? TRANS ("The sign of this column is turned: a click keeps it as recorded") : TRANS ("Turns the sign of this column"));
    }
}

ColumnChoice FitColumns::choice() const
{
    ColumnChoice made;
    for (const auto& cell : cells)
    {
        const int id = cell->column.getSelectedId();
        if (id == not_recorded) made.names[cell->wanted.role] = "";
        if (id < first_column) continue;
        made.names[cell->wanted.role] = names[static_cast<std::size_t> (id - first_column)];
        if (cell->wanted.unit.empty()) continue;
        const auto factor = factorOf (cell->unit.getText().toStdString(), cell->wanted.unit);
        if (factor) made.units[cell->wanted.role] = *factor;
        if (cell->turned) made.turned[cell->wanted.role] = *cell->turned;
    }
    return made;
}

juce::String FitColumns::problem() const
{
    juce::StringArray missing;
    for (const auto& cell : cells)
        if (cell->column.getSelectedId() == 0) missing.add (roleName (cell->wanted));
    if (! missing.isEmpty())
        return filled (TRANS ("The names of the columns do not say which is which. Choose the column of: %1."), missing.joinIntoString (", "));
    for (const auto& cell : cells)
        if (cell->column.getSelectedId() >= first_column && ! cell->wanted.unit.empty()
            && ! factorOf (cell->unit.getText().toStdString(), cell->wanted.unit))
            return filled (TRANS ("Unit of %1: %2 does not fit. Type a unit like %3, with its prefix."), roleName (cell->wanted), cell->unit.getText().quoted(),
                           cell->wanted.unit);
    return {};
}

juce::StringArray FitColumns::turnedByUser() const
{
    juce::StringArray roles;
    for (const auto& cell : cells)
        if (cell->turned && cell->sign.isEnabled()) roles.add (roleName (cell->wanted));
    return roles;
}

void FitColumns::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    g.setColour (look.theme().dim);
    g.setFont (look.font (12.0f));
    for (const auto& cell : cells)
    {
        const auto role = roleName (cell->wanted);
        g.drawText (cell->wanted.required ? role : filled (TRANS ("%1, if recorded"), role), cell->column.getX(), 0,
                    cell->unit.getRight() - cell->column.getX(), label_height - 4, juce::Justification::centredLeft, true);
    }
}

void FitColumns::resized()
{
    if (cells.empty()) return;
    const int count = static_cast<int> (cells.size());
    const int width = std::min (320, (getWidth() - (count - 1) * cell_gap) / count);
    for (int i = 0; i < count; ++i)
    {
        auto& cell = *cells[static_cast<std::size_t> (i)];
        auto place = juce::Rectangle<int> (i * (width + cell_gap), label_height, width, height - label_height);
        const bool has_unit = ! cell.wanted.unit.empty();
        cell.unit.setBounds (has_unit ? place.removeFromRight (std::min (unit_width, width / 3)) : juce::Rectangle<int> (place.getRight(), place.getY(), 0, 0));
        if (cell.wanted.is_positive)
        {
            place.removeFromRight (unit_gap);
            cell.sign.setBounds (place.removeFromRight (sign_width));
        }
        if (has_unit) place.removeFromRight (unit_gap);
        cell.column.setBounds (place);
    }
}

}   // namespace tactus::host
