// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/assets.hpp>

#include <set>
#include <string>

namespace tactus
{

/// Forwards requests to other Assets, and lists the requested files. [main thread]
class AssetList final : public Assets
{
public:
    explicit AssetList (Assets* from) : assets (from) {}

    Loaded<Signal> signal (const std::string& path) override { return note (path).signal (path); }
    Loaded<Grid> image (const std::string& path) override { return note (path).image (path); }
    Loaded<Grid> table (const std::string& path) override { return note (path).table (path); }
    Loaded<Mesh> mesh (const std::string& path) override { return note (path).mesh (path); }

    /// The files requested since the list was last cleared.
    std::set<std::string> paths;

private:
    Assets& note (const std::string& path)
    {
        paths.insert (path);
        return *assets;
    }

    Assets* assets;
};

}   // namespace tactus
