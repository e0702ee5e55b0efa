// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>

namespace tactus::host
{

/// Shows a whole window in a theme, including JUCE's own file dialogs. [main thread]
void applyTheme (juce::Component& window, const Theme&);

/// Scales the user interface. 0: chosen from the height of the primary display. [main thread]
void applyScale (double);

}   // namespace tactus::host
