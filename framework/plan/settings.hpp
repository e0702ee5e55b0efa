// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/setting.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/result.hpp>

#include <string>

namespace tactus::plan
{

/// The loader of the files that settings name, and their folder.
struct Files
{
    Assets* assets = nullptr;   ///< null: a setting that names a file is refused
    std::string folder;         ///< base of relative paths
};

/// Reads a setting of the given kind, and checks it against the units and ranges of its sheet. An error has neither a location
/// nor a remedy; instead, `where` is extended to the pointer of the part at fault.
Result<SettingValue> readSetting (const Json&, const SettingSheet&, const Files&, std::string& where);

}   // namespace tactus::plan
