// SPDX-License-Identifier: MIT
#pragma once

#include "tactus.h"

#include <tactus/file/assets/file_assets.hpp>

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace tactus::capi
{

/// A function of the caller that supplies assets.
struct AssetReader
{
    tactus_asset_reader read = nullptr;
    void* context = nullptr;
};

/// The assets that the caller supplies; all others are read from files. Numbers that are the same as before give the same object, so that
/// a contact with a mesh survives an edit of the graph. [main thread]
class CallerAssets : public readers::FileAssets
{
public:
    explicit CallerAssets (AssetReader r) : reader (r) {}

    Loaded<Signal> signal (const std::string& path) override;
    Loaded<Grid> image (const std::string& path) override;
    Loaded<Grid> table (const std::string& path) override;
    Loaded<Mesh> mesh (const std::string& path) override;

private:
    template <typename T>
    using Cache = std::map<std::string, std::weak_ptr<const T>>;

    /// The asset that the caller supplies. Empty if the file should be read.
    template <typename T, typename Take>
    std::optional<Loaded<T>> supplied (Cache<T>&, tactus_asset_kind, const std::string& path, Take) const;

    AssetReader reader;
    Cache<Signal> signals;
    Cache<Grid> images, tables;
    Cache<Mesh> meshes;
};

}   // namespace tactus::capi
