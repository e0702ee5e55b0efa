// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "material_picture.hpp"

#include <tactus/node/catalogue.hpp>

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

namespace tactus::host
{

/// The force of a graph over one cycle of its described gesture, computed offline by the same engine that runs it live, with the
/// devices it describes.
struct ForcePicture
{
    static constexpr double longest_s = 4.0;
    static constexpr std::size_t columns = 192;

    std::vector<float> peaks {};   ///< maximum per time column, in `unit`
    double peak = 0.0;             ///< the largest of `peaks`
    double seconds = 0.0;          ///< the time that the picture covers
    const char* unit = "N";        ///< "N m" if there is only torque
    MaterialPicture material {};   ///< the surface at the largest force
    std::string problem {};        ///< why there is no picture; empty if there is one
};

/// Takes up to several seconds for a large mesh. Stops early with a problem once `cancelled` is true. [any thread, one call at a time]
ForcePicture pictureOf (const std::filesystem::path& graph_file, const Catalogue&, const std::atomic<bool>& cancelled);

}   // namespace tactus::host
