// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Recorded stems as files: one channel, loops, rates and scales, PCM with dither, clips, and the list of all.

#include "stem_plan.hpp"

#include <tactus/text/result.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace tactus::host
{

/// Recorded samples, each channel with as many frames.
struct RecordedStems
{
    std::vector<Stem>& stems;   ///< changed as the files need it
    std::size_t frames;
    double rate_hz;
    const std::vector<ShadowMixer>& mixers;
};

/// See Stems::write().
Result<WrittenStems> writeStems (RecordedStems, const StemOptions&, const std::filesystem::path& folder, const std::string& name);

}   // namespace tactus::host
