// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/canvas/canvas.hpp>
#include <tactus/text/result.hpp>

#include <filesystem>

namespace tactus::host
{

/// Saves all of the patch on a canvas as a picture: as SVG or PDF if the name ends so, else as PNG with two pixels for each unit of the canvas, or fewer
/// if the patch is very large. Shows nothing of the run. Ids: canvas/picture, and those of createFile. [message thread]
Result<> savePicture (const Canvas&, const std::filesystem::path&);

}   // namespace tactus::host
