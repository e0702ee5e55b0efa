// SPDX-License-Identifier: MIT
#include "answering_thread.hpp"

#include <algorithm>
#include <chrono>

namespace tactus
{

AnsweringThread::AnsweringThread() : thread ([this]
                                             { run(); })
{
}

AnsweringThread::~AnsweringThread()
{
    {
        const auto lock = turn();
        stopping = true;
    }
    woken.notify_one();
    thread.join();
}

void AnsweringThread::add (Asker& asker)
{
    const auto lock = turn();
    askers.push_back (&asker);
    woken.notify_one();
}

void AnsweringThread::remove (Asker& asker)
{
    const auto lock = turn();
    std::erase (askers, &asker);
}

bool AnsweringThread::isLate (bool ready) noexcept
{
    const auto question = asked++;
    if (ready) return false;
    late_ticks.fetch_add (1, std::memory_order_relaxed);
    if (journal) journal->late (question);
    return true;
}

/// A mutex is not fair: a busy thread would take it again at once, round after round.
std::unique_lock<std::mutex> AnsweringThread::turn()
{
    ++waiting;
    std::unique_lock lock (guard);
    --waiting;
    return lock;
}

void AnsweringThread::run()
{
    // It polls while there is somebody who may ask, because to wake a thread is a system call, and who asks is on the tick.
    constexpr std::chrono::microseconds pause { 200 };
    while (! stopping)
    {
        bool any = false;
        {
            std::unique_lock lock (guard);
            woken.wait (lock, [this]
                        { return stopping || ! askers.empty(); });
            for (auto* asker : askers)
                any = asker->answer() || any;
        }
        if (! any) std::this_thread::sleep_for (pause);
        while (waiting > 0)
            std::this_thread::sleep_for (pause);
    }
}

}   // namespace tactus
