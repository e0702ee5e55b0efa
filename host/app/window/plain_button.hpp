// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>

namespace tactus::host
{

/// A word that can be clicked. The one that Return takes is filled with the accent.
class PlainButton final : public juce::Button
{
public:
    explicit PlainButton (const juce::String& words) : Button (words) { setWantsKeyboardFocus (false); }

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
        g.setColour (is_first ? theme.accent.withMultipliedBrightness (down ? 0.85f : over ? 1.1f
                                                                                           : 1.0f)
                     : over   ? theme.hairline
                              : theme.raised);
        g.fillRoundedRectangle (area, 4.0f);
        if (! is_first)
        {
            g.setColour (theme.hairline);
            g.drawRoundedRectangle (area, 4.0f, 1.0f);
        }
        g.setColour (! is_first ? theme.text : theme.is_dark ? theme.canvas
                                                             : juce::Colours::white);
        g.setFont (look.font (13.0f, true));
        g.drawText (getButtonText(), getLocalBounds(), juce::Justification::centred, false);
    }

private:
    bool is_first = false;
};

/// A small picture that can be clicked, in lines.
class IconButton final : public juce::Button
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
        g.strokePath (picture, juce::PathStrokeType (1.5f, juce::PathStrokeType::curved, juce::PathStrokeType::rounded), juce::AffineTransform::translation (static_cast<float> (getWidth()) / 2 - 8.0f, static_cast<float> (getHeight()) / 2 - 8.0f));
    }

private:
    juce::Path picture;   // in a square of 16
};

}   // namespace tactus::host
