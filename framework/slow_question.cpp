// SPDX-License-Identifier: MIT
#include "slow_question.hpp"

#include <algorithm>
#include <chrono>

namespace tactus
{

SlowAnswers::SlowAnswers() : thread ([this]
                                     { run(); })
{
}

SlowAnswers::~SlowAnswers()
{
    {
        const auto lock = turn();
        stopping = true;
    }
    woken.notify_one();
    thread.join();
}

void SlowAnswers::add (Asker& asker)
{
    const auto lock = turn();
    askers.push_back (&asker);
    woken.notify_one();
}

void SlowAnswers::remove (Asker& asker)
{
    const auto lock = turn();
    std::erase (askers, &asker);
}

/// A mutex is not fair: a busy thread would take it again at once, round after round.
std::unique_lock<std::mutex> SlowAnswers::turn()
{
    ++waiting;
    std::unique_lock lock (guard);
    --waiting;
    return lock;
}

void SlowAnswers::run()
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
