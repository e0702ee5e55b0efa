// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/assets.hpp>
#include <host/io/error.hpp>

#include <tl/expected.hpp>

#include <string_view>

namespace tactus::host
{

/// Reads the bytes of a PNG or JPEG: grey from 0, black, to 1, white, top row first, a PNG in all of its up to 16 bits.
/// Of colours the luminance (ITU-R BT.601, as in JPEG) of the values as they stand in the file: no gamma is undone, so
/// that a height map is what it was drawn as. Transparency is passed over.
///
/// libspng and TurboJPEG, because both are made for files from strangers: stb_image 2.27, which Debian has, writes beyond
/// an array on a damaged JPEG.
///
/// Ids of errors: image/unreadable, image/too_large.
[[nodiscard]] tl::expected<Grid, Error> readImage (std::string_view bytes, std::string_view name);

}   // namespace tactus::host
