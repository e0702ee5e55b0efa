// SPDX-License-Identifier: MIT
#pragma once

#include "fused_code.hpp"
#include "fusion_cache.hpp"

#include <host/base/platform/background_program.hpp>
#include <tactus/text/result.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tactus::host
{

/// Compiles fused code in the background, one graph at a time: with LLVM or with the system's compiler, as the language of the code asks. Keeps
/// what it has compiled in a cache, by content. [main thread]
class FusionCompiler
{
public:
    struct Options
    {
        std::string compiler {};             ///< empty: CXX from the environment, or else `c++`
        std::string llvm {};                 ///< the program tactus-fuse-llvm; empty: TACTUS_FUSE_LLVM from the environment, or else next to this program
        std::string optimisation = "-O3";    ///< of the compiler; the bits are the same for each
        std::filesystem::path cache {};      ///< the folder of the cache; empty: nothing is kept
        unsigned cpu_seconds = 120;          ///< after which the system ends the compiler or LLVM
        std::vector<std::string> flags {};   ///< of the compiler, in addition
    };

    explicit FusionCompiler (Options);
    ~FusionCompiler();
    FusionCompiler (const FusionCompiler&) = delete;
    FusionCompiler& operator= (const FusionCompiler&) = delete;

    /// The user's cache for fused code: see FusionCache::usualFolder.
    static std::filesystem::path usualCache() { return FusionCache::usualFolder(); }

    /// The reason why nothing is kept: see FusionCache::trouble.
    const std::optional<Message>& cacheTrouble() const noexcept { return cache.trouble(); }

    /// Starts to compile. Stops a compilation that is still running. Ids: fuse/no_compiler, fuse/no_llvm, fuse/no_folder, output/unwritable.
    Result<> start (const FusedCode&);

    /// Stops the compilation, if one is running.
    void stop() { program.reset(); }

    /// The shared object, returned only once; empty while the compiler is running, or if there is nothing to compile. Ids: fuse/compile,
    /// fuse/no_llvm.
    std::optional<Result<std::filesystem::path>> finished();

private:
    std::string keyOf (const FusedCode&) const;
    std::vector<std::string> flags() const;
    std::vector<std::string> commandFor (const FusedCode&) const;
    std::filesystem::path sourceOf (const FusedCode&) const;
    Result<> write (const FusedCode&);
    Result<> writeHeaders (const FusedCode&);

    const Options options;
    const FusionCache cache;
    std::filesystem::path folder;    // empty until something is compiled
    std::set<std::string> written;   // headers and bitcode that are in the folder
    std::unique_ptr<BackgroundProgram> program;
    std::filesystem::path ready;                               // from the cache
    FusedCode::Language language = FusedCode::Language::cpp;   // of what is compiled now
    std::string key;
    int count = 0;   // objects compiled so far: the system does not load a file twice
};

}   // namespace tactus::host
