// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph_argument.hpp"

#include "report.hpp"

#include <host/base/files/preset_pack.hpp>
#include <host/base/platform/preset_folder.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/quote.hpp>

#include <filesystem>
#include <system_error>
#include <vector>

namespace tactus::host
{

namespace fs = std::filesystem;

std::string graphArgument (const std::string& given)
{
    if (isPresetPack (given)) return orFail (unpackPreset (given)).string();
    auto file = graphFile (given);
    const fs::path path (given);
    std::error_code failed;
    if (file != given || given.empty() || path.has_parent_path() || path.has_extension() || fs::exists (path, failed)) return file;

    std::vector<std::string> presets;
    for (const auto& entry : fs::directory_iterator (presetFolder(), failed))
        if (entry.path().extension() == ".json") presets.push_back (entry.path().stem().string());
    const auto meant = closestMatch (given, std::vector<std::string_view> (presets.begin(), presets.end()));
    fail (Message::error ("file/unreadable", given, "there is no file and no preset with this name",
                          meant.empty() ? "check the name; graphs/README.md lists the presets" : "did you mean " + quote (meant) + "?"));
}

}   // namespace tactus::host
