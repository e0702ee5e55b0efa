// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "window_parts.hpp"

#include <host/app/run/asset_load.hpp>
#include <host/app/run/job.hpp>

#include <chrono>

namespace tactus::host
{

/// The wait for the large files of a graph that is being opened. The window stays responsive, and the open graph goes on, until they are there; the user can
/// cancel. [main thread]
class AssetWait
{
public:
    explicit AssetWait (WindowParts& p) : parts (p) {}

    /// Loads the files of a graph with this name, and then calls `show`.
    void begin (const graph::Graph&, const juce::String& name, std::function<void()> show);

    bool isRunning() const noexcept { return load.isRunning(); }
    void poll();   ///< call many times a second

    /// Forgets the files unless they are those of the open graph.
    void otherGraph();

private:
    WindowParts& parts;
    Job<std::shared_ptr<const LoadedAssets>> load;
    std::chrono::steady_clock::time_point began;
    juce::String title;                           // of the question that offers to cancel
    std::function<void()> after;                  // shows the graph whose files are being loaded
    std::shared_ptr<const LoadedAssets> loaded;   // kept while this graph is open, so that an edit need not load them again
    const void* loaded_for = nullptr;             // identity of the graph
};

}   // namespace tactus::host
