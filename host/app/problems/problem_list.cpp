// SPDX-License-Identifier: GPL-3.0-or-later
#include "problem_list.hpp"

#include <host/app/look/button.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr int problem_height = 48, least_button_width = 144;

bool isSame (const Message& a, const Message& b) { return a.id == b.id && a.where == b.where && a.text == b.text && a.severity == b.severity; }
}   // namespace

class ProblemList::Row final : public juce::Component, public juce::SettableTooltipClient
{
public:
    Row (ProblemList& l, Message m, bool remark)
        : list (l), message (std::move (m)), is_remark (remark), text (fromUtf8 (message.text)), remedy (fromUtf8 (withoutOptions (message.remedy)))
    {
        setMouseCursor (juce::MouseCursor::PointingHandCursor);
        setTooltip (text + (remedy.isEmpty() ? "" : "\n" + remedy));   // with the whole of a shortened path
        const auto fix = fixOf (list.document.graph(), message);
        const bool lacks_file = ! fix && missingFileOf (list.document.graph(), message);
        if (! fix && ! lacks_file) return;
        button = std::make_unique<TextButton> (fix ? fromUtf8 (fix->label) : TRANS ("Choose file ..."));
        button->onClick = [this, lacks_file] {
            if (lacks_file && list.onChooseFile) return list.onChooseFile (message);
            // The graph may have changed since the button was made.
            if (auto now = fixOf (list.document.graph(), message)) list.onFix (std::move (now->command));
        };
        addAndMakeVisible (*button);
        button_width = std::max (least_button_width, button->getBestWidthForHeight (28));
    }

    void paint (juce::Graphics& g) override
    {
        const auto& look = lookOf (*this);
        const auto& theme = look.theme();
        auto area = getLocalBounds().reduced (16, 4);
        if (button) area.removeFromRight (button_width + 8);
        const bool is_error = message.severity == Message::Severity::error;
        g.setColour (is_error ? theme.stop : is_remark ? theme.dim
                                                       : theme.warning);
        g.fillEllipse (area.removeFromLeft (20).withSizeKeepingCentre (8, 8).translated (-6, 0).toFloat());
        const auto [what, help] = texts (area.getWidth());
        const auto height = what.getHeight() + help.getHeight();
        auto place = area.toFloat().withSizeKeepingCentre (static_cast<float> (area.getWidth()), height);
        what.draw (g, place.removeFromTop (what.getHeight()));
        help.draw (g, place);
        g.setColour (theme.hairline);
        g.drawHorizontalLine (getHeight() - 1, 16.0f, static_cast<float> (getWidth() - 16));
    }

    int heightFor (int width) const
    {
        const auto [what, help] = texts (width - 2 * 16 - 20 - (button ? button_width + 8 : 0));
        return std::max (problem_height, static_cast<int> (std::ceil (what.getHeight() + help.getHeight())) + 12);
    }

    void resized() override
    {
        if (button) button->setBounds (getLocalBounds().reduced (16, 0).removeFromRight (button_width).withSizeKeepingCentre (button_width, 28));
    }

    void mouseUp (const juce::MouseEvent& e) override
    {
        const bool is_click = e.mods.isLeftButtonDown() && ! e.source.hasMovedSignificantlySincePressed();
        if (is_click && list.onShow) list.onShow (locationOf (list.document.graph(), message));
    }

private:
    std::pair<juce::TextLayout, juce::TextLayout> texts (int width) const
    {
        const auto& look = lookOf (*this);
        const auto w = static_cast<float> (width);
        return { wrapText (text, look.font (13.0f), look.theme().text, w),
                 wrapText (remedy, look.font (12.0f), look.theme().dim, w) };
    }

    ProblemList& list;
    const Message message;
    const bool is_remark;
    const juce::String text, remedy;
    std::unique_ptr<TextButton> button;
    int button_width = 0;
};

ProblemList::ProblemList (Document& d) : document (d)
{
    setTitle (TRANS ("Problems"));
    scroll.setTitle (TRANS ("Problems"));
    scroll.setViewedComponent (&column, false);
    scroll.setScrollBarsShown (true, false);
    scroll.setScrollBarThickness (8);
    addAndMakeVisible (scroll);
}

ProblemList::~ProblemList() = default;

void ProblemList::show (const Messages& messages, const Messages& remarks, bool checking)
{
    if (std::exchange (is_checking, checking) != checking && rows.empty()) repaint();
    if (asked && std::ranges::equal (messages, shown, isSame) && std::ranges::equal (remarks, remarked, isSame)) return;
    asked = true;
    shown = messages;
    std::stable_partition (shown.begin(), shown.end(), [] (const Message& m) { return m.severity == Message::Severity::error; });
    rows.clear();
    for (const auto* all : { &std::as_const (shown), &remarks })
        for (const auto& m : *all)
            column.addAndMakeVisible (*rows.emplace_back (std::make_unique<Row> (*this, m, all == &remarks)));
    shown = messages;
    remarked = remarks;
    resized();
    repaint();
}

void ProblemList::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    g.fillAll (look.theme().panel);
    if (! rows.empty()) return;
    g.setFont (look.font (13.0f));
    g.setColour (look.theme().dim);
    g.drawFittedText (is_checking ? TRANS ("No problems so far. The limits of the devices are being checked.")
                                  : TRANS ("No problems. Errors, warnings and broken limits of the devices are listed here with their remedies."),
                      getLocalBounds().reduced (24), juce::Justification::centred, 2);
}

void ProblemList::resized()
{
    scroll.setBounds (getLocalBounds());
    const auto layOut = [&] (int width) {
        int y = 0;
        for (auto& row : rows)
        {
            row->setBounds (0, y, width, row->heightFor (width));
            y = row->getBottom();
        }
        column.setSize (width, y);
    };
    layOut (scroll.getWidth());
    if (column.getHeight() > scroll.getHeight()) layOut (scroll.getWidth() - scroll.getScrollBarThickness());
}

}   // namespace tactus::host
