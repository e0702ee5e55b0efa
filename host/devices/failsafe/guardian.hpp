// SPDX-License-Identifier: MIT
#pragma once

#include "failsafe.hpp"

#if defined(__linux__)
#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#endif

namespace tactus::host::guardian
{

#if defined(__linux__)

/// Plain bytes, because a signal handler reads it and it is sent through a socket. The two programs are of the same version.
struct FinalReports
{
    std::uint32_t slot = 0, count = 0;   // count 0: disarmed
    std::uint32_t due = 0;               // 1: the reports of this slot must be written now
    std::array<std::uint16_t, Failsafe::most_reports> sizes {};
    std::array<std::uint8_t, Failsafe::most_reports> is_feature {};
    std::array<std::uint8_t, Failsafe::most_bytes> bytes {};
};

/// Memory that this process and the guardian share. Beats and alarms go through it because they must cost no system call.
struct SharedState
{
    enum class Cause
    {
        frozen,
        unguarded,
        slept
    };

    /// The time of the latest beat of each device, in ns of the steady clock, or at_rest, or taken.
    std::array<std::atomic<std::int64_t>, Failsafe::most_devices> beats {};
    std::atomic<std::uint32_t> looks { 0 };   ///< the guardian's own sign of life: a counter that it increases many times a second
    std::atomic<std::int64_t> asleep { 0 };   ///< how long the computer has slept, in ns, as far as anyone has noticed

    /// The latest alarm. The detail is, if frozen: the last beat; unguarded: 1 if no other guardian can be started, or 0; slept: for how long, in ns.
    std::atomic<Cause> cause { Cause::frozen };
    std::atomic<std::int64_t> detail { 0 };
    std::atomic<std::uint32_t> alarms { 0 };   ///< counts them

    static constexpr std::int64_t at_rest = 0;   ///< there is nothing to watch
    static constexpr std::int64_t taken = -1;    ///< the program must not drive the device until it opens the device again

    void raiseAlarm (Cause c, std::int64_t d) noexcept
    {
        detail = d;
        cause = c;
        ++alarms;   // last, because readers look at this first
    }
};
static_assert (std::atomic<std::int64_t>::is_always_lock_free && std::atomic<SharedState::Cause>::is_always_lock_free, "two processes share them");

/// The program of the guardian. Its name does not contain that of Tactus, so that `pkill -STOP tactus` or `pkill -KILL tactus` does not reach
/// both.
inline constexpr auto program_name = "force-guardian";

/// The guardian's only argument is the file in which it notes when and why it brought devices to rest; "" if there is none. See lastFailsafe().

/// The files that the guardian starts with: its messages, and memory that contains Shared.
inline constexpr int message_socket = 0, memory_file = 1;

/// The signals that mean a fault of the program.
inline constexpr std::array faults { SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL };

/// The reports of a device, one bit each.
inline constexpr std::uint32_t all_reports = (1u << Failsafe::most_reports) - 1u;

/// Writes these reports to a device file, in order, and returns those that the system did not take. [even in a signal handler]
std::uint32_t write (int file, const FinalReports&, std::uint32_t which = all_reports) noexcept;

/// Sends the guardian a message that arms a slot, with its device file, or disarms it. A slot that is disarmed before its due reports are written is
/// free, but the guardian goes on writing them. False, with errno, if this failed.
bool send (int to, const FinalReports&, int file) noexcept;

#endif

}   // namespace tactus::host::guardian
