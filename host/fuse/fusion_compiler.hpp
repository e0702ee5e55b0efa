// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fused_code.hpp"

#include <host/platform/background_program.hpp>
#include <tactus/text/result.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tactus::host
{

/// Compiles fused code with the system's compiler in the background, one graph at a time. Keeps what it has compiled in a cache,
/// by content. [main thread]
class FusionCompiler
{
public:
    struct Options
    {
        std::string compiler {};             ///< empty: CXX from the environment, or else `c++`
        std::string optimisation = "-O3";    ///< the bits are the same for each
        std::filesystem::path cache {};      ///< the folder of the cache; empty: nothing is kept
        unsigned cpu_seconds = 120;          ///< after which the system ends the compiler
        std::vector<std::string> flags {};   ///< in addition
    };

    explicit FusionCompiler (Options);
    ~FusionCompiler();
    FusionCompiler (const FusionCompiler&) = delete;
    FusionCompiler& operator= (const FusionCompiler&) = delete;

    /// The user's cache for fused code: in TACTUS_HOME, XDG_CACHE_HOME or ~/.cache. Empty if the user's home is unknown.
    static std::filesystem::path usualCache();

    /// Starts to compile. Stops a compilation that is still running. Ids: fuse/no_compiler, fuse/no_folder, output/unwritable.
    Result<> start (const FusedCode&);

    /// Stops the compilation, if one is running.
    void stop() { program.reset(); }

    /// The shared object, returned only once; empty while the compiler is running, or if there is nothing to compile. Ids: fuse/compile.
    std::optional<Result<std::filesystem::path>> finished();

private:
    std::string keyOf (const FusedCode&) const;
    std::vector<std::string> flagsFor (const std::string& compiler) const;
    Result<> write (const FusedCode&);
    std::filesystem::path keep (const std::filesystem::path& object);

    const Options options;
    std::filesystem::path folder;    // empty until something is compiled
    std::set<std::string> written;   // headers that are in the folder
    std::unique_ptr<BackgroundProgram> program;
    std::filesystem::path ready;   // from the cache
    std::string key;
    int count = 0;   // objects compiled so far: the system does not load a file twice
};

}   // namespace tactus::host
