// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/threads/snapshot.hpp>

#if defined(__linux__)
#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <ctime>
#endif

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <string>
#include <thread>

namespace tactus::host::openhaptics
{

/// An arm in the memory that a driver shares with the helper process that owns the maker's library. Only zeros are a valid beginning. Numbers are in the
/// units and axes of the library: mm, N, mN m, x to the right, y up, z towards the person.
struct SharedArm
{
    enum State : std::uint32_t
    {
        unused,
        starting,   ///< the driver wants it
        ready,
        resting,   ///< the driver does not want it any more, and it has got zeros
        failed     ///< `text` says why
    };

    /// A tick of the library's servo loop.
    struct Tick
    {
        std::uint64_t number = 0;   // from 1
        std::int64_t at_ns = 0;     // of the steady clock: the servo loop may stall, so a number is no time
        double position[3] {};
        double transform[16] {};    // by columns
        double temperature = 0.0;   // of the hottest motor: 0 is cold, 1 too warm; an estimate of the library
        double delay_s = 0.0;       // from a place to the force that answers it, in the arm, on average; 0: nothing has been answered
        std::uint32_t buttons = 0;
        std::uint32_t fault = 0;   // TACTUS_DEVICE_TOO_HOT, …
    };

    /// The effort that the host asks for.
    struct Push
    {
        double force[3] {}, torque[3] {};
        std::int64_t at_ns = 0;      // of the steady clock
        std::uint64_t answers = 0;   // the tick that the host had read last
    };

    static constexpr std::size_t kept = 64;                   ///< ticks
    static constexpr std::int64_t patience_ns = 20'000'000;   ///< without a push, there is no force

    std::atomic<std::uint32_t> state, is_wanted;
    std::atomic<std::uint32_t> ticks, pushes;   ///< both counts wake who waits for them
    std::array<Snapshot<Tick>, kept> ring;      ///< tick n is at n % kept
    Snapshot<Push> push;

    char name[256];   ///< of the driver: which arm; "": any

    // Written before `ready` or `failed`.
    char text[1024], model[256];
    double max_force, max_continuous_force, rate_hz;
    std::array<double, 6> workspace;   ///< mm: the least x, y, z, then the largest
    std::int32_t input_dof, output_dof;
};

/// The memory of a driver and its helper. The library has one servo loop, which serves all arms.
struct SharedArms
{
    std::array<SharedArm, 4> arms;
    std::atomic<std::uint32_t> is_joining;   ///< the servo loop stands still, because an arm joins or leaves
    std::atomic<std::uint32_t> is_ending;    ///< the helper takes no further arm
};

static_assert (std::atomic<std::uint32_t>::is_always_lock_free && std::atomic<std::uint64_t>::is_always_lock_free);

inline void put (char* to, std::size_t size, const std::string& text)
{
    const auto n = std::min (size - 1, text.size());
    std::memcpy (to, text.data(), n);
    to[n] = 0;
}

inline std::int64_t nanosecondsNow() noexcept
{
    return std::chrono::nanoseconds (std::chrono::steady_clock::now().time_since_epoch()).count();
}

#if defined(__linux__)
/// Waits while the count is still this one, but not longer than this. May return early.
inline void waitWhile (std::atomic<std::uint32_t>& count, std::uint32_t is, std::int64_t ns) noexcept
{
    const timespec longest { static_cast<time_t> (ns / 1'000'000'000), static_cast<long> (ns % 1'000'000'000) };
    ::syscall (SYS_futex, &count, FUTEX_WAIT, is, &longest, nullptr, 0);
}

inline void wake (std::atomic<std::uint32_t>& count) noexcept { ::syscall (SYS_futex, &count, FUTEX_WAKE, 1, nullptr, nullptr, 0); }
#else
/// Lets other threads run, because no wait of this system is for a count that two processes share.
inline void waitWhile (std::atomic<std::uint32_t>& count, std::uint32_t is, std::int64_t) noexcept
{
    if (count == is) std::this_thread::yield();
}

inline void wake (std::atomic<std::uint32_t>&) noexcept {}
#endif

}   // namespace tactus::host::openhaptics
