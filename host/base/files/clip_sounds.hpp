// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/file/clips/clip_file.hpp>

#include <filesystem>

namespace tactus::host
{

/// The path of a recording that a clip file names: a .wav below the folder of the clip. The clip may come from a stranger, so neither the file nor a folder on
/// the way is a link or begins with a dot. Error: clip/sound, whose text is a part of a sentence. [any thread]
[[nodiscard]] Result<std::filesystem::path> soundBeside (const std::filesystem::path& clip, const std::string& path);

/// Reads such recordings.
readers::ReadSound soundsBeside (const std::filesystem::path& clip);

}   // namespace tactus::host
