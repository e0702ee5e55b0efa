// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/threads/async_query.hpp>
#include <tactus/plan/journal.hpp>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace tactus
{

/// Answers async queries of a live run on its own thread.
class QueryThread final : public QueryService
{
public:
    QueryThread();
    ~QueryThread() override;

    void add (AsyncQueryBase&) override;
    void remove (AsyncQueryBase&) override;   // waits until no query from this asker is being answered
    bool isLate (bool ready) noexcept override;

    /// Reports late answers to a journal, which must exist until the last tick. [main thread, before ticking]
    void report (Journal& to) noexcept { journal = &to; }

    /// The number of late answers, for all askers together. [any thread]
    std::uint64_t lateTicks() const noexcept { return late_ticks.load (std::memory_order_relaxed); }

private:
    void run();
    std::unique_lock<std::mutex> turn();

    std::mutex guard;   // protects the askers
    std::condition_variable woken;
    std::atomic<int> waiting = 0;
    std::vector<AsyncQueryBase*> askers;
    std::atomic<bool> stopping = false;
    std::atomic<std::uint64_t> late_ticks = 0;

    // Used by the tick thread.
    Journal* journal = nullptr;
    std::uint64_t asked = 0;   // how many times isLate was called

    std::thread thread;   // declared last: it uses the other members
};

}   // namespace tactus
