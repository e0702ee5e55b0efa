// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/text/translated.hpp>
#include <tactus/text/message.hpp>

#include <string>

namespace tactus::host
{

/// A message as the window shows it, in the language of the user: "text; remedy".
inline std::string messageText (const Message& m)
{
    return (translated (m.text) + (m.remedy.empty() ? juce::String() : "; " + translated (m.remedy))).toStdString();
}

}   // namespace tactus::host
