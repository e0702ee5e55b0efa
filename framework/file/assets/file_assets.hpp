// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/assets.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace tactus::readers
{

/// Reads the files that settings name: tables, clips and meshes. Pictures and recordings need libraries that the framework does not have, so
/// a class derived from this one decodes them. A file is not read again while its content is in use and it has not changed on disk.
/// [main thread]
///
/// Nodes may rely on this: all numbers are finite, signals and grids are not empty, all channels of a signal have the
/// same length, and the triangles of a mesh refer to its points. Files that exceed a budget are refused
/// (framework/text/budget.hpp).
///
/// Error ids: asset/unreadable, asset/signal, asset/no_decoder, and those of readGrid, readClip, readMesh and the derived class.
class FileAssets : public Assets
{
public:
    Loaded<Signal> signal (const std::string& path) override;
    Loaded<Grid> image (const std::string& path) override;
    Loaded<Grid> table (const std::string& path) override;   ///< numbers, or the rows of a clip or recording (tactus/kit/signal/clip.hpp)
    Loaded<Mesh> mesh (const std::string& path) override;

    /// Takes over the files that others have read. Each stays known for as long as it is in use.
    void adopt (const FileAssets&);

protected:
    /// Decodes a recording. This class refuses it: asset/no_decoder. The file exists and is not too large; its size has already been
    /// charged.
    virtual Result<Signal> readSignal (const std::string& path);

    /// Decodes the bytes of a picture, whose path is for messages. This class refuses it: asset/no_decoder.
    virtual Result<Grid> readImage (std::string_view bytes, std::string_view path);

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

    Result<Grid> readWave (const std::string& path);

    template <typename T, typename Read>
    static Loaded<T> load (Cache<T>&, const std::string& path, Read);

    Cache<Signal> signals;
    Cache<Grid> images, tables;
    Cache<Mesh> meshes;
};

/// The reason why nodes cannot use a recording; empty if they can. Id: asset/signal. [any thread]
std::optional<Message> whyUnusable (const Signal&, const std::string& path);

/// Charges a decoded asset to the budget `reading`. False if it exceeds the budget. [main thread]
bool charge (const Signal&) noexcept;
bool charge (const Grid&) noexcept;
bool charge (const Mesh&) noexcept;

/// The error for an asset with which the files of a graph exceed the budget `reading`: asset/unreadable.
Message overReading (const std::string& path);

}   // namespace tactus::readers
