// SPDX-License-Identifier: MIT
#include "forbid_system_calls.hpp"
#include "parts.hpp"
#include "watched_ticks.hpp"

#if defined(__linux__)
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <new>
#include <utility>

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace tactus::examine
{

std::string callsUnwatched (const NodeType&)
{
    return canForbidSystemCalls() ? "" : "this program cannot watch system calls (sanitizer, or another operating system)";
}

#if defined(__linux__)

namespace
{
constexpr int called = 3, ticked = 0;   // exit statuses of the child: it made a system call; it made none
constexpr rlim_t most_seconds = 5;      // CPU time of the child; 200 ticks take less than a millisecond

/// The number of the system call that a child has made, in memory that it shares with its parent: the child may make no other
/// system call to report it.
volatile int* number_of_call = nullptr;

void onForbiddenCall (int, siginfo_t* info, void*)
{
    *number_of_call = info->si_syscall;
    ::_exit (called);
}

/// The names of the calls that code is likely to make by mistake.
std::string nameOf (int number)
{
    static constexpr auto names = std::to_array<std::pair<int, const char*>> ({
        { SYS_read, "read" },
        { SYS_write, "write" },
        { SYS_close, "close" },
        { SYS_openat, "openat" },
        { SYS_lseek, "lseek" },
        { SYS_newfstatat, "newfstatat" },
        { SYS_fsync, "fsync" },
        { SYS_ioctl, "ioctl" },
        { SYS_futex, "futex" },
        { SYS_nanosleep, "nanosleep" },
        { SYS_mmap, "mmap" },
        { SYS_clock_nanosleep, "clock_nanosleep" },
        { SYS_munmap, "munmap" },
        { SYS_clock_gettime, "clock_gettime" },
        { SYS_brk, "brk" },
        { SYS_sched_yield, "sched_yield" },
        { SYS_madvise, "madvise" },
        { SYS_getrandom, "getrandom" },
        { SYS_mprotect, "mprotect" },
        { SYS_gettid, "gettid" },
        { SYS_getpid, "getpid" },
        { SYS_tgkill, "tgkill" },
        { SYS_clone, "clone" },
        { SYS_rt_sigprocmask, "rt_sigprocmask" },
        { SYS_sendto, "sendto" },
        { SYS_gettimeofday, "gettimeofday" },
        { SYS_writev, "writev" },
        { SYS_rt_sigaction, "rt_sigaction" },
        { SYS_getppid, "getppid" },
        { SYS_getcpu, "getcpu" },
        { SYS_recvfrom, "recvfrom" },
        { SYS_socket, "socket" },
    });
    for (const auto& [n, name] : names)
        if (n == number) return say ('`', name, '`');
    return say ("number ", number);
}

[[noreturn]] void tickInChild (Rig& rig, NodeDice& dice)
{
    const rlimit budget { most_seconds, most_seconds };
    ::setrlimit (RLIMIT_CPU, &budget);
    struct sigaction action = {};
    action.sa_sigaction = &onForbiddenCall;
    action.sa_flags = SA_SIGINFO;
    ::sigaction (SIGSYS, &action, nullptr);
    forbidSystemCalls (Allow::nothing);
    tickWatched (
        rig, dice, [] {}, [] {});
    ::_exit (ticked);
}
}   // namespace

std::string systemCallFault (const NodeType& type, unsigned seed)
{
    NodeDice dice { seed };
    Rig rig = prepared (type);
    void* shared = ::mmap (nullptr, sizeof (int), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared == MAP_FAILED) throw std::bad_alloc();
    number_of_call = static_cast<volatile int*> (shared);
    *number_of_call = -1;
    const auto child = ::fork();
    if (child == 0) tickInChild (rig, dice);
    int status = 0;
    const bool ended = child > 0 && ::waitpid (child, &status, 0) == child;
    const int number = *number_of_call;
    ::munmap (shared, sizeof (int));
    if (! ended) return "the process that watches system calls could not be started";
    const bool is_spent = WIFSIGNALED (status) && (WTERMSIG (status) == SIGXCPU || WTERMSIG (status) == SIGKILL);
    if (is_spent) return say ("`tick` did not return within ", most_seconds, " s of CPU time");
    if (WIFSIGNALED (status)) return say ("the process that ticked was ended by signal ", WTERMSIG (status), ": ", ::strsignal (WTERMSIG (status)));
    if (WEXITSTATUS (status) == called) return say ("a tick calls the operating system: ", nameOf (number));
    return WEXITSTATUS (status) == ticked ? "" : say ("the process that ticked ended with status ", WEXITSTATUS (status));
}

#else

std::string systemCallFault (const NodeType&, unsigned)
{
    return {};
}

#endif

}   // namespace tactus::examine
