// SPDX-License-Identifier: MIT
#include "query_thread.hpp"

#include <tactus/text/caught.hpp>

#include <algorithm>
#include <chrono>

namespace tactus
{

QueryThread::QueryThread()
    : thread ([this] {
          while (! stopping)
              static_cast<void> (caught ("the thread of the queries", [this] { run(); }));   // what is not answered is late, and is counted
      })
{
}

QueryThread::~QueryThread()
{
    {
        const auto lock = turn();
        stopping = true;
    }
    woken.notify_one();
    thread.join();
}

void QueryThread::add (AsyncQueryBase& asker)
{
    const auto lock = turn();
    askers.push_back (&asker);
    woken.notify_one();
}

void QueryThread::remove (AsyncQueryBase& asker)
{
    const auto lock = turn();
    std::erase (askers, &asker);
}

bool QueryThread::isLate (bool ready) noexcept
{
    const auto question = asked++;
    if (ready) return false;
    late_ticks.fetch_add (1, std::memory_order_relaxed);
    if (journal) journal->late (question);
    return true;
}

/// Locks the mutex, and makes the query thread wait meanwhile. A mutex is not fair: while it is busy, the query thread would lock
/// it again immediately, over and over.
std::unique_lock<std::mutex> QueryThread::turn()
{
    ++waiting;
    std::unique_lock lock (guard);
    --waiting;
    return lock;
}

void QueryThread::run()
{
    // Polls while there are askers. They ask on the tick thread, and waking this thread from there would take a system call.
    constexpr std::chrono::microseconds pause { 200 };
    while (! stopping)
    {
        bool any = false;
        {
            std::unique_lock lock (guard);
            woken.wait (lock, [this] { return stopping || ! askers.empty(); });
            for (auto* asker : askers)
                any = asker->answer() || any;
        }
        if (! any) std::this_thread::sleep_for (pause);
        while (waiting > 0)
            std::this_thread::sleep_for (pause);
    }
}

}   // namespace tactus
