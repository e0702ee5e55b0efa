// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/tools/stems/stems.hpp>
#include <tactus/graph/graph.hpp>
#include <tactus/node/catalogue.hpp>

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace tactus::host
{

/// Renders the stems of a graph on a thread of its own, as `tactus render --stems` does: with the simulated devices of the graph, for the length of the
/// longest path of a hand, or 10 s. [main thread]
class StemJob
{
public:
    StemJob() = default;
    ~StemJob() { cancel(); }

    /// Cancels the previous job, and starts a new one.
    void start (graph::Graph, const Catalogue&, std::filesystem::path folder, const StemOptions&);

    /// Asks the thread to end, without waiting for it. Nothing is written, unless the run is over and the files are being written.
    void cancel();

    bool isRunning() const noexcept { return work != nullptr; }
    double share() const noexcept { return work ? work->share.load() : 0.0; }   ///< 0 to 1

    /// Takes the result. Empty while the job runs, and once the result has been taken. Ids: those of Stems, LiveSession and run/cannot.
    std::optional<Result<WrittenStems>> take();

private:
    struct Work
    {
        std::atomic<double> share { 0.0 };
        std::atomic<bool> is_cancelled { false }, is_done { false };
        std::optional<Result<WrittenStems>> result;   // valid once `is_done` is set
    };

    static Result<WrittenStems> render (const graph::Graph&, const Catalogue&, const std::filesystem::path&, const StemOptions&, Work&);
    void forgetFinished();

    std::shared_ptr<Work> work;
    std::vector<std::pair<std::shared_ptr<Work>, std::jthread>> threads;   // the current one last; earlier ones are still ending
};

}   // namespace tactus::host
