// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// The typeface that is built in. [main thread], while a juce::ScopedJuceInitialiser_GUI lives; let go of it before.
juce::Typeface::Ptr regularTypeface();
juce::Typeface::Ptr boldTypeface();

}   // namespace tactus::host
