// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "film_picture.hpp"

#include <tactus/text/result.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tactus::host
{

struct WrittenFilm
{
    std::vector<std::filesystem::path> files {};
    Messages notes {};   ///< such as that no video was written because ffmpeg is not installed
};

/// Writes a film next to one another: NAME.png, an animated PNG with 25 pictures per second; NAME.wav, the force on the tool as a sound for
/// loudspeakers (Listening); NAME.csv, with columns t, x, y, z (m) and force.x, force.y, force.z (N); and NAME.webm, a video with the
/// sound, if `ffmpeg` is installed. Each file appears as a whole or not at all. `progress` gets the part that is done, and returns
/// false to end the writing; then nothing is written.
///
/// Error ids: film/empty, film/stopped, film/picture, output/unwritable. [any thread, but the picture belongs to it meanwhile]
Result<WrittenFilm> writeFilm (const Film&, FilmPicture&, const std::filesystem::path& named, const std::function<bool (double)>& progress,
                               const std::string& ffmpeg = "ffmpeg");

/// How long each picture is shown, in ms.
inline constexpr int film_picture_ms = 40;

/// By how much of 255 a colour may be off. One does not see it, and the smooth shading of a surface no longer changes all over in each picture.
inline constexpr int film_tolerance = 3;

}   // namespace tactus::host
