// SPDX-License-Identifier: MIT
#include "clip_sounds.hpp"
#include "wav.hpp"

#include <algorithm>

namespace tactus::host
{

namespace fs = std::filesystem;

Result<fs::path> soundBeside (const fs::path& clip, const std::string& path)
{
    const auto refuse = [&] (const char* why) { return Message::error ("clip/sound", path, why, "put a .wav into the folder of the clip"); };
    const fs::path name (path);
    if (name.empty() || name.is_absolute() || path.find ('\0') != path.npos) return refuse ("its path does not lead below the folder of the clip");
    auto extension = name.extension().string();
    std::ranges::transform (extension, extension.begin(), [] (char c) { return c >= 'A' && c <= 'Z' ? static_cast<char> (c - 'A' + 'a') : c; });
    if (extension != ".wav") return refuse ("only .wav files are read");
    auto at = clip.parent_path();
    std::error_code ignored;
    for (auto part = name.begin(); part != name.end(); ++part)
    {
        if (part->string().starts_with ('.')) return refuse ("its path has a part that begins with a dot");
        at /= *part;
        const auto type = fs::symlink_status (at, ignored).type();
        if (type == fs::file_type::not_found || type == fs::file_type::none) return refuse ("there is no such file beside the clip");
        if (type == fs::file_type::symlink) return refuse ("its path leads through a link");
        if (type != (std::next (part) == name.end() ? fs::file_type::regular : fs::file_type::directory)) return refuse ("it is not a file");
    }
    return at;
}

readers::ReadSound soundsBeside (const fs::path& clip)
{
    return [clip] (const std::string& path) -> Result<Signal> {
        const auto file = soundBeside (clip, path);
        if (! file) return file.error();
        return readWav (*file);
    };
}

}   // namespace tactus::host
