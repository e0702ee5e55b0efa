// SPDX-License-Identifier: MIT
#include "signals.hpp"

#include <atomic>
#include <csignal>

#if defined(_WIN32)
#include <windows.h>
#endif

namespace tactus::host
{

namespace
{
std::atomic<bool> requested { false };
static_assert (std::atomic<bool>::is_always_lock_free, "a signal handler may set it");

/// All signals that would end or suspend the process and leave a force on a device, except the real-time signals, whose numbers
/// are known only at run time. Faults (SIGSEGV and the like) are left to Failsafe.
constexpr int stopping[] = {
#ifdef SIGPOLL
    SIGPOLL,
#endif
#ifdef SIGPWR
    SIGPWR,
#endif
#ifdef SIGSTKFLT
    SIGSTKFLT,
#endif
#if defined(__unix__) || defined(__APPLE__)
    SIGHUP, SIGQUIT, SIGALRM, SIGVTALRM, SIGPROF, SIGXCPU, SIGPIPE, SIGTSTP, SIGSYS, SIGTRAP,
#endif
    SIGINT, SIGTERM
};

extern "C" void note (int) { requested = true; }

using Act = void (*)() noexcept;
std::atomic<Act> emergency { nullptr }, rearming { nullptr };
static_assert (std::atomic<Act>::is_always_lock_free, "a signal handler reads them");

[[maybe_unused]] void call (const std::atomic<Act>& act) noexcept
{
    if (const auto a = act.load()) a();
}

/// The program that started this one may have left signals blocked. Threads that start later inherit what this thread unblocks. The
/// emergency signals stay as they are: see holdEmergencySignals.
void unblockOthers() noexcept
{
#if defined(__unix__) || defined(__APPLE__)
    sigset_t others;
    sigfillset (&others);
    sigdelset (&others, SIGUSR1);
    sigdelset (&others, SIGUSR2);
    pthread_sigmask (SIG_UNBLOCK, &others, nullptr);
#endif
}

#if defined(_WIN32)
/// Windows calls this on a thread of its own. When it returns from a closed console, a log-off or a shutdown, the process ends at once; so it never returns
/// from these, and the process ends when the program does, or when the system has waited long enough.
BOOL WINAPI afterConsoleEvent (DWORD event)
{
    requested = true;
    if (event == CTRL_CLOSE_EVENT || event == CTRL_LOGOFF_EVENT || event == CTRL_SHUTDOWN_EVENT) Sleep (INFINITE);
    return TRUE;
}
#endif

void maskEmergencySignals ([[maybe_unused]] bool blocks) noexcept
{
#if defined(__unix__) || defined(__APPLE__)
    sigset_t both;
    sigemptyset (&both);
    sigaddset (&both, SIGUSR1);
    sigaddset (&both, SIGUSR2);
    pthread_sigmask (blocks ? SIG_BLOCK : SIG_UNBLOCK, &both, nullptr);
#endif
}
}   // namespace

void holdEmergencySignals() noexcept { maskEmergencySignals (true); }
void takeEmergencySignals() noexcept { maskEmergencySignals (false); }

#if defined(__unix__) || defined(__APPLE__)
HeldSignals::HeldSignals() noexcept
{
    sigset_t all;
    sigfillset (&all);
    for (const int fault : { SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL })
        sigdelset (&all, fault);
    pthread_sigmask (SIG_BLOCK, &all, &before);
}

HeldSignals::~HeldSignals() { pthread_sigmask (SIG_SETMASK, &before, nullptr); }
#else
HeldSignals::HeldSignals() noexcept = default;
HeldSignals::~HeldSignals() = default;
#endif

void watchForStop() noexcept
{
    unblockOthers();
    for (const int number : stopping)
        std::signal (number, note);
#if defined(_WIN32)
    SetConsoleCtrlHandler (afterConsoleEvent, TRUE);   // asked before the signals, which the C library makes of the same events
#endif
#if defined(__unix__) || defined(__APPLE__)
    // A program in the background may write to its terminal, and its reads fail instead of suspending it. Reaching the file size
    // limit is reported as an error of that file.
    for (const int number : { SIGTTIN, SIGTTOU, SIGXFSZ })
        std::signal (number, SIG_IGN);
#endif
#ifdef SIGRTMIN
    for (int number = SIGRTMIN; number <= SIGRTMAX; ++number)
        std::signal (number, note);
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
