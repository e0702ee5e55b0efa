// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace tactus
{

/// Quotes text that a user wrote, for use in a message: in single quotes, and cut if it is long. Everything that is not printable
/// UTF-8 is escaped, so that a broken file cannot break the message about it.
std::string quote (std::string_view);

/// Escapes what could disturb a terminal: control characters, characters that change the direction of writing or are invisible, and
/// bytes that are not UTF-8. Line ends stay.
std::string printable (std::string_view);

/// A name from a file, a device or another program, for a status line, a window title or an OSC answer: in one line, escaped like
/// printable, and cut at 200 characters.
std::string printableName (std::string_view);

}   // namespace tactus
