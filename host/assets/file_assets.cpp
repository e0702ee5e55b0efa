// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_assets.hpp"
#include "image.hpp"

#include <host/io/wav.hpp>

namespace tactus::host
{

Result<Signal> FileAssets::readSignal (const std::string& path) { return readWav (path); }
Result<Grid> FileAssets::readImage (std::string_view bytes, std::string_view path) { return host::readImage (bytes, path); }

}   // namespace tactus::host
