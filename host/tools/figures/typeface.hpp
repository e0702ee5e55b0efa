// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// The built-in typeface. [main thread] Use it only while a juce::ScopedJuceInitialiser_GUI exists, and release it before that ends.
juce::Typeface::Ptr regularTypeface();
juce::Typeface::Ptr boldTypeface();

}   // namespace tactus::host
