// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace tactus::host
{

/// Puts a text where other programs find it too; where there is no display, at least this one does.
void copyToClipboard (const std::string&);
std::string textFromClipboard();

}   // namespace tactus::host
