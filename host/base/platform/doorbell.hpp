// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>

#if defined(__linux__)
#include <cerrno>
#include <ctime>
#include <semaphore.h>
#else
#include <semaphore>
#endif

namespace tactus::host
{

/// Lets one thread sleep until another thread rings, or until a given time. Several rings before the sleeper wakes up count
/// as one; no ring is lost.
///
/// ring() is wait-free and takes no lock: it does an atomic exchange and, for the first ring, a sem_post, which enters the
/// kernel only if the other thread is asleep. The count of the semaphore never exceeds 1.
///
/// On Linux this is a POSIX semaphore, because the timed wait of libstdc++ 12 (bits/atomic_timed_wait.h,
/// __timed_backoff_spin_policy) may poll with sleeps of up to 64 ms instead of waiting on the futex.
class Doorbell
{
public:
    using Clock = std::chrono::steady_clock;

    Doorbell() = default;
    Doorbell (const Doorbell&) = delete;
    Doorbell& operator= (const Doorbell&) = delete;

    void ring() noexcept   // [any thread]
    {
        if (! rung.exchange (true, std::memory_order_acq_rel)) bell.release();
    }

    /// True if a thread has rung since the last wait, or rings during this one. False if `until` is reached first. [one thread]
    bool wait (Clock::time_point until) noexcept
    {
        if (! bell.try_acquire_until (until)) return false;
        rung.exchange (false, std::memory_order_acq_rel);   // later rings count again; whatever this ring announced is visible now
        return true;
    }

private:
#if defined(__linux__)
    class Semaphore
    {
    public:
        explicit Semaphore (unsigned count) noexcept { ::sem_init (&semaphore, 0, count); }
        ~Semaphore() { ::sem_destroy (&semaphore); }
        Semaphore (const Semaphore&) = delete;
        Semaphore& operator= (const Semaphore&) = delete;

        void release() noexcept { ::sem_post (&semaphore); }

        bool try_acquire_until (Clock::time_point until) noexcept
        {
            const auto ns = std::chrono::duration_cast<std::chrono::nanoseconds> (until.time_since_epoch()).count();
            const timespec at { .tv_sec = ns / 1'000'000'000, .tv_nsec = ns % 1'000'000'000 };
            int failed = 0;
            while ((failed = ::sem_clockwait (&semaphore, CLOCK_MONOTONIC, &at)) != 0 && errno == EINTR)
                ;
            return failed == 0;
        }

    private:
        sem_t semaphore {};
    };
#else
    using Semaphore = std::binary_semaphore;
#endif

    std::atomic<bool> rung = false;
    Semaphore bell { 0 };
};

}   // namespace tactus::host
