// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/result.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace tactus
{

/// The reason why a file must not be opened for reading: it does not exist, or is a folder, a device, a socket or a named pipe. Opening a pipe waits
/// for its writer, and reading a device may never end. Empty for a regular file. Everything that reads files asks this first. [any thread]
std::string whyUnreadable (const std::filesystem::path&);

/// The content of a regular file, charged to the budgets `file` and `reading`. The error has neither a location nor, for
/// file/unreadable, a remedy, which depend on what the file is for. Errors: file/unreadable, file/too_large. [any thread]
Result<std::string> readFile (const std::filesystem::path&);

/// The content of a small file of the program; empty if it cannot be read. [main thread]
std::optional<std::string> readTextFile (const std::filesystem::path&);

/// Writes a file completely or not at all, and creates its folder. Error: output/unwritable. [main thread]
Result<> writeTextFile (const std::filesystem::path&, const std::string& text);

}   // namespace tactus
