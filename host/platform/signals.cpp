// SPDX-License-Identifier: GPL-3.0-or-later
#include "signals.hpp"

#include <atomic>
#include <csignal>

namespace tactus::host
{

namespace
{
std::atomic<bool> requested { false };
static_assert (std::atomic<bool>::is_always_lock_free, "a signal handler may set it");

extern "C" void note (int) { requested = true; }
}   // namespace

void watchForStop() noexcept
{
    std::signal (SIGINT, note);
    std::signal (SIGTERM, note);
#ifdef SIGHUP
    std::signal (SIGHUP, note);
#endif
}

bool stopRequested() noexcept { return requested.load (std::memory_order_relaxed); }
void requestStop() noexcept { requested = true; }

}   // namespace tactus::host
