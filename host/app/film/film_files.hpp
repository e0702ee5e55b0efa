// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "film_picture.hpp"

#include <tactus/text/result.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

struct FilmFiles
{
    std::vector<std::filesystem::path> files {};
    Messages notes {};   ///< for example, that no video was written because ffmpeg is not installed
};

/// Writes the files of a film into one folder: NAME.png, an animated PNG with 25 pictures per second; NAME.wav, the force on the tool as a
/// sound for loudspeakers (Listening); NAME.csv, with columns t, x, y, z (m) and force.x, force.y, force.z (N); and NAME.webm, a video with
/// the sound, if `ffmpeg` is installed. Each file is written completely or not at all. `progress` receives the fraction that is done. If it
/// returns false while the pictures are drawn, no file is written; later, only the video is left out. Files of these names are replaced.
///
/// Error ids: film/empty, film/stopped, film/picture, output/unwritable. [any thread; no other thread may use the picture during the call]
Result<FilmFiles> writeFilm (const Film&, FilmPicture&, const std::filesystem::path& named, const std::function<bool (double)>& progress,
                             const std::string& ffmpeg = "ffmpeg");

/// The file of a film with this extension: what is after a dot in the name stays, unless it is an extension of a film's files.
std::filesystem::path filmFile (const std::filesystem::path& named, const std::string& extension);

/// The first file of a film of this name, other than its .png, that exists already.
std::optional<std::filesystem::path> fileInTheWay (const std::filesystem::path& named);

/// The time for which each picture is shown, in ms.
inline constexpr int film_picture_ms = 40;

/// By how much of 255 a colour may be off. The eye does not notice it, and the smooth shading of a surface no longer changes all over in
/// each picture.
inline constexpr int film_tolerance = 3;

}   // namespace tactus::host
