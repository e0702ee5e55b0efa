// SPDX-License-Identifier: MIT
#include "realtime.hpp"

#if defined(__linux__)
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#elif defined(_WIN32)
#include <windows.h>
#endif

namespace tactus
{

#if defined(__linux__)

namespace
{
std::string reason (int error) { return std::generic_category().message (error); }
}   // namespace

std::optional<std::string> raisePriority (int wanted) noexcept
{
    const sched_param how { wanted };
    const int error = pthread_setschedparam (pthread_self(), SCHED_FIFO, &how);
    return error == 0 ? std::nullopt : std::optional (reason (error));
}

std::vector<std::string> becomeRealTime (std::optional<int> core)
{
    std::vector<std::string> refused;
    prctl (PR_SET_TIMERSLACK, 1UL);   // in ns; no effect under SCHED_FIFO; the default is 50 us

    if (const auto why = raisePriority (priority::tick))
        refused.push_back ("the tick thread has no real-time priority (" + *why
                           + "), so other programs can delay it: allow real-time priority with rtprio in /etc/security/limits.conf");

    if (core)
    {
        cpu_set_t set;
        CPU_ZERO (&set);
        if (*core >= 0 && *core < CPU_SETSIZE) CPU_SET (static_cast<std::size_t> (*core), &set);
        if (const int error = pthread_setaffinity_np (pthread_self(), sizeof set, &set))
            refused.push_back ("the tick thread could not be pinned to core " + std::to_string (*core) + " (" + reason (error) + "): choose another core");
    }
    return refused;
}

std::optional<std::string> lockMemory()
{
    // Under a limit on locked memory, MCL_FUTURE would make later allocations fail instead of leaving them unlocked.
    rlimit limit {};
    const bool unlimited = geteuid() == 0 || (getrlimit (RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY);
    if (mlockall (unlimited ? MCL_CURRENT | MCL_FUTURE : MCL_CURRENT) == 0) return std::nullopt;
    return "memory is not locked (" + reason (errno) + "), so a tick may wait for the disk: allow locking with memlock in /etc/security/limits.conf";
}

#elif defined(_WIN32)

std::optional<std::string> raisePriority (int) noexcept
{
    if (::SetThreadPriority (::GetCurrentThread(), THREAD_PRIORITY_TIME_CRITICAL) != 0) return std::nullopt;
    return "error " + std::to_string (::GetLastError()) + " of Windows";
}

std::vector<std::string> becomeRealTime (std::optional<int> core)
{
    std::vector<std::string> refused;
    using Join = HANDLE (WINAPI*) (LPCWSTR, LPDWORD);
    static const auto library = ::LoadLibraryW (L"avrt.dll");
    auto* const found = library != nullptr ? reinterpret_cast<void*> (::GetProcAddress (library, "AvSetMmThreadCharacteristicsW")) : nullptr;
    const auto join = reinterpret_cast<Join> (found);
    DWORD task = 0;
    if (join == nullptr || join (L"Pro Audio", &task) == nullptr)
        refused.push_back ("the tick thread is not in the class \"Pro Audio\" of the multimedia scheduler, so other programs can delay it");
    if (const auto why = raisePriority (priority::tick)) refused.push_back ("the tick thread has no high priority (" + *why + ")");
    if (core && (*core < 0 || *core > 63 || ::SetThreadAffinityMask (::GetCurrentThread(), DWORD_PTR { 1 } << *core) == 0))
        refused.push_back ("the tick thread could not be pinned to core " + std::to_string (*core) + ": choose another core");
    return refused;
}

std::optional<std::string> lockMemory() { return "memory is not locked on this system, so a tick may wait for the disk"; }

#else

std::optional<std::string> raisePriority (int) noexcept
{
    return "Tactus cannot request it on this system";
}

std::vector<std::string> becomeRealTime (std::optional<int>)
{
    return { "the tick thread has no real-time priority on this system" };
}

std::optional<std::string> lockMemory() { return "memory is not locked on this system, so a tick may wait for the disk"; }

#endif

}   // namespace tactus
