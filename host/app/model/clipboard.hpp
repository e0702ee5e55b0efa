// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace tactus::host
{

/// Copies text to the system clipboard. Without a display, or where the system keeps no text, only this program can paste it.
void copyToClipboard (const std::string&);
std::string textFromClipboard();

}   // namespace tactus::host
