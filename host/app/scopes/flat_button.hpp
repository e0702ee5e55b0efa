// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/button.hpp>
#include <host/app/look/look.hpp>

namespace tactus::host
{

/// A button whose frame appears only under the mouse. Shows a label, or a line drawing in a 14 by 14 square.
class FlatButton final : public Button
{
public:
    static constexpr int height = 24;

    explicit FlatButton (const juce::String& label) : Button (label) { setWantsKeyboardFocus (false); }
    FlatButton (const juce::String& name, juce::Path p) : FlatButton (name) { picture = std::move (p); }

    juce::Colour dot = juce::Colours::transparentBlack;   ///< the colour of a dot before the label
    bool is_wrong = false;                                ///< true: shown in the warning colour
    std::function<void()> onCross;                        ///< if set, there is a cross after the label

    int wantedWidth() const
    {
        if (! picture.isEmpty()) return height;
        const float dot_width = dot.isTransparent() ? 0.0f : 12.0f;
        const int width = static_cast<int> (std::ceil (lookOf (*this).font (12.0f).getStringWidthFloat (getButtonText()) + dot_width)) + 12;
        return std::max (height, width + (onCross ? cross_width : 0));
    }

    void mouseUp (const juce::MouseEvent& e) override
    {
        const bool is_on_cross = getLocalBounds().removeFromRight (cross_width).contains (e.getPosition());
        if (onCross && is_on_cross && e.mods.isLeftButtonDown()) onCross();
        Button::mouseUp (e);
    }

    void paintButton (juce::Graphics& g, bool over, bool down) override
    {
        const auto& look = lookOf (*this);
        const auto& theme = look.theme();
        auto area = getLocalBounds().toFloat();
        if (over || down || getToggleState())
        {
            g.setColour (getToggleState() ? theme.accent.withAlpha (0.2f) : theme.raised);
            g.fillRoundedRectangle (area.reduced (0.0f, 1.0f), 4.0f);
        }
        auto ink = over ? theme.text : theme.dim;
        if (getToggleState()) ink = theme.accent;
        if (is_wrong) ink = theme.warning;
        g.setColour (ink);
        if (! picture.isEmpty())
        {
            g.strokePath (picture, juce::PathStrokeType (1.4f), juce::AffineTransform::translation (area.getCentreX() - 7.0f, area.getCentreY() - 7.0f));
            return;
        }
        if (onCross)
        {
            const auto x = area.removeFromRight (static_cast<float> (cross_width)).withSizeKeepingCentre (6.0f, 6.0f);
            g.drawLine ({ x.getTopLeft(), x.getBottomRight() }, 1.4f);
            g.drawLine ({ x.getBottomLeft(), x.getTopRight() }, 1.4f);
        }
        area.reduce (6.0f, 0.0f);
        if (! dot.isTransparent())
        {
            g.setColour (dot);
            g.fillEllipse (area.removeFromLeft (12.0f).withSizeKeepingCentre (8.0f, 8.0f).translated (-2.0f, 0.0f));
            g.setColour (is_wrong ? theme.warning : theme.text);
        }
        g.setFont (look.font (12.0f));
        g.drawText (getButtonText(), area, juce::Justification::centredLeft, true);
    }

private:
    static constexpr int cross_width = 24;

    juce::Path picture;
};

}   // namespace tactus::host
