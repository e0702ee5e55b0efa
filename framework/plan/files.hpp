// SPDX-License-Identifier: MIT
#pragma once

#include "setting_parts.hpp"
#include "settings.hpp"

#include <filesystem>

namespace tactus::plan
{

/// The file whose path the JSON gives, read as `kind`, as in `&Assets::mesh`.
template <typename T>
std::shared_ptr<const T> load (Assets::Loaded<T> (Assets::*kind) (const std::string&), const Json& json, const Files& files, const std::string& key)
{
    if (! json.is_string() || json.get_ref<const std::string&>().empty()) throw Problem { "it must be the path of a file, relative to the graph's", key };
    const auto& path = json.get_ref<const std::string&>();
    if (files.assets == nullptr) throw Problem { "this program cannot read '" + path + "': it was built without files", key };

    auto loaded = (files.assets->*kind) ((std::filesystem::path (files.folder) / path).string());
    if (const auto* why = std::get_if<std::string> (&loaded)) throw Problem { *why, key };
    return std::get<std::shared_ptr<const T>> (loaded);
}

}   // namespace tactus::plan
