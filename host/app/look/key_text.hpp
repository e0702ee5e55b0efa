// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_gui_basics/juce_gui_basics.h>

namespace tactus::host
{

/// A key as the window writes it everywhere, such as Ctrl+S or Shift+Esc, from the way that juce::KeyPress describes it.
juce::String keyText (const juce::String& described);

}   // namespace tactus::host
