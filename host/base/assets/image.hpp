// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/assets.hpp>
#include <tactus/text/result.hpp>

#include <string_view>

namespace tactus::host
{

/// Reads the bytes of a PNG or JPEG as grey values from 0 (black) to 1 (white), top row first, at the full
/// precision of a PNG (up to 16 bits). Colours become their luminance (ITU-R BT.601, as in JPEG) as stored in the file: gamma
/// is not undone, so a height map keeps the values as drawn. Transparency is ignored.
///
/// Uses libspng and TurboJPEG because both are designed for untrusted files: stb_image 2.27, the version in Debian,
/// writes past the end of an array on a damaged JPEG.
///
/// Errors: image/unreadable, image/too_large.
[[nodiscard]] Result<Grid> readImage (std::string_view bytes, std::string_view name);

}   // namespace tactus::host
