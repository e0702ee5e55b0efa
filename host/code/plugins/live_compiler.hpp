// SPDX-License-Identifier: MIT
#pragma once

#include "live_source.hpp"

#include <host/base/platform/background_program.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// The system's compiler, which works in the background on one thing at a time. It writes into a temporary folder, which the
/// destructor removes. [main thread]
///
/// The headers that every plugin includes are compiled once, as a precompiled header: that saves half of each later compilation of a
/// small node. With -O3, a tick costs what it costs compiled in; -O1 would save a tenth of the compilation.
class LiveCompiler
{
public:
    /// The work ahead: edits of code that is watched, at low priority and with a precompiled header; or one compilation that somebody waits for, with neither.
    enum class Work
    {
        edits,
        once
    };

    explicit LiveCompiler (Work w = Work::edits) : work (w) {}
    ~LiveCompiler();
    LiveCompiler (const LiveCompiler&) = delete;
    LiveCompiler& operator= (const LiveCompiler&) = delete;

    /// The result of a compilation.
    struct Output
    {
        std::filesystem::path plugin;              ///< the shared object, if there are no errors
        std::vector<std::filesystem::path> read;   ///< the files that the compiler has read, without those of the system
        Messages messages;
    };

    /// Starts to make the precompiled header, so that the first edit need not wait for it. Ids: live/no_compiler, live/no_folder,
    /// output/unwritable.
    Result<> prepareFor (const LiveSource&);

    /// Starts to compile; drops what is being compiled. Ids: live/foreign, live/no_compiler, live/no_headers, live/no_node,
    /// output/unwritable.
    Result<> start (const LiveSource&);

    /// The result of the compilation, returned only once; empty while the compiler works, or if it has nothing to do. Ids: live/compile.
    std::optional<Output> finished();

private:
    Result<> needFolder (const LiveSource&);
    Result<> compile();
    Result<> run (const std::vector<std::string>& command);
    Result<std::vector<std::string>> commandFor (const LiveSource&);
    std::vector<std::string> commonFlags (const LiveSource&) const;
    std::vector<std::filesystem::path> filesRead() const;
    std::filesystem::path commonHeader() const { return folder / "common.hpp"; }

    const Work work;
    std::filesystem::path folder;   // empty until something is compiled
    LiveSource source;
    std::unique_ptr<BackgroundProgram> program;
    bool precompiles = false;     // `program` is making the precompiled header
    bool compiles_next = false;   // after the precompiled header, `source` is compiled
    std::string precompiled_by;   // the compiler that was started for the precompiled header
    int count = 0;                // plugins compiled so far: each is a new file, because the system does not load a file twice
};

}   // namespace tactus::host
