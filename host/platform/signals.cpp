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

using Act = void (*)() noexcept;
std::atomic<Act> emergency { nullptr }, rearming { nullptr };
static_assert (std::atomic<Act>::is_always_lock_free, "a signal handler reads them");

void call (const std::atomic<Act>& act) noexcept
{
    if (const auto a = act.load()) a();
}
}   // namespace

void watchForStop() noexcept
{
    std::signal (SIGINT, note);
    std::signal (SIGTERM, note);
#ifdef SIGXFSZ
    std::signal (SIGXFSZ, SIG_IGN);   // reaching the file size limit is reported as an error of that file
#endif
#ifdef SIGTSTP
    std::signal (SIGTSTP, note);   // suspending with Ctrl-Z would leave the force on a device
#endif
#ifdef SIGHUP
    std::signal (SIGHUP, note);
#endif
}

void watchForEmergency (Act stop, Act rearm) noexcept
{
    emergency = stop;
    rearming = rearm;
#if defined(SIGUSR1) && defined(SIGUSR2)
    // Once a handler is set, neither signal ends the program, even with null actions.
    std::signal (SIGUSR1, [] (int) { call (emergency); });
    std::signal (SIGUSR2, [] (int) { call (rearming); });
#endif
}

bool stopRequested() noexcept { return requested.load (std::memory_order_relaxed); }
void requestStop() noexcept { requested = true; }

}   // namespace tactus::host
