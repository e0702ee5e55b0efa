// SPDX-License-Identifier: MIT
#pragma once

#include "setting_parts.hpp"
#include <tactus/plan/settings.hpp>

#include <filesystem>

namespace tactus::plan
{

/// Loads the file whose path the JSON holds. `kind` is the loader, such as `&Assets::mesh`.
template <typename T>
std::shared_ptr<const T> load (Assets::Loaded<T> (Assets::*kind) (const std::string&), const Json& json, const Files& files, const std::string& key)
{
    if (! json.is_string() || json.asString().empty()) throw Problem { "it must be the path of a file, relative to the folder of the graph", key };
    const auto& path = json.asString();
    if (files.assets == nullptr) throw Problem { "this program cannot read '" + path + "': it was built without file access", key };

    auto loaded = (files.assets->*kind) ((std::filesystem::path (files.folder) / path).string());
    if (! loaded) throw Problem { sentence (loaded.error()), key };
    return *loaded;
}

}   // namespace tactus::plan
