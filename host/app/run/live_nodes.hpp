// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/code/plugins/live_plugins.hpp>
#include <tactus/node/catalogue.hpp>

#include <chrono>
#include <string>
#include <vector>

namespace tactus::host
{

/// Live C++ in the window: adds new versions of plugins to catalogue(). [main thread]
class LiveNodes
{
public:
    explicit LiveNodes (std::vector<LiveSource>);

    /// True if catalogue() has new types now: everything that shows or runs nodes must be renewed, and then forget() called. Call this
    /// many times a second.
    bool poll();

    /// Nothing in the window points into the earlier types any longer. A version is unloaded as soon as no plan uses it.
    void forget() { earlier = {}; }

    /// The errors in the code that was saved last; each text begins with file and line.
    const Messages& messages() const noexcept { return said; }

    /// The version that poll() has added: "rough_wood.hpp: in use 3.1 s after it was saved".
    std::string latest() const;

private:
    LivePlugins plugins;
    Catalogue earlier;   // keeps the types that panels point into, until forget()
    Messages said;
    std::filesystem::path file;
    double took_s = 0.0;
    std::chrono::steady_clock::time_point looked {};
};

}   // namespace tactus::host
