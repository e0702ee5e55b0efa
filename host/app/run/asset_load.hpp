// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/base/assets/file_assets.hpp>
#include <tactus/graph/graph.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/plan/compile.hpp>

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace tactus::host
{

/// The size in bytes of the files that the settings of a graph, its subgraphs and the graphs that it includes name. [any thread]
double assetBytes (const graph::Graph&);

/// Reads the files of a graph on a thread of its own, and computes the data that its nodes need, so that the main thread only has to take them over.
/// [main thread]
class AssetLoad
{
public:
    /// The files, and a plan that uses them. They last as long as this object, or as other plans use them.
    struct Loaded
    {
        FileAssets assets;
        Compiled compiled;
    };

    AssetLoad() = default;
    ~AssetLoad() { cancel(); }

    /// Cancels the previous load, and starts a new one.
    void start (graph::Graph, const Catalogue&);

    /// Discards the result. The thread ends, and gives its memory back, once it has finished what it has begun.
    void cancel();

    bool isRunning() const noexcept { return work != nullptr; }
    double seconds() const noexcept;   ///< since the start

    /// Takes the result. Null while the load runs, and after the result was taken.
    std::shared_ptr<const Loaded> take();

private:
    struct Work
    {
        std::shared_ptr<Loaded> loaded = std::make_shared<Loaded>();
        std::atomic<bool> done { false };
    };

    void forgetFinished();

    std::shared_ptr<Work> work;
    std::chrono::steady_clock::time_point began;
    std::vector<std::pair<std::shared_ptr<Work>, std::jthread>> threads;   // the current one last; earlier ones are still ending
};

}   // namespace tactus::host
