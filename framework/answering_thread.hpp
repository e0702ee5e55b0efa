// SPDX-License-Identifier: MIT
#pragma once

#include "journal.hpp"
#include "slow_question.hpp"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace tactus
{

/// Answers slow questions live, on a thread of its own.
class AnsweringThread final : public SlowAnswers
{
public:
    AnsweringThread();
    ~AnsweringThread() override;

    void add (Asker&) override;
    void remove (Asker&) override;   // waits until nothing of this asker is being answered
    bool isLate (bool ready) noexcept override;

    /// Tells a journal, which must live as long as the ticks, what is late. [main thread, before ticking]
    void report (Journal& to) noexcept { journal = &to; }

    std::uint64_t lateTicks() const noexcept { return late_ticks.load (std::memory_order_relaxed); }   ///< of all askers together [any thread]

private:
    void run();
    std::unique_lock<std::mutex> turn();

    std::mutex guard;   // of askers
    std::condition_variable woken;
    std::atomic<int> waiting = 0;
    std::vector<Asker*> askers;
    std::atomic<bool> stopping = false;
    std::atomic<std::uint64_t> late_ticks = 0;

    // Of the tick thread.
    Journal* journal = nullptr;
    std::uint64_t asked = 0;   // how often isLate was called

    std::thread thread;   // last: it uses the others
};

}   // namespace tactus
