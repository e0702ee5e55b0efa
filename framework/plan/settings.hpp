// SPDX-License-Identifier: MIT
#pragma once

#include <framework/json.hpp>
#include <framework/setting.hpp>

#include <string>
#include <variant>

namespace tactus::plan
{

/// Where the files that settings name are found.
struct Files
{
    Assets* assets = nullptr;   ///< none: a setting that names a file is refused
    std::string folder;         ///< relative paths start here
};

/// Reads a setting of the given kind, with the units and ranges of its sheet checked; or says what is wrong.
/// `where` is extended to the pointer of the culprit.
std::variant<SettingValue, std::string> readSetting (const Json&, const SettingSheet&, const Files&, std::string& where);

}   // namespace tactus::plan
