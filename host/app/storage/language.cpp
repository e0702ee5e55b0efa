// SPDX-License-Identifier: GPL-3.0-or-later
#include "language.hpp"
#include "settings.hpp"

#include <tactus/file/text_file.hpp>

#include <algorithm>

namespace tactus::host
{

namespace fs = std::filesystem;

namespace
{
juce::LocalisedStrings read (const fs::path& file) { return { juce::File (file.string()), false }; }
}   // namespace

std::vector<std::pair<std::string, juce::String>> translationsIn (const fs::path& home)
{
    std::vector<std::pair<std::string, juce::String>> all;
    if (home.empty()) return all;
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator (home / "text", failed))
    {
        const auto code = entry.path().stem().string();
        if (! entry.is_regular_file (failed) || entry.path().extension() != ".txt" || code == english || ! isLanguage (code)) continue;
        const auto name = read (entry.path()).getLanguageName();
        all.emplace_back (code, name.isEmpty() ? juce::String (code) : name);
    }
    std::ranges::sort (all);
    return all;
}

fs::path translationFor (const std::string& language, const fs::path& home)
{
    if (home.empty()) return {};
    std::vector<std::string> codes { language };
    if (language.empty())
    {
        const auto of_system = juce::SystemStats::getDisplayLanguage();
        codes = { of_system.toStdString(), of_system.upToFirstOccurrenceOf ("-", false, false).toStdString() };
    }
    std::error_code failed;
    for (const auto& code : codes)
        if (const auto file = home / "text" / (code + ".txt"); isLanguage (code) && code != english && fs::is_regular_file (file, failed)) return file;
    return {};
}

void useTranslation (const fs::path& file)
{
    juce::LocalisedStrings::setCurrentMappings (file.empty() ? nullptr : std::make_unique<juce::LocalisedStrings> (read (file)).release());
}

std::string languageSetIn (const fs::path& home)
{
    const auto text = readTextFile (home / "settings.json");
    return text ? readSettings (*text).settings.language : std::string();
}

}   // namespace tactus::host
