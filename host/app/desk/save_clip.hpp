// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "desk.hpp"

#include <tactus/file/clips/clip_file.hpp>

namespace tactus::host
{

/// Writes a clip, and says what the file does not hold; the user can then use it as a layer. `notes` are losses that came before. A recorded force has
/// the gain in N with which it is as strong again. False if the clip was not written. [main thread]
bool saveClip (const Desk&, const Clip&, Messages notes, std::optional<double> gain, const std::filesystem::path& to,
               const readers::ClipFile* source = nullptr);

/// Asks where to save a clip file in another format.
void saveClipAs (const Desk&, const std::filesystem::path& file);

}   // namespace tactus::host
