// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/plugins/live_plugins.hpp>
#include <tactus/node/catalogue.hpp>

#include <chrono>
#include <string>
#include <vector>

namespace tactus::host
{

/// Live C++ in the window: adds new versions of plugins to catalogue(). The panels point into the datasheets of types, so all versions
/// stay loaded until the window closes. [main thread]
class LiveNodes
{
public:
    explicit LiveNodes (std::vector<LiveSource>);

    /// True if catalogue() has new types now: everything that shows or runs nodes must be refreshed. Call this many times a second.
    bool attend();

    /// What is wrong with the code that was saved last; each text begins with file and line.
    const Messages& messages() const noexcept { return said; }

    /// The version that attend() has added: "rough_wood.hpp: in use 3.1 s after it was saved".
    std::string latest() const;

private:
    LivePlugins plugins;
    std::vector<Catalogue> shown;   // earlier catalogues, which keep the earlier versions of types loaded
    Messages said;
    std::filesystem::path file;
    double took_s = 0.0;
    std::chrono::steady_clock::time_point looked {};
};

}   // namespace tactus::host
