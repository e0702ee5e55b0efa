// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "button.hpp"
#include "look.hpp"

namespace tactus::host
{

/// A small button with a word on it, which stays lit while it is on.
class LabelButton final : public Button
{
public:
    LabelButton (const juce::String& label, const juce::String& tip) : Button (label)
    {
        setTooltip (tip);
        setMouseClickGrabsKeyboardFocus (false);   // after a click, keys still belong to what had the focus
    }

    int wantedWidth() const { return static_cast<int> (std::ceil (lookOf (*this).font (12.0f).getStringWidthFloat (getButtonText()))) + 14; }

    void paintButton (juce::Graphics& g, bool over, bool) override
    {
        const auto& look = lookOf (*this);
        const auto& theme = look.theme();
        const auto area = getLocalBounds().toFloat().reduced (0.5f);
        const bool is_on = getToggleState();
        g.setColour (is_on ? theme.accent.withAlpha (0.22f) : theme.raised.withAlpha (over ? 1.0f : 0.75f));
        g.fillRoundedRectangle (area, 4.0f);
        if (hasKeyboardFocus (false))
        {
            g.setColour (theme.accent);
            g.drawRoundedRectangle (area, 4.0f, 1.0f);
        }
        g.setColour (is_on ? theme.accent : theme.text);
        g.setFont (look.font (12.0f));
        g.drawText (getButtonText(), getLocalBounds(), juce::Justification::centred, false);
    }
};

}   // namespace tactus::host
