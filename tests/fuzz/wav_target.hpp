// SPDX-License-Identifier: MIT
#pragma once

#include "whole_clip.hpp"
#include "whole_error.hpp"

#include <host/base/assets/file_assets.hpp>
#include <tactus/text/budget.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

namespace tactus::fuzz
{

/// Reads the bytes as a recording, and as the clip of waves that signal.clip plays. Either each is whole, or reading reports an error. Aborts
/// otherwise.
inline void tryWav (std::string_view bytes)
{
    const auto file = std::filesystem::temp_directory_path() / ("tactus_fuzz_" + std::to_string (::getpid()) + ".wav");
    std::ofstream (file, std::ios::binary) << bytes;
    beginReading();
    host::FileAssets assets;
    if (const auto signal = assets.signal (file.string()); ! signal)
        checkWhole (signal.error());
    else
    {
        if ((*signal)->channels.empty() || ! ((*signal)->rate_hz > 0.0)) std::abort();
        for (const auto& channel : (*signal)->channels)
            if (channel.empty() || channel.size() != (*signal)->channels[0].size()) std::abort();
    }
    if (const auto grid = assets.table (file.string()); ! grid)
        checkWhole (grid.error());
    else
        tryWholeClip (clipOf (**grid).clip);
    std::filesystem::remove (file);
}

}   // namespace tactus::fuzz
