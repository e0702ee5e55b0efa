// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/file/assets/file_assets.hpp>
#include <tactus/node/setting.hpp>

namespace tactus::host
{

/// Reads all files that settings can name. The framework reads tables and meshes; this adds pictures (PNG, JPEG) and recordings (WAV).
/// [main thread]
class FileAssets final : public readers::FileAssets
{
protected:
    Result<Signal> readSignal (const std::string& path) override;
    Result<Grid> readImage (std::string_view bytes, std::string_view path) override;
};

/// The names of files of kind signal, image, table, or surface (a mesh), as in "*.wav". [any thread]
const char* patternsOf (SettingSheet::Kind);

}   // namespace tactus::host
