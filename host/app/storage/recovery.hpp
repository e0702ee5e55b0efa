// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/file/file_lock.hpp>
#include <tactus/graph/graph.hpp>
#include <tactus/text/result.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// The open document, as autosaved in case the program crashes.
struct AutosavedDocument
{
    std::filesystem::path file, preset;   ///< the file it is saved in, and the preset it is a copy of; empty if none
    bool changed = false;                 ///< true if the document has changes that its file does not have
    double at_s = 0.0;                    ///< when it was autosaved, in s since 1970
    std::string graph;                    ///< text of a graph file
    std::filesystem::path folder {};      ///< base of the relative paths in it; empty: that of the file or preset
    bool by_pointer = false;              ///< true if the mouse moved the tool, so that nothing else does after the recovery
    std::string file_hash {};             ///< contentHash() of the file as it was last read or written; empty if none
    bool stopped = false;                 ///< true if the graph did not run, or a stop held its forces at zero
};

std::string writeAutosave (const AutosavedDocument&);

/// Parses an autosave. Id: recovery/damaged.
Result<AutosavedDocument> readAutosave (const std::string& text);

/// The graph of an autosaved document, with the files that it includes.
struct RestoredGraph
{
    graph::Graph graph;
    std::string problem;   ///< why the graph cannot be restored; empty if it can
};
RestoredGraph restore (const AutosavedDocument&);

/// The folder of one run of the program, which holds the autosave. It survives a crash, and is locked while the program runs, so
/// that other instances leave it alone. [main thread]
class RecoverySession
{
public:
    /// If nothing can be autosaved, problem() says why.
    explicit RecoverySession (const std::filesystem::path& home);

    const std::string& problem() const noexcept { return wrong; }
    const std::filesystem::path& folder() const noexcept { return own; }

    /// Ids: recovery/no_folder, and those of writeTextFile.
    Result<> autosave (const AutosavedDocument&);

    /// Call when a graph starts to run, or changes while it runs. If the program crashes during the trial, the graph may be the cause.
    void beginTrial();
    void endTrial();   ///< call when it has run well for a while, or was stopped
    bool inTrial() const noexcept { return trial; }

    void end();   ///< removes the folder; call it when the program closes normally

private:
    std::filesystem::path own;
    std::optional<FileLock> lock;
    std::string wrong;
    bool trial = false;
};

/// The folder that a crashed run of the program left behind. It is locked while this object lives, so that no other instance picks it up.
class CrashedSession
{
public:
    const AutosavedDocument& document() const noexcept { return saved; }
    const std::string& problem() const noexcept { return wrong; }   ///< why the document cannot be read
    bool endedInTrial() const noexcept { return in_trial; }         ///< true if it ended soon after the graph was started or changed
    const std::filesystem::path& folder() const noexcept { return own; }
    const std::vector<std::filesystem::path>& takes() const noexcept { return recorded; }   ///< the logs of the takes that were not saved

    void discard();

private:
    friend std::vector<CrashedSession> findCrashedSessions (const std::filesystem::path&);

    std::filesystem::path own;
    std::optional<FileLock> lock;
    AutosavedDocument saved;
    std::vector<std::filesystem::path> recorded;
    std::string wrong;
    bool in_trial = false;
};

/// All crashed sessions, the latest first. Removes those in which nothing was lost: nothing had changed, there was no take, and nothing had just
/// started to run. [main thread]
std::vector<CrashedSession> findCrashedSessions (const std::filesystem::path& home);

/// The question for the user about a crashed session.
struct RecoveryQuestion
{
    std::string title, text;
    bool can_recover = true;
    bool can_run = true;       ///< false: the graph was stopped, so it stays so
    bool safe_first = false;   ///< true: the first choice is to recover without running
};
RecoveryQuestion questionAbout (const CrashedSession&, double now_s);

}   // namespace tactus::host
