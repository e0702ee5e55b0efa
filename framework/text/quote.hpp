// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tactus
{

/// Quotes text that a user wrote, for use in a message: in single quotes, and cut if it is long. Everything that is not printable
/// UTF-8 is escaped, so that a broken file cannot break the message about it.
std::string quote (std::string_view);

/// Quotes the path of a file, whole: the name of a file is at its end, and a message must name the file. Escaped like quote.
std::string quotePath (const std::filesystem::path&);

/// Escapes what could disturb a terminal: control characters, characters that change the direction of writing or are invisible, and
/// bytes that are not UTF-8. Line ends stay.
std::string printable (std::string_view);

/// A name from a file, a device or another program, for a status line, a window title or an OSC answer: in one line, escaped like
/// printable, and cut at 200 characters.
std::string printableName (std::string_view);

}   // namespace tactus
