// SPDX-License-Identifier: MIT
#pragma once

#include "recording.hpp"

#include <host/base/files/wav.hpp>

#include <algorithm>
#include <cctype>

namespace tactus::host
{

/// Reads a table, or the samples of a WAV. This is in a header, so that the library of fits needs no reader of WAVs. [any thread]
/// Errors: those of readTable and readWav.
inline Result<Table> readRecordingOrWav (const std::filesystem::path& file)
{
    auto extension = file.extension().string();
    std::ranges::transform (extension, extension.begin(), [] (unsigned char c) { return static_cast<char> (std::tolower (c)); });
    if (extension != ".wav") return readRecording (file);
    const auto signal = readWav (file);
    if (! signal) return signal.error();
    return tableOf (*signal);
}

}   // namespace tactus::host
