// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_table.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/look.hpp>
#include <host/app/model/with_prefix.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
constexpr int verdict_height = 34, header_height = 22, row_height = 22, second_line = 16, gap = 10;
constexpr int narrower = 8;   // the gap beside a value in a narrow table

/// "402 um" and "[398, 407]" of "402 um  [398, 407]".
std::pair<juce::String, juce::String> valueAndInterval (const FitValue& v)
{
    const auto text = fromUtf8 (textOf (v)).replace (" u" + fromUtf8 (v.unit), juce::String::fromUTF8 (" \xc2\xb5") + fromUtf8 (v.unit));
    const int at = text.indexOf ("  [");
    auto interval = text.substring (at + 3).upToLastOccurrenceOf ("]", false, false).replace (", ", juce::String::fromUTF8 (" \xe2\x80\xa6 "));
    if (! std::isfinite (v.low) && ! std::isfinite (v.high)) interval = TRANS ("unknown");
    return { text.substring (0, at), interval };
}
/// The kinds as the list of the panel calls them, instead of the commands.
std::string inWindow (const std::string& text)
{
    auto words = fromUtf8 (text);
    for (const auto& info : fitKinds())
        words = words.replace (fromUtf8 ("tactus fit " + info.id), filled (TRANS ("the kind %1"), info.name));
    return words.toStdString();
}

juce::String verdictText (const FitReport& report) { return verdictOf (report) == "good" ? TRANS ("Good fit") : TRANS ("Poor fit"); }
}   // namespace

juce::String sentence (const std::string& text)
{
    const auto whole = fromUtf8 (text);
    return whole.substring (0, 1).toUpperCase() + whole.substring (1) + (whole.isEmpty() || whole.endsWithChar ('.') ? "" : ".");
}

void FitTable::show (const FittedGraph& made)
{
    report = made.report;
    details.clear();
    for (const auto& line : made.details)   // "adhesion  stick"
    {
        const auto space = std::min (line.find ("  "), line.size());
        const auto text = line.find_first_not_of (' ', space);
        details.add (sentence (text == std::string::npos ? line : line.substr (0, space) + ": " + line.substr (text)));
    }
    rows.clear();
    juce::StringArray read;
    for (const auto& v : report.values)
    {
        const auto [value, interval] = valueAndInterval (v);
        rows.push_back ({ fromUtf8 (v.name), value, interval, v.is_main });
        read.add (filled (TRANS ("%1 %2, 95 % interval %3"), rows.back().name, value, interval));
    }
    setDescription (verdictText (report) + ". " + read.joinIntoString ("; "));
    repaint();
}

juce::TextLayout FitTable::remarks (int width) const
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    juce::AttributedString text;
    const auto add = [&] (const juce::String& line, juce::Colour colour) { text.append (line + "\n", look.font (12.0f), colour); };
    for (const auto& lack : report.lacking)
        add (sentence (inWindow (lack)), theme.text);
    const auto size = [&] (double residual) {
        return fromUtf8 (report.residual_unit.empty() ? roundedText (residual, 3) : withPrefix (residual, report.residual_unit));
    };
    add (filled (TRANS ("Unexplained: %1 % (%2 rms); %3 on a part that was left out."), roundedText (100.0 * report.residual / report.size, 2),
                 size (report.residual), size (report.left_out_residual)),
         theme.dim);
    for (const auto& detail : details)
        add (detail, theme.dim);
    for (const auto& note : report.notes)
        add (sentence (note), theme.dim);
    juce::TextLayout layout;
    layout.createLayout (text, static_cast<float> (width));
    return layout;
}

int FitTable::heightFor (int width) const
{
    if (rows.empty()) return 0;
    const int each = row_height + (isNarrow (width) ? second_line : 0);
    return verdict_height + header_height + each * static_cast<int> (rows.size()) + gap + static_cast<int> (std::ceil (remarks (width).getHeight())) + 4;
}

/// The widths of the columns of the value and the interval, with the gap to the left of each.
std::pair<int, int> FitTable::widths() const
{
    constexpr int apart = 16;
    const auto font = lookOf (*this).font (12.5f);
    float value = font.getStringWidthFloat (TRANS ("Value")), interval = font.getStringWidthFloat (TRANS ("95 % interval"));
    for (const auto& row : rows)
    {
        value = std::max (value, font.getStringWidthFloat (row.value));
        interval = std::max (interval, font.getStringWidthFloat (row.interval));
    }
    return { static_cast<int> (std::ceil (value)) + apart, static_cast<int> (std::ceil (interval)) + apart };
}

/// True if a name, a value and an interval have no room beside each other. The interval is then below the value.
bool FitTable::isNarrow (int width) const
{
    const auto font = lookOf (*this).font (12.5f);
    float name = 0.0f;
    for (const auto& row : rows)
        name = std::max (name, font.getStringWidthFloat (row.name));
    const auto [value_width, interval_width] = widths();
    return width < static_cast<int> (std::ceil (name)) + value_width + interval_width;
}

void FitTable::paint (juce::Graphics& g)
{
    if (rows.empty()) return;
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    auto area = getLocalBounds();
    auto verdict = area.removeFromTop (verdict_height);
    const auto colour = report.is_good ? theme.accent : theme.warning;
    g.setColour (colour);
    g.fillEllipse (verdict.removeFromLeft (10).withSizeKeepingCentre (10, 10).toFloat());
    g.setFont (look.font (14.0f, true));
    g.setColour (theme.text);
    g.drawText (verdictText (report), verdict.withTrimmedLeft (8), juce::Justification::centredLeft, false);

    const int width = area.getWidth();
    const auto [value_width, interval_width] = widths();
    const bool is_narrow = isNarrow (width);
    const int value_room = is_narrow ? value_width - narrower : value_width;
    const int name_width = std::max (width * 25 / 100, width - value_room - (is_narrow ? 0 : interval_width));
    const auto cells = [&] (juce::Rectangle<int> line, const juce::String& name, const juce::String& value, const juce::String& interval) {
        if (is_narrow)
        {
            g.drawText (interval, line.removeFromBottom (second_line), juce::Justification::centredRight, true);
            line.translate (0, 2);   // the two lines are one row
        }
        g.drawText (name, line.removeFromLeft (name_width), juce::Justification::centredLeft, true);
        g.drawText (value, line.removeFromLeft (value_room), juce::Justification::centredRight, true);
        if (! is_narrow) g.drawText (interval, line, juce::Justification::centredRight, true);
    };
    g.setFont (look.font (12.0f));
    g.setColour (theme.dim);
    auto head = area.removeFromTop (header_height);
    if (is_narrow)
    {
        g.drawText (TRANS ("Parameter"), head.removeFromLeft (width / 3), juce::Justification::centredLeft, true);
        g.drawText (TRANS ("Value, 95 % interval"), head, juce::Justification::centredRight, true);
    }
    else
        cells (head, TRANS ("Parameter"), TRANS ("Value"), TRANS ("95 % interval"));
    for (const auto& row : rows)
    {
        g.setColour (theme.hairline);
        g.drawHorizontalLine (area.getY(), static_cast<float> (area.getX()), static_cast<float> (area.getRight()));
        g.setColour (row.is_main ? theme.text : theme.dim);
        g.setFont (look.font (12.5f));
        cells (area.removeFromTop (row_height + (is_narrow ? second_line : 0)), row.name, row.value, row.interval);
    }
    area.removeFromTop (gap);
    remarks (width).draw (g, area.toFloat());
}

}   // namespace tactus::host
