// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/base/assets/file_assets.hpp>
#include <tactus/run/log/stretch.hpp>

#include <catch2/catch.hpp>

#include <filesystem>
#include <string>

namespace tactus::host::test
{

/// The lowest place of the hand in the log of a take.
inline Vec3 lowest (const std::filesystem::path& log, const std::string& program)
{
    FileAssets assets;
    Messages warnings;
    const auto played = readStretch (log.string(), { .role = "stylus", .assets = &assets, .program = program }, warnings);
    REQUIRE (played);
    REQUIRE (played->ticks() > 0);
    Vec3 place (0.0, 0.0, 1.0);
    for (auto row = played->movement.begin(); row != played->movement.end(); row += static_cast<std::ptrdiff_t> (played->columns.size()))
        if (row[3] < place.z()) place = Vec3 (row[1], row[2], row[3]);
    return place;
}

}   // namespace tactus::host::test
