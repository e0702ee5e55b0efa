// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_gui_basics/juce_gui_basics.h>

namespace tactus::host
{

/// A button for the left mouse button. JUCE's buttons take a right or middle click for a click.
class Button : public juce::Button
{
public:
    using juce::Button::Button;

    void mouseDown (const juce::MouseEvent& e) override
    {
        if (e.mods.isLeftButtonDown() && ! e.mods.isPopupMenu()) juce::Button::mouseDown (e);
    }
    void mouseDrag (const juce::MouseEvent& e) override
    {
        if (isDown()) juce::Button::mouseDrag (e);
    }
};

}   // namespace tactus::host
