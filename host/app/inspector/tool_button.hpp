// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>

#include <functional>

namespace tactus::host
{

/// A small button with a word or sign on it. One that is a switch is filled while it is on.
class ToolButton final : public juce::Button
{
public:
    enum class Kind
    {
        plain,   ///< a word without a frame, that lights up under the pointer
        framed,
        toggle,   ///< shows its state; the owner sets it
        tab       ///< one of several names, of which one is chosen
    };

    ToolButton (const juce::String& words, Kind k, const juce::String& tooltip = {}) : juce::Button (words), kind (k)
    {
        setTooltip (tooltip);
        setMouseClickGrabsKeyboardFocus (false);   // a click leaves the keys to the canvas
        setMouseCursor (juce::MouseCursor::PointingHandCursor);
    }

    /// What it is filled with while on; the accent, unless said.
    void setColour (std::function<juce::Colour (const Theme&)> c) { on_colour = std::move (c); }

    void setJustification (juce::Justification j) { justified = j; }

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
            g.setColour (lit ? on : down ? theme.hairline
                                         : theme.raised);
            g.fillRoundedRectangle (area, 4.0f);
        }
        if (framed || hasKeyboardFocus (false))
        {
            g.setColour (hasKeyboardFocus (false) ? theme.accent : over ? theme.dim
                                                               : lit    ? on
                                                                        : theme.hairline);
            g.drawRoundedRectangle (area, 4.0f, 1.0f);
        }
        g.setFont (look.font (12.0f, lit));
        const auto ink = lit ? (on.getPerceivedBrightness() > 0.5f ? juce::Colour (0xff14171b) : juce::Colours::white) : over ? theme.text
                                                                                                                              : theme.dim;
        const bool bright = kind == Kind::framed || (kind == Kind::tab && getToggleState());
        g.setColour (isEnabled() ? (bright ? theme.text : ink) : theme.dim.withAlpha (0.5f));
        g.drawText (getButtonText(), justified == juce::Justification::centred ? getLocalBounds() : getLocalBounds().reduced (4, 0), justified, true);
    }

private:
    Kind kind;
    juce::Justification justified = juce::Justification::centred;
    std::function<juce::Colour (const Theme&)> on_colour;
};

}   // namespace tactus::host
