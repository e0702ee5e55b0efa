// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/text/json.hpp>
#include <tactus/text/result.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tactus::host
{

/// The settings that the window remembers between starts.
struct Settings
{
    static constexpr std::size_t most_recent = 12, most_recent_types = 6;

    bool light = false;
    double scale = 0.0;     ///< scale of the user interface; 0: automatic
    std::string language;   ///< "de" for the translation in text/de.txt, "en" for English; empty: the language of the system
    bool welcomed = false;
    bool toured = false;                         ///< the guided tour was taken or skipped
    bool scene = false;                          ///< the hand is shown in space, not from above
    double film_s = 10.0;                        ///< how much of the past a film shows
    bool fuse = false;                           ///< runs the graph as compiled code
    std::map<std::string, double> panels;        ///< each panel's share of the window, by name; 0: folded; absent: the usual size
    std::vector<std::filesystem::path> recent;   ///< the latest first
    std::vector<std::filesystem::path> favourites;
    std::map<std::string, std::filesystem::path> folders;   ///< in which a file was last chosen, by the patterns of its dialog
    std::filesystem::path recordings;                       ///< the folder of the latest recording that was fitted
    std::vector<std::string> recent_types;                  ///< node types that were added, the latest first
    Json others = Json::object();                           ///< keys of panels, and of other versions of Tactus

    void noteRecent (const std::filesystem::path&);
    void noteType (const std::string&);
    bool isFavourite (const std::filesystem::path&) const;
    void toggleFavourite (const std::filesystem::path&);
};

struct ReadSettings
{
    Settings settings;
    std::string problem;   ///< what is wrong with the text; the rest was read
};

ReadSettings readSettings (const std::string& text);
std::string writeSettings (const Settings&);

/// Reads the settings file in a folder. A damaged file is renamed to settings.json.broken. [main thread]
ReadSettings loadSettings (const std::filesystem::path& home);

/// Ids: those of writeTextFile. [main thread]
Result<> saveSettings (const Settings&, const std::filesystem::path& home);

/// True for what can be the name of a translation, such as "de" or "pt-BR".
bool isLanguage (const std::string&) noexcept;

/// The scale of the user interface on a display with this height in pixels, after the system's own scaling.
double automaticScale (int height) noexcept;

}   // namespace tactus::host
