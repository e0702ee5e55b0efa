// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/tools/fitting/fitting.hpp>

#include <memory>
#include <optional>
#include <thread>

namespace tactus::host
{

/// A fit that runs on its own thread. [main thread]
class FitJob
{
public:
    FitJob() = default;
    ~FitJob() { cancel(); }

    /// Cancels the previous fit, and starts a new one.
    void start (FitKind, std::shared_ptr<const Table>, std::string file, FitSettings);

    /// Asks the thread to end, without waiting for it. The result is discarded.
    void cancel();

    bool isRunning() const noexcept { return work != nullptr; }
    double share() const noexcept { return work ? work->course.share.load() : 0.0; }   ///< 0 to 1

    /// Takes the result. Empty while the fit runs, and after the result was taken.
    std::optional<Result<FittedGraph>> take();

private:
    struct Work
    {
        FitCourse course;
        std::optional<Result<FittedGraph>> result;   // valid once `done` is set
        std::atomic<bool> done { false };
    };

    void forgetFinished();

    std::shared_ptr<Work> work;
    std::vector<std::pair<std::shared_ptr<Work>, std::jthread>> threads;   // the current one last; earlier ones are still ending
};

}   // namespace tactus::host
