// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/text/message.hpp>

#include <string>

namespace tactus::host
{

/// A message as the window shows it: "text; remedy".
inline std::string messageText (const Message& m)
{
    return m.remedy.empty() ? m.text : m.text + "; " + m.remedy;
}

}   // namespace tactus::host
