// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>

namespace tactus::host::hid
{

/// Wakes a thread that waits for another one. Who rings several times before it was heard rings once.
class Doorbell
{
public:
    using Clock = std::chrono::steady_clock;

    void ring() noexcept
    {
        {
            const std::lock_guard lock (mutex);
            rung = true;
        }
        heard.notify_one();
    }

    /// True if it rang, before or meanwhile; false once the time has come. [one thread]
    bool wait (Clock::time_point until) noexcept
    {
        std::unique_lock lock (mutex);
        const bool did = heard.wait_until (lock, until, [this]
                                           { return rung; });
        rung = false;
        return did;
    }

private:
    std::mutex mutex;
    std::condition_variable heard;
    bool rung = false;
};

}   // namespace tactus::host::hid
