// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/assets.hpp>

#include <set>
#include <string>

namespace tactus::host
{

/// Assets that note which files were asked for. [main thread]
class NotedAssets final : public Assets
{
public:
    explicit NotedAssets (Assets& from) : assets (from) {}

    Loaded<Signal> signal (const std::string& path) override { return note (path).signal (path); }
    Loaded<Grid> image (const std::string& path) override { return note (path).image (path); }
    Loaded<Grid> table (const std::string& path) override { return note (path).table (path); }
    Loaded<Mesh> mesh (const std::string& path) override { return note (path).mesh (path); }

    /// Since it was last emptied.
    std::set<std::string> paths;

private:
    Assets& note (const std::string& path)
    {
        paths.insert (path);
        return assets;
    }

    Assets& assets;
};

}   // namespace tactus::host
