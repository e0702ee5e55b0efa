// SPDX-License-Identifier: MIT
#pragma once

#include "live_compiler.hpp"

#include <host/base/files/file_watch.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/text/message.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// Live C++: watches the code of node plugins. Code that was saved is compiled in the background and loaded. The caller adds the types
/// to its catalogue, and compiles its graph again. [main thread]
class LivePlugins
{
public:
    explicit LivePlugins (std::vector<LiveSource>);

    /// A new version of a plugin, or why there is none.
    struct RebuiltPlugin
    {
        std::filesystem::path file;                 ///< the code: LiveSource::file
        std::vector<NodeType> types {};             ///< empty if there are errors
        Messages messages {};                       ///< ids: those of LiveCompiler and PluginLibrary
        std::filesystem::file_time_type saved {};   ///< when the code was saved

        double secondsSinceSaved() const;
    };

    /// The new version of a plugin since the last look, or why there is none; empty if nothing has happened. Code that differs from what it was and
    /// stays the same from one look to the next counts as saved. Call this some thirty times a second.
    std::optional<RebuiltPlugin> poll();

    /// Starts to make the precompiled header, in the background. Ids: those of LiveCompiler::prepareFor.
    Result<> prepare();

    /// Compiles the sources that are only a header, because no plugin contains their nodes yet, and waits until that is done. To be
    /// called when a program starts. Returns the result for each header. Ends early once `stop_wanted` returns true.
    std::vector<RebuiltPlugin> buildHeaders (const std::function<bool()>& stop_wanted = {});

    std::size_t count() const noexcept { return all.size(); }

private:
    struct WatchedSource
    {
        explicit WatchedSource (LiveSource s) : source (std::move (s)), files (source.watched()) {}

        LiveSource source;
        FileWatch files;
        std::filesystem::file_time_type saved {};
        bool waits = false;   ///< true: to be compiled as soon as the compiler is free
    };

    std::optional<RebuiltPlugin> startNext();
    std::optional<RebuiltPlugin> load (LiveCompiler::Output);

    std::vector<WatchedSource> all;
    LiveCompiler compiler;
    std::optional<std::size_t> compiled;   // index of the source that the compiler works on
    std::filesystem::file_time_type started {};
};

/// Compiles the header of a node into the file `plugin`, which need not exist, and waits until that is done. Ids: those of liveHeader and LiveCompiler,
/// output/unwritable. [main thread]
Messages compileHeader (const std::filesystem::path& header, const std::filesystem::path& plugin);

/// Loads a version of a plugin. `layout`: see PluginLibrary::types.
LivePlugins::RebuiltPlugin loadLive (const std::filesystem::path& plugin, const std::filesystem::path& code, const std::string& layout);

}   // namespace tactus::host
