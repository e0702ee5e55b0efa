// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "button.hpp"
#include "look.hpp"

namespace tactus::host
{

/// A text button. The button that Return activates is filled with the accent colour.
class PlainButton final : public Button
{
public:
    explicit PlainButton (const juce::String& label) : Button (label) { setMouseClickGrabsKeyboardFocus (false); }

    void setFirst (bool f)
    {
        is_first = f;
        repaint();
    }

    int widthFor() const { return juce::roundToInt (lookOf (*this).font (13.0f, true).getStringWidthFloat (getButtonText())) + 32; }

    void paintButton (juce::Graphics& g, bool over, bool down) override
    {
        const auto& look = lookOf (*this);
        const auto& theme = look.theme();
        const auto area = getLocalBounds().toFloat().reduced (0.5f);
        const float lit = over ? 1.1f : 1.0f;
        const auto plain = over ? theme.hairline : theme.raised;
        g.setColour (is_first ? theme.accent.withMultipliedBrightness (down ? 0.85f : lit) : plain);
        g.fillRoundedRectangle (area, 4.0f);
        const bool has_keyboard = hasKeyboardFocus (false);
        if (! is_first || has_keyboard)
        {
            const auto ring = is_first ? theme.text : theme.accent;
            g.setColour (has_keyboard ? ring : theme.hairline);
            g.drawRoundedRectangle (area, 4.0f, has_keyboard ? 2.0f : 1.0f);
        }
        const auto on_accent = theme.is_dark ? theme.canvas : juce::Colours::white;
        g.setColour (is_first ? on_accent : theme.text);
        g.setFont (look.font (13.0f, true));
        g.drawText (getButtonText(), getLocalBounds(), juce::Justification::centred, false);
    }

private:
    bool is_first = false;
};

/// A button with a line drawing.
class IconButton final : public Button
{
public:
    IconButton (const juce::String& title, juce::Path lines) : Button (title), picture (std::move (lines))
    {
        setWantsKeyboardFocus (false);
        setTooltip (title);
    }

    void paintButton (juce::Graphics& g, bool over, bool) override
    {
        const auto& theme = themeOf (*this);
        if (over && isEnabled())
        {
            g.setColour (theme.raised);
            g.fillRoundedRectangle (getLocalBounds().toFloat(), 4.0f);
        }
        g.setColour (isEnabled() ? theme.text : theme.hairline);
        const auto centred = juce::AffineTransform::translation (getLocalBounds().toFloat().getCentre() - juce::Point<float> (8.0f, 8.0f));
        g.strokePath (picture, juce::PathStrokeType (1.5f, juce::PathStrokeType::curved, juce::PathStrokeType::rounded), centred);
    }

private:
    juce::Path picture;   // in a 16 by 16 square
};

}   // namespace tactus::host
