// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/button.hpp>
#include <host/app/look/look.hpp>

#include <functional>

namespace tactus::host
{

/// A small text button. A toggle is filled while it is on.
class ToolButton final : public Button
{
public:
    enum class Kind
    {
        plain,   ///< no frame; highlighted on hover
        framed,
        toggle,   ///< shows whether it is on, which the owner sets
        tab       ///< one of several tabs
    };

    ToolButton (const juce::String& caption, Kind k, const juce::String& tooltip = {}) : Button (caption), kind (k)
    {
        setTooltip (tooltip);
        if (caption.length() < 2) setTitle (tooltip.upToFirstOccurrenceOf (":", false, false));   // a screen reader cannot read a symbol
        setMouseClickGrabsKeyboardFocus (false);                                                  // the canvas keeps the keyboard focus
        setMouseCursor (juce::MouseCursor::PointingHandCursor);
    }

    /// The fill colour of the toggle while it is on. The default is the accent colour.
    void setColour (std::function<juce::Colour (const Theme&)> c) { on_colour = std::move (c); }

    void setJustification (juce::Justification j) { justified = j; }

    /// Shows a dot in the colour of the toggle before the text while it is off, as for a recording.
    void setDot() { has_dot = true; }

    int bestWidth() const { return static_cast<int> (lookOf (*this).font (12.0f).getStringWidthFloat (getButtonText())) + 20; }

    void paintButton (juce::Graphics& g, bool over, bool down) override
    {
        const auto& look = lookOf (*this);
        const auto& theme = look.theme();
        const auto area = getLocalBounds().toFloat().reduced (0.5f);
        const auto on = on_colour ? on_colour (theme) : theme.accent;
        const bool lit = getToggleState() && kind != Kind::tab;
        const bool framed = kind == Kind::framed || kind == Kind::toggle;
        if (kind == Kind::tab && getToggleState())
        {
            g.setColour (on.withAlpha (0.25f));
            g.fillRoundedRectangle (area, 4.0f);
        }
        else if (framed || over)
        {
            const auto idle = down ? theme.hairline : theme.raised;
            g.setColour (lit ? on : idle);
            g.fillRoundedRectangle (area, 4.0f);
        }
        if (framed || hasKeyboardFocus (false))
        {
            auto outline = lit ? on : theme.hairline;
            if (over) outline = theme.dim;
            g.setColour (hasKeyboardFocus (false) ? theme.accent : outline);
            g.drawRoundedRectangle (area, 4.0f, 1.0f);
        }
        g.setFont (look.font (12.0f, lit));
        auto place = justified == juce::Justification::centred ? getLocalBounds() : getLocalBounds().reduced (4, 0);
        if (has_dot && ! lit)
        {
            g.setColour (isEnabled() ? on : theme.dim.withAlpha (0.5f));
            g.fillEllipse (place.removeFromLeft (28).toFloat().withSizeKeepingCentre (8.0f, 8.0f));
            place.removeFromRight (8);
        }
        g.setColour (textColour (theme, lit, over, on));
        g.drawText (getButtonText(), place, justified, true);
    }

private:
    juce::Colour textColour (const Theme& theme, bool lit, bool over, juce::Colour fill) const
    {
        if (! isEnabled()) return theme.dim.withAlpha (0.5f);
        if (kind == Kind::framed || (kind == Kind::tab && getToggleState())) return theme.text;
        if (has_dot && ! lit) return theme.text;
        if (lit) return fill.getPerceivedBrightness() > 0.5f ? juce::Colour (0xff14171b) : juce::Colours::white;
        return over ? theme.text : theme.dim;
    }

    Kind kind;
    bool has_dot = false;
    juce::Justification justified = juce::Justification::centred;
    std::function<juce::Colour (const Theme&)> on_colour;
};

}   // namespace tactus::host
