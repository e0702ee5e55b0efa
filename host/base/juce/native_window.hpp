// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_gui_basics/juce_gui_basics.h>

#include <optional>

namespace tactus::host
{

/// Sets how often a second JUCE looks whether a native window must be painted again. JUCE itself does so as often as the display shows a picture,
/// also while nothing changes, and sets this rate again when the window is moved. Empty: that rate. Does nothing on systems where JUCE has no such
/// timer, and without a display. [message thread]
void setRepaintRate (juce::ComponentPeer&, std::optional<int> per_second);

/// From now on, each key event says which of Shift, Ctrl and Alt are held. JUCE itself counts their presses and releases, but a release does not
/// reach the window while another program has the keyboard: after Alt+Tab back to the same window, or after Alt+F4 and a question, Alt counts as held
/// until the mouse moves, and no key does what it should. Call it once. Does nothing on systems without X11. [message thread]
void takeHeldKeysFromEvents();

/// Paints what has changed in all windows. On Windows, JUCE paints when the display has shown a picture, and never where no display says so: on some
/// remote desktops and virtual machines, and in wine. Call it at each refresh. Does nothing on other systems. [message thread]
void paintWithoutDisplay();

}   // namespace tactus::host
