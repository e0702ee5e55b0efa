// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_gui_basics/juce_gui_basics.h>

namespace tactus::host
{

/// Gives a component the keyboard focus if it is on screen.
inline void takeFocus (juce::Component& c)
{
    if (c.isShowing()) c.grabKeyboardFocus();
}

}   // namespace tactus::host
