// SPDX-License-Identifier: GPL-3.0-or-later
#include "clipboard.hpp"

#include <juce_gui_basics/juce_gui_basics.h>

namespace tactus::host
{

namespace
{
std::string& latest()
{
    static std::string text;
    return text;
}

bool isThereADisplay() { return ! juce::Desktop::getInstance().getDisplays().displays.isEmpty(); }
}   // namespace

void copyToClipboard (const std::string& text)
{
    latest() = text;
    if (isThereADisplay()) juce::SystemClipboard::copyTextToClipboard (juce::String::fromUTF8 (text.c_str()));
}

/// Where the system keeps no text, such as without a display, what was copied here is still there.
std::string textFromClipboard()
{
    const auto text = isThereADisplay() ? juce::SystemClipboard::getTextFromClipboard().toStdString() : std::string();
    return text.empty() ? latest() : text;
}

}   // namespace tactus::host
