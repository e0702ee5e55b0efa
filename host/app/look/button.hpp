// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_gui_basics/juce_gui_basics.h>

namespace tactus::host
{

/// A button for the left mouse button. JUCE's buttons take a right or middle click for a click.
template <typename Kind>
class LeftButton : public Kind
{
public:
    using Kind::Kind;

    void mouseDown (const juce::MouseEvent& e) override
    {
        if (e.mods.isLeftButtonDown() && ! e.mods.isPopupMenu()) Kind::mouseDown (e);
    }
    void mouseDrag (const juce::MouseEvent& e) override
    {
        if (this->isDown()) Kind::mouseDrag (e);
    }
};

class Button : public LeftButton<juce::Button>
{
public:
    using LeftButton::LeftButton;
};

using TextButton = LeftButton<juce::TextButton>;

}   // namespace tactus::host
