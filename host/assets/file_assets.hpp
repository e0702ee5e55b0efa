// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/file/assets/file_assets.hpp>

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

}   // namespace tactus::host
