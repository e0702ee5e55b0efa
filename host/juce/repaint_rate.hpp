// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_gui_basics/juce_gui_basics.h>

#include <optional>

namespace tactus::host
{

/// How often a second JUCE looks whether a native window must be painted again. JUCE itself does so as often as the display shows a picture, also
/// while nothing changes, and sets this rate again when the window is moved. Empty: that rate. Does nothing on systems where JUCE has no such timer,
/// and without a display. [message thread]
void setRepaintRate (juce::ComponentPeer&, std::optional<int> per_second);

}   // namespace tactus::host
