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

std::string textFromClipboard() { return isThereADisplay() ? juce::SystemClipboard::getTextFromClipboard().toStdString() : latest(); }

}   // namespace tactus::host
