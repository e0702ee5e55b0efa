// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_panel.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/model/quantity_text.hpp>
#include <host/app/text/filled.hpp>
#include <host/tools/fitting/recording_file.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/units.hpp>

#include <cmath>

namespace tactus::host
{

namespace
{
constexpr int fit_margin = 24, widest_box = 1240, highest_box = 720, field_height = 28, table_width = 380;

/// A number that a kind of fit needs and a recording does not contain.
struct Amount
{
    const char *label, *unit, *usual;
    void (*set) (FitSettings&, double);
    bool is_above_0 = true;      ///< otherwise it may have any value
    const char* if_empty = "";   ///< what is used then
};

std::optional<Amount> amountOf (FitKind kind)
{
    switch (kind)
    {
    case FitKind::friction:
    case FitKind::grating:
        return Amount { NEEDS_TRANS ("Normal force"), "N", "1 N", [] (FitSettings& s, double v) { s.load = v; } };
    case FitKind::texture:
        return Amount { NEEDS_TRANS ("Mass of the tip"), "kg", "10 g", [] (FitSettings& s, double v) { s.mass = v; } };
    case FitKind::blade:
        return Amount { NEEDS_TRANS ("Width of the cut"), "m", "20 mm", [] (FitSettings& s, double v) { s.width = v; } };
    case FitKind::shock:
        return Amount { NEEDS_TRANS ("Mass"), "kg", "", [] (FitSettings& s, double v) { s.mass = v; }, true, NEEDS_TRANS ("from the times") };
    case FitKind::curve:
        return Amount { NEEDS_TRANS ("Depth at the touch"), "m", "", [] (FitSettings& s, double v) { s.touch = v; }, false, NEEDS_TRANS ("from the force") };
    case FitKind::modes:
        return Amount { NEEDS_TRANS ("Time of the blow"), "s", "", [] (FitSettings& s, double v) { s.blow = v; }, false, NEEDS_TRANS ("from the ring") };
    case FitKind::key_switch:
        break;
    }
    return {};
}

/// A load that was recorded need not be typed.
bool isRecorded (FitKind kind, const Table& table, const ColumnChoice& choice)
{
    if (kind != FitKind::friction) return false;
    const auto& columns = infoOf (kind).columns;
    return findColumn (table, *std::ranges::find (columns, "load", &FitColumn::role), choice).has_value();
}

/// Sets what is typed, unless that is nothing. Returns why it does not fit, or nothing.
juce::String setTyped (const Amount& wanted, const juce::String& text, FitSettings& settings)
{
    if (text.isEmpty()) return {};
    const auto typed = parseMeasure (unitWritten (text.toStdString())), unit = parseMeasure (std::string ("1 ") + wanted.unit);
    const bool fits = typed && (typed->dimension == unit->dimension || typed->dimension == Dimension {});
    if (! fits || (wanted.is_above_0 && ! (typed->value > 0.0)) || ! std::isfinite (typed->value))
        return filled (wanted.is_above_0 ? TRANS ("%1: %2 does not fit. Type a number above 0 with its unit, such as 1.5 %3.")
                                         : TRANS ("%1: %2 does not fit. Type a number with its unit, such as 1.5 %3."),
                       juce::translate (wanted.label), text.quoted(), wanted.unit);
    wanted.set (settings, typed->value);
    return {};
}
}   // namespace

FitPanel::FitPanel()
{
    setVisible (false);
    setWantsKeyboardFocus (true);
    setTitle (TRANS ("Fit a recording"));
    kinds.setTitle (TRANS ("What was recorded"));
    for (const auto& info : fitKinds())
        kinds.addItem (fromUtf8 (info.name) + juce::String::fromUTF8 (" \xe2\x80\x93 ") + fromUtf8 (info.about), static_cast<int> (info.kind) + 1);
    kinds.setTextWhenNothingSelected (TRANS ("Choose what was recorded"));
    kinds.onChange = [this] {
        if (kinds.getSelectedId() > 0) choose (static_cast<FitKind> (kinds.getSelectedId() - 1));
    };
    amount.onReturnKey = amount.onFocusLost = [this] { readAmount(); };
    amount.onEscapeKey = [this] { close(); };
    amount.setSelectAllWhenFocused (true);
    amount.setIndents (8, 6);
    which.onChange = [this] {
        if (isOpen()) fit();
    };
    which.onEscape = [this] { close(); };
    amount_label.setJustificationType (juce::Justification::centredRight);
    as_graph.setFirst (true);
    as_graph.setTooltip (TRANS ("Open a new graph in which the fit can be felt; the open graph is saved first if you like"));
    into_graph.setTooltip (TRANS ("Add only the fitted nodes to the open graph, with their obvious wires"));
    as_graph.onClick = [this] { acceptAsGraph(); };
    into_graph.onClick = [this] { acceptIntoGraph(); };
    cancel.onClick = [this] { close(); };
    scroll.setViewedComponent (&values, false);
    scroll.setScrollBarsShown (true, false);
    for (auto* c : std::initializer_list<juce::Component*> { &kinds, &which, &amount_label, &amount, &plot, &scroll, &as_graph, &into_graph, &cancel })
        addAndMakeVisible (c);
}

void FitPanel::open (const std::filesystem::path& path)
{
    job.cancel();
    file = path;
    chosen.reset();
    kinds.setSelectedId (0, juce::dontSendNotification);
    table.reset();
    which.clear();
    plot.show ({});
    setVisible (true);
    toFront (false);
    auto read = readRecordingOrWav (path);
    if (read)
        table = std::make_shared<const Table> (std::move (*read));
    else
        fail (messageText (read.error()));
    if (table)
    {
        const auto guessed = guessKind (*table);
        guessed ? choose (*guessed) : fail (TRANS ("The columns do not say what was recorded. Choose it in the list.").toStdString());
    }
    takeFocus (*this);
}

void FitPanel::close()
{
    job.cancel();
    if (! isOpen()) return;
    setVisible (false);
    if (auto* parent = getParentComponent()) takeFocus (*parent);
}

void FitPanel::choose (FitKind kind)
{
    chosen = kind;
    kinds.setSelectedId (static_cast<int> (kind) + 1, juce::dontSendNotification);
    const auto wanted = amountOf (kind);
    amount.setText (wanted ? wanted->usual : "", false);
    amount_label.setText (wanted ? juce::translate (wanted->label) : juce::String(), juce::dontSendNotification);
    amount.setTitle (wanted ? juce::translate (wanted->label) : juce::String());
    amount.setTextToShowWhenEmpty (wanted && *wanted->if_empty != 0 ? juce::translate (wanted->if_empty) : juce::String(), themeOf (*this).dim);
    if (table) which.show (*table, kind);
    fit();
}

void FitPanel::setAmount (const juce::String& text)
{
    amount.setText (text, false);
    readAmount();
}

void FitPanel::readAmount()
{
    if (isOpen() && chosen && amount.getText() != amount.getProperties()["fitted"].toString()) fit();
}

void FitPanel::fit()
{
    job.cancel();
    result.reset();
    failure.clear();
    plot.show ({});
    values.show ({});
    FitSettings settings { .columns = which.choice() };
    const auto wanted = chosen ? amountOf (*chosen) : std::nullopt;
    amount.getProperties().set ("fitted", amount.getText());
    if (! table || ! chosen) return;
    if (const auto wrong = which.problem(); wrong.isNotEmpty()) return fail (wrong.toStdString());
    const bool asks = wanted && ! isRecorded (*chosen, *table, settings.columns);
    const auto unfit = asks ? setTyped (*wanted, amount.getText().trim(), settings) : juce::String();
    auto seen = pictureOf (*chosen, *table, settings);
    plot.show (std::move (seen.picture));
    which.showTurned (seen.turned);
    if (unfit.isNotEmpty()) return fail (unfit.toStdString());
    job.start (file.string(), [kind = *chosen, read = table, where = file.string(), settings] (FitCourse& course) {
        return fitRecording (kind, *read, where, settings, &course);
    });
    showResult();
}

void FitPanel::fail (const std::string& why)
{
    failure = sentence (why);
    result.reset();
    showResult();
}

void FitPanel::poll()
{
    if (! isOpen()) return;
    if (job.isRunning()) repaint (scroll.getBounds());
    auto done = job.take();
    if (! done) return;
    if (! *done)
    {
        auto why = sentence (messageText (done->error()));
        if (const auto turned = which.turnedByUser(); ! turned.isEmpty())
            why << " "
                << filled (TRANS ("You have chosen the sign of %1: a click on the button before its unit changes it back."), turned.joinIntoString (", "));
        return fail (why.toStdString());
    }
    result = std::move (**done);
    plot.show (result->report.picture);
    values.show (*result);
    showResult();
}

/// Everything that depends on whether there is a fit.
void FitPanel::showResult()
{
    as_graph.setEnabled (result.has_value());
    into_graph.setEnabled (result.has_value());
    for (auto* button : { &as_graph, &into_graph })
        button->setAlpha (button->isEnabled() ? 1.0f : 0.4f);
    plot.setVisible (! plot.shown().curves.empty());
    scroll.setVisible (result.has_value());
    const bool asks = chosen && amountOf (*chosen) && table && ! isRecorded (*chosen, *table, which.choice());
    amount.setVisible (asks);
    amount_label.setVisible (asks);
    const auto state = job.isRunning() ? TRANS ("Fitting") : juce::String();
    setDescription (failure.isNotEmpty() ? failure : state);
    resized();
    repaint();
}

void FitPanel::acceptAsGraph()
{
    if (result && onOpenGraph) onOpenGraph (*result);
}

void FitPanel::acceptIntoGraph()
{
    if (! result) return;
    const auto made = *result;
    close();
    if (onInsert) onInsert (made);
}

bool FitPanel::keyPressed (const juce::KeyPress& key)
{
    if (key != juce::KeyPress::returnKey || ! result) return false;
    acceptAsGraph();
    return true;
}

/// In a small window, the plot is worth more than the space around it.
juce::Rectangle<int> FitPanel::inner() const { return isLow() ? box.reduced (12, 8) : box.reduced (fit_margin, 20); }

juce::Rectangle<int> FitPanel::headingArea() const { return inner().removeFromTop (24); }

juce::String FitPanel::getTooltip()
{
    return headingArea().contains (getMouseXYRelative()) ? fromUtf8 (printableName (file.string())) : juce::String();
}

void FitPanel::resized()
{
    const int around = isLow() ? 8 : 24, gap = isLow() ? 4 : 10;
    box = getLocalBounds().withSizeKeepingCentre (std::min (widest_box, getWidth() - (isLow() ? 8 : 32)), std::min (highest_box, getHeight() - around));
    auto area = inner();
    area.removeFromTop (24 + gap);   // heading
    auto row = area.removeFromTop (field_height);
    if (amount.isVisible())
    {
        amount.setBounds (row.removeFromRight (isLow() ? 116 : 120));
        amount_label.setBounds (row.removeFromRight (130));
        row.removeFromRight (12);
    }
    kinds.setBounds (row.removeFromLeft (std::min (row.getWidth(), 460)));
    area.removeFromTop (gap);
    which.setBounds (area.removeFromTop (table && chosen ? FitColumns::height : 0));
    area.removeFromTop (gap + 4);
    auto buttons = area.removeFromBottom (isLow() ? 28 : 32);
    area.removeFromBottom (gap + 6);
    for (auto* button : { &as_graph, &into_graph, &cancel })
    {
        button->setBounds (buttons.removeFromRight (button->widthFor()));
        buttons.removeFromRight (8);
    }
    auto right = area.removeFromRight (std::min (table_width, area.getWidth() * 45 / 100));
    area.removeFromRight (20);
    plot.setBounds (area);
    scroll.setBounds (right);
    const int bar = scroll.getScrollBarThickness() + 6, high = values.heightFor (right.getWidth() - bar);
    values.setSize (right.getWidth() - bar, std::max (1, high));
}

void FitPanel::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    drawDialog (g, theme, box);
    g.setColour (theme.text);
    g.setFont (look.font (16.0f, true));
    const auto heading = headingArea();
    constexpr int room_for_rows = 100;
    const auto font = look.font (16.0f, true);
    const float room = static_cast<float> (heading.getWidth() - room_for_rows) - font.getStringWidthFloat (filled (TRANS ("Fit %1"), ""));
    const auto name = fittedPath (fromUtf8 (printableName (file.filename().string())), font, room);
    g.drawText (filled (TRANS ("Fit %1"), name), heading, juce::Justification::centredLeft, true);
    if (table)
    {
        g.setColour (theme.dim);
        g.setFont (look.font (12.0f));
        g.drawText (filled (TRANS ("%1 rows"), table->rows()), heading, juce::Justification::centredRight, false);
    }
    if (result) return;

    const auto place = plot.isVisible() ? scroll.getBounds() : plot.getBounds().getUnion (scroll.getBounds());
    if (failure.isNotEmpty())
    {
        const auto text = wrapText (failure, look.font (13.0f), theme.stop, static_cast<float> (place.getWidth()));
        text.draw (g, place.toFloat());
        return;
    }
    if (! job.isRunning()) return;
    auto line = place.withSizeKeepingCentre (std::min (280, place.getWidth()), 40);
    g.setColour (theme.dim);
    g.setFont (look.font (13.0f));
    g.drawText (TRANS ("Fitting ..."), line.removeFromTop (20), juce::Justification::centred, false);
    const auto bar = line.removeFromTop (8).toFloat();
    g.setColour (theme.raised);
    g.fillRoundedRectangle (bar, 4.0f);
    g.setColour (theme.accent);
    g.fillRoundedRectangle (bar.withWidth (bar.getWidth() * static_cast<float> (juce::jlimit (0.03, 1.0, job.share()))), 4.0f);
}

}   // namespace tactus::host
