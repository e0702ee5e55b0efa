// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/catalogue.hpp>

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

namespace tactus::host
{

/// How strong a graph is over one round of the gesture it describes: computed offline, by the engine that runs it live, on
/// the devices it describes.
struct ForcePicture
{
    static constexpr double longest_s = 4.0;
    static constexpr std::size_t columns = 192;

    std::vector<float> peaks;   ///< the greatest in each column of time, in `unit`
    double peak = 0.0;          ///< of all
    double seconds = 0.0;       ///< how long it is
    const char* unit = "N";     ///< or N m, of what only turns
    std::string problem;        ///< why there is none
};

/// Takes up to seconds for a large mesh; ends early, with a problem, once `cancelled`. [any thread, one call at a time]
ForcePicture pictureOf (const std::filesystem::path& graph_file, const Catalogue&, const std::atomic<bool>& cancelled);

}   // namespace tactus::host
