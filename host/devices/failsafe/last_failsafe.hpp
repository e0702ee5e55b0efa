// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace tactus::host
{

/// The file in which the guardian notes when and why it last brought devices to rest. It is in homeFolder(), which is made if it does not exist.
/// Empty if that fails; then nothing is noted. [any thread]
std::filesystem::path lastFailsafeFile();

/// The note of the guardian, in one line of printable text: "2026-11-24T21:05:07Z the program did not respond". Empty if it never had to act, or if
/// the note cannot be read. [any thread]
std::string lastFailsafe();

}   // namespace tactus::host
