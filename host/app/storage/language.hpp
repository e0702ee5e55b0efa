// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <juce_core/juce_core.h>

namespace tactus::host
{

/// The language that the texts in the sources are in.
inline constexpr auto english = "en";

/// The translations in the folder `text` of a settings folder: the name of each file without .txt, such as "de", and the language that the
/// file says it is in. Sorted by name. [main thread]
std::vector<std::pair<std::string, juce::String>> translationsIn (const std::filesystem::path& home);

/// The file with the translation for a language; empty if there is none, as for English. Without a language: that of the system, so
/// de-AT.txt or else de.txt. [main thread]
std::filesystem::path translationFor (const std::string& language, const std::filesystem::path& home);

/// From now on, TRANS returns the texts of this file; those that it lacks stay in English. With an empty path, all are in English. A window
/// keeps the texts that it has, so this belongs before the window is made. [main thread]
void useTranslation (const std::filesystem::path& file);

/// The language in the settings file of a folder, as Settings::language. [main thread]
std::string languageSetIn (const std::filesystem::path& home);

}   // namespace tactus::host
