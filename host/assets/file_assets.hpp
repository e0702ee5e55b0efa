// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/kit/assets.hpp>

#include <cstdint>
#include <filesystem>
#include <map>

namespace tactus::host
{

/// Reads files. A file is not read again while its content is in use and it has not changed on disk. [main thread]
///
/// Nodes may rely on this: all numbers are finite, signals and grids are not empty, all channels of a signal have the
/// same length, and the triangles of a mesh refer to its points. Files that exceed a budget are refused
/// (framework/text/budget.hpp).
class FileAssets final : public Assets
{
public:
    Loaded<Signal> signal (const std::string& path) override;
    Loaded<Grid> image (const std::string& path) override;
    Loaded<Grid> table (const std::string& path) override;
    Loaded<Mesh> mesh (const std::string& path) override;

private:
    template <typename T>
    struct Kept
    {
        std::filesystem::file_time_type written;
        std::uintmax_t size;
        std::weak_ptr<const T> content;
    };

    template <typename T>
    using Cache = std::map<std::string, Kept<T>>;

    template <typename T, typename Read>
    static Loaded<T> load (Cache<T>&, const std::string& path, Read);

    Cache<Signal> signals;
    Cache<Grid> images, tables;
    Cache<Mesh> meshes;
};

}   // namespace tactus::host
