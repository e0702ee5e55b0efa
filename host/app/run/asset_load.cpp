// SPDX-License-Identifier: GPL-3.0-or-later
#include "asset_load.hpp"

#include <host/app/text/file_path.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>

#include <filesystem>
#include <set>
#include <string>
#include <system_error>

namespace tactus::host
{

namespace
{
void addFiles (const Json& value, const std::string& folder, std::set<std::string>& files)
{
    if (value.is_string())
        files.insert (resolved (value.asString(), folder));
    else if (value.is_structured())
        for (const auto& inner : value)
            addFiles (inner, folder, files);
}

void addFiles (const graph::Graph& g, std::set<std::string>& files, std::set<const graph::Graph*>& seen)
{
    if (! seen.insert (&g).second) return;
    const auto add = [&] (const graph::Patch& patch) {
        for (const auto& node : patch.nodes)
            addFiles (node.settings, g.folder, files);
    };
    add (g.root);
    for (const auto& [name, patch] : g.graphs)
        add (patch);
    for (const auto& [name, included] : g.files)
        if (included) addFiles (*included, files, seen);
}
}   // namespace

double assetBytes (const graph::Graph& g)
{
    std::set<std::string> files;
    std::set<const graph::Graph*> seen;
    addFiles (g, files, seen);
    double sum = 0.0;
    for (const auto& file : files)
    {
        std::error_code failed;
        if (! std::filesystem::is_regular_file (file, failed)) continue;
        const auto size = std::filesystem::file_size (file, failed);
        if (! failed) sum += static_cast<double> (size);
    }
    return sum;
}

std::shared_ptr<const LoadedAssets> loadAssets (const graph::Graph& g, const Catalogue& catalogue)
{
    auto loaded = std::make_shared<LoadedAssets>();
    loaded->compiled = compile (g, catalogue, { .assets = &loaded->assets, .services = { .nearest_triangle = nearestByBoxes } });
    return loaded;
}

}   // namespace tactus::host
