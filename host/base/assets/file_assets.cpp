// SPDX-License-Identifier: MIT
#include "file_assets.hpp"
#include "image.hpp"

#include <host/base/files/wav.hpp>

namespace tactus::host
{

Result<Signal> FileAssets::readSignal (const std::string& path) { return readWav (path); }
Result<Grid> FileAssets::readImage (std::string_view bytes, std::string_view path) { return host::readImage (bytes, path); }

const char* patternsOf (SettingSheet::Kind kind)
{
    switch (kind)
    {
    case SettingSheet::Kind::signal:
        return "*.wav";
    case SettingSheet::Kind::image:
        return "*.png;*.jpg;*.jpeg";
    case SettingSheet::Kind::table:
        return "*.csv;*.haptic;*.ahap;*.hjif;*.json;*.wav";   // a clip is a table for a node
    default:
        return "*.obj;*.off;*.ply;*.stl";
    }
}

}   // namespace tactus::host
