// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_gui_basics/juce_gui_basics.h>

#include <vector>

namespace tactus::host::test
{

/// A piece of a line of text on the screen.
struct SeenText
{
    juce::String text;
    juce::Rectangle<float> place;   ///< in the pixels of the component that was read
    bool is_cut = false;            ///< a part lies outside of the area that could be painted
};

/// Paints a component with all that is in it, and reads the texts from what it paints.
std::vector<SeenText> readTexts (juce::Component&);

bool showsText (juce::Component&, const juce::String& text);   ///< true if a piece that is read is this text
bool mentions (juce::Component&, const juce::String& words);   ///< true if a piece that is read contains these words

/// The pairs of texts that overlap in an area, each as "A | B".
juce::StringArray overlaps (const std::vector<SeenText>&, juce::Rectangle<float> area);

/// The texts in an area of which a part could not be painted.
juce::StringArray cutOff (const std::vector<SeenText>&, juce::Rectangle<float> area);

}   // namespace tactus::host::test
