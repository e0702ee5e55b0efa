// SPDX-License-Identifier: GPL-3.0-or-later
#include "asset_load.hpp"

#include <host/app/text/file_path.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/text/caught.hpp>

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

void AssetLoad::start (graph::Graph g, const Catalogue& catalogue)
{
    cancel();
    work = std::make_shared<Work>();
    began = std::chrono::steady_clock::now();
    threads.emplace_back (work, std::jthread ([own = work, loaded = work->loaded, g = std::move (g), &catalogue]() mutable {
                              auto compiled = caught ({}, [&] {
                                  return compile (g, catalogue, { .assets = &loaded->assets, .services = { .nearest_triangle = nearestByBoxes } });
                              });
                              if (compiled) loaded->compiled = std::move (*compiled);   // else the main thread will meet the same error, and report it
                              loaded.reset();                                           // frees the result if the load was cancelled
                              own->done = true;
                          }));
}

void AssetLoad::cancel()
{
    if (work) work->loaded.reset();   // the thread holds the last reference
    work.reset();
    forgetFinished();
}

double AssetLoad::seconds() const noexcept { return std::chrono::duration<double> (std::chrono::steady_clock::now() - began).count(); }

std::shared_ptr<const AssetLoad::Loaded> AssetLoad::take()
{
    if (! work || ! work->done) return nullptr;
    std::shared_ptr<const Loaded> loaded = std::move (work->loaded);
    work.reset();
    forgetFinished();
    return loaded;
}

void AssetLoad::forgetFinished()
{
    std::erase_if (threads, [] (const auto& t) { return t.first->done.load(); });
}

}   // namespace tactus::host
