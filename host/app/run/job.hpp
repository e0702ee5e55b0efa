// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/text/caught.hpp>

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace tactus::host
{

/// Lets the main thread stop a job and read its progress.
struct JobCourse
{
    std::atomic<bool> cancelled { false };
    std::atomic<double> share { 0.0 };   ///< the progress, from 0 to 1
};

/// Work on a thread of its own, which results in a T. [main thread]
template <typename T, typename Course = JobCourse>
class Job
{
public:
    Job() = default;
    ~Job() { cancel(); }   // and waits until the threads have ended

    /// Cancels the previous work, and starts a new one. The thread calls `act` with the course, and it returns a T or Result<T>. What it throws becomes an
    /// error at the place `where`.
    template <typename Act>
    void start (std::string where, Act act)
    {
        cancel();
        work = std::make_shared<Work>();
        threads.emplace_back (work, std::jthread ([own = work, where = std::move (where), act = std::move (act)]() mutable {
                                  own->result.emplace (caught (std::move (where), [&] { return act (own->course); }));
                                  own->is_done = true;
                                  if (own->is_discarded) own->result.reset();   // it was cancelled: free the result here, not in the window
                              }));
    }

    /// Asks the thread to end. Its result says so.
    void stop()
    {
        if (work) work->course.cancelled = true;
    }

    /// Asks the thread to end, without waiting for it. The result is discarded.
    void cancel()
    {
        stop();
        if (work) work->is_discarded = true;
        work.reset();
        forgetFinished();
    }

    bool isRunning() const noexcept { return work != nullptr; }
    double share() const noexcept { return work ? work->course.share.load() : 0.0; }   ///< 0 to 1

    /// Takes the result. Empty while the thread works, and after the result was taken.
    std::optional<Result<T>> take()
    {
        if (! work || ! work->is_done) return {};
        auto result = std::move (work->result);
        work.reset();
        forgetFinished();
        return result;
    }

private:
    struct Work
    {
        Course course;
        std::optional<Result<T>> result;   // valid once `is_done` is set
        std::atomic<bool> is_done { false }, is_discarded { false };
    };

    void forgetFinished()
    {
        std::erase_if (threads, [] (const auto& t) { return t.first->is_done.load(); });
    }

    std::shared_ptr<Work> work;
    std::vector<std::pair<std::shared_ptr<Work>, std::jthread>> threads;   // the current one last; earlier ones are still ending
};

}   // namespace tactus::host
