// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_gui_basics/juce_gui_basics.h>

namespace tactus::host
{

/// Converts the description of a key by juce::KeyPress to the form that all texts of the window use, such as Ctrl+S or Shift+Esc.
juce::String keyText (const juce::String& described);

}   // namespace tactus::host
