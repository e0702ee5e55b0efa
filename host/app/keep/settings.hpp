// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/json.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// What the window remembers from one start to the next.
struct Settings
{
    static constexpr std::size_t most_recent = 12;

    bool light = false;
    double scale = 0.0;   ///< of everything on the screen; 0: as the display asks
    bool welcomed = false;
    std::map<std::string, int> panels;           ///< sizes of the panels by name, in pixels; 0: folded away
    std::vector<std::filesystem::path> recent;   ///< the latest first
    std::vector<std::filesystem::path> favourites;
    Json others = Json::object();   ///< what another Tactus wrote and this one does not know

    void noteRecent (const std::filesystem::path&);
    bool isFavourite (const std::filesystem::path&) const;
    void toggleFavourite (const std::filesystem::path&);
};

struct ReadSettings
{
    Settings settings;
    std::string problem;   ///< in what way the text is damaged; what could be read is there
};

ReadSettings readSettings (const std::string& text);
std::string writeSettings (const Settings&);

/// Those of a folder. A damaged file is set aside as settings.json.broken. [main thread]
ReadSettings loadSettings (const std::filesystem::path& home);

/// Returns why they could not be kept, if so. [main thread]
std::optional<std::string> saveSettings (const Settings&, const std::filesystem::path& home);

/// How large things should be on a display that is so many pixels high after the system's own scaling.
double automaticScale (int height) noexcept;

}   // namespace tactus::host
