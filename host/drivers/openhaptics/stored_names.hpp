// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <system_error>

namespace tactus::host::openhaptics
{

/// The names that the setup of the maker has stored, sorted. Its versions keep them in different folders.
inline std::set<std::string> storedNames()
{
    namespace fs = std::filesystem;
    std::set<std::string> all;
    const char *own = std::getenv ("GTDD_HOME"), *set = std::getenv ("HOME"), *home = set != nullptr ? set : "";
    for (const auto& folder : { fs::path (own != nullptr ? own : ""), fs::path ("/usr/share/3DSystems"), fs::path (home) / ".3dsystems",
                                fs::path ("/opt/geomagic_touch_device_driver") })
    {
        std::error_code failed;
        for (fs::directory_iterator at (folder / "config", failed), end; ! failed && at != end; at.increment (failed))
            if (at->path().extension() == ".config") all.insert (at->path().stem().string());
    }
    return all;
}

}   // namespace tactus::host::openhaptics
