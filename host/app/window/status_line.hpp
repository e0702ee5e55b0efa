// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/look.hpp>
#include <host/app/text/filled.hpp>

#include <utility>

namespace tactus::host
{

/// The line at the bottom of the window. Shows a hint about what is under the pointer, or the latest notice if there is no hint. The reason of a refusal
/// comes before hints for some seconds, because the pointer is still over what was refused. A text that is too long is shown in full in the tooltip.
class StatusLine final : public juce::Component, public juce::TooltipClient
{
public:
    static constexpr int height = 26;

    void hint (const juce::String& text)   ///< empty: no hint
    {
        if (text.isNotEmpty() && text == covered) return;
        covered = {};
        show (text, notice);
    }
    void notify (const juce::String& text)   ///< empty: like clearNotice(), and also removes the hint
    {
        refused = {};
        covered = {};
        show ({}, text);
    }
    void tell (const juce::String& what)   ///< like notify(), and comes before the hint about what is under the pointer now
    {
        const auto now = hinted.isNotEmpty() ? hinted : covered;
        notify (what);
        covered = now;
    }
    void refuse (const juce::String& why)
    {
        notify (why);
        refused = juce::Time::getCurrentTime();
    }
    void clearNotice()
    {
        refused = {};
        show (covered.isNotEmpty() ? std::exchange (covered, {}) : hinted, {});
    }
    void endRefusal() { refused = {}; }   ///< from now on, hints come first again

    juce::String text() const
    {
        constexpr double refusal_s = 8.0;
        const bool is_refused = notice.isNotEmpty() && juce::Time::getCurrentTime() < refused + juce::RelativeTime (refusal_s);
        if (hinted.isNotEmpty() && ! is_refused) return hinted;
        return notice.isNotEmpty() ? notice : TRANS ("Space: add a node   F: frame   G: group   B: bypass   Ctrl+Z: undo   Ctrl+K: find anything   F1: help");
    }

    juce::String getTooltip() override { return lineFont().getStringWidthFloat (text()) > static_cast<float> (line().getWidth()) ? text() : juce::String(); }

    void paint (juce::Graphics& g) override
    {
        const auto& look = lookOf (*this);
        g.setColour (look.theme().hairline);
        g.drawHorizontalLine (0, 0.0f, static_cast<float> (getWidth()));
        g.setFont (lineFont());
        g.setColour (text() == notice && refused != juce::Time() ? look.theme().warning : look.theme().dim);
        g.drawText (withFittedPath (text(), lineFont(), static_cast<float> (line().getWidth())), line(), juce::Justification::centredLeft, true);
    }

private:
    juce::Font lineFont() const { return lookOf (*this).font (12.0f); }
    juce::Rectangle<int> line() const { return getLocalBounds().reduced (16, 0); }

    void show (const juce::String& hint_text, const juce::String& notice_text)
    {
        if (hint_text == hinted && notice_text == notice) return;
        hinted = hint_text;
        notice = notice_text;
        repaint();
    }

    juce::String hinted, notice;
    juce::String covered;   // the hint that the notice comes before
    juce::Time refused;     // when the notice came, if it says why something was refused
};

}   // namespace tactus::host
