// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/assets.hpp>

#include <cstdint>
#include <filesystem>
#include <map>

namespace tactus::host
{

/// Reads files, each once as long as somebody has its content and it does not change on disk. [main thread]
///
/// Nodes may rely on it that all numbers are finite, that signals and grids are not empty, that all channels of a signal
/// are of one length, and that the triangles of a mesh name points of it. No file is taken that is over 64 MB.
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
