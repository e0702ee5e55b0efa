// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace tactus
{

/// Real-time priorities (SCHED_FIFO), above those of interrupt threads, which have 50. The thread of an emergency stop comes before
/// the tick, so that a graph that takes most of its period cannot delay the stop; this thread does very little. The thread that
/// receives messages comes after the tick, because anyone can flood it: it runs in the pauses between ticks. Drivers of others come between
/// these two. Figures: docs/decisions/stop_threads.md.
namespace priority
{
inline constexpr int messages = 60, devices = 65, tick = 70, stop = 71;
}

/// Sleeps until then, with the finest timer that the system has: std::this_thread::sleep_until wakes up to 16 ms late on Windows. [any thread]
void sleepUntil (std::chrono::steady_clock::time_point) noexcept;

/// Requests a real-time priority for the calling thread. If the system refuses it, returns the reason, and the thread keeps its
/// priority. [the thread itself]
std::optional<std::string> raisePriority (int) noexcept;

/// Requests what helps the calling thread to be on time: priority over everything that is not real-time (SCHED_FIFO; on Windows, the class "Pro Audio"), a
/// fixed core if one is given, and no timer slack. Returns a sentence for each request that is refused; the thread runs anyway. [the
/// thread itself, before its first tick]
std::vector<std::string> becomeRealTime (std::optional<int> core);

/// Keeps the memory of the process from being paged out. Returns why it failed, if it failed. [main thread]
std::optional<std::string> lockMemory();

}   // namespace tactus
