// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/graph/graph.hpp>
#include <host/platform/file_lock.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// A document as it is kept in case the program does not end well.
struct Kept
{
    std::filesystem::path file, preset;   ///< where it is saved; what it is a copy of. Empty: nowhere, nothing
    bool changed = false;                 ///< it has what its file does not have
    double at_s = 0.0;                    ///< when it was kept, in s since 1970
    std::string graph;                    ///< as text of a graph file
};

std::string writeKept (const Kept&);

/// What a text holds, or why that cannot be told.
struct ReadKept
{
    Kept kept;
    std::string problem;
};
ReadKept readKept (const std::string& text);

/// The graph of a kept document, with the files that it refers to. Its messages as of loadGraph.
struct RestoredGraph
{
    graph::Graph graph;
    std::string problem;   ///< why it cannot be restored
};
RestoredGraph restore (const Kept&);

/// The folder of one run of the program, with what is to be left behind if it does not end well. Other runs leave it alone
/// as long as this one lives. [main thread]
class Session
{
public:
    /// `problem()` says why nothing can be kept, if so.
    explicit Session (const std::filesystem::path& home);

    const std::string& problem() const noexcept { return wrong; }
    const std::filesystem::path& folder() const noexcept { return own; }

    /// Returns why it could not be kept, if so.
    std::optional<std::string> keep (const Kept&);

    /// A graph begins to run, or is changed while it does: if the program ends now, that may be why.
    void noteTrial();
    void noteTrialIsOver();   ///< it ran well for a while, or ended
    bool isTrial() const noexcept { return trial; }

    void end();   ///< all is well, or was decided: nothing is left behind

private:
    std::filesystem::path own;
    std::optional<FileLock> lock;
    std::string wrong;
    bool trial = false;
};

/// What a run left behind that did not end well. While this lives, no other run gets it.
class Leftover
{
public:
    const Kept& kept() const noexcept { return what; }
    const std::string& problem() const noexcept { return wrong; }   ///< why it cannot be read
    bool endedInTrial() const noexcept { return in_trial; }         ///< soon after the graph was started or changed
    const std::filesystem::path& folder() const noexcept { return own; }

    void discard();

private:
    friend std::vector<Leftover> leftoversIn (const std::filesystem::path&);

    std::filesystem::path own;
    std::optional<FileLock> lock;
    Kept what;
    std::string wrong;
    bool in_trial = false;
};

/// Of all runs that are no more, the latest first. What nobody would miss, since nothing was changed and nothing began to
/// run, is cleared away. [main thread]
std::vector<Leftover> leftoversIn (const std::filesystem::path& home);

/// What a person is asked about a leftover.
struct RecoveryQuestion
{
    std::string title, text;
    bool can_recover = true;
    bool safe_first = false;   ///< better not run it at once
};
RecoveryQuestion questionAbout (const Leftover&, double now_s);

}   // namespace tactus::host
