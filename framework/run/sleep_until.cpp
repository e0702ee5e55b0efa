// SPDX-License-Identifier: MIT
// The sleep of realtime.hpp. It is in the library tactus::framework, because drivers of devices sleep, too, and link nothing that runs graphs.
#include "realtime.hpp"

#if defined(_WIN32)
#include <windows.h>
#endif

#include <algorithm>
#include <thread>

namespace tactus
{

void sleepUntil (std::chrono::steady_clock::time_point until) noexcept
{
#if defined(_WIN32)
    constexpr DWORD high_resolution = 2;   // CREATE_WAITABLE_TIMER_HIGH_RESOLUTION, which older headers do not have
    struct Timer
    {
        HANDLE handle = ::CreateWaitableTimerExW (nullptr, nullptr, high_resolution, TIMER_ALL_ACCESS);
        ~Timer() { ::CloseHandle (handle); }
    };
    thread_local const Timer timer;
    const auto left = std::max (std::chrono::steady_clock::duration {}, until - std::chrono::steady_clock::now());
    LARGE_INTEGER due;   // negative: from now on, in 100 ns
    due.QuadPart = -(left / std::chrono::nanoseconds (100));
    if (timer.handle != nullptr && ::SetWaitableTimer (timer.handle, &due, 0, nullptr, nullptr, FALSE) != 0)
    {
        constexpr DWORD more_ms = 100;   // a timer that never fires must not keep the thread that drives a motor
        ::WaitForSingleObject (timer.handle, static_cast<DWORD> (std::chrono::ceil<std::chrono::milliseconds> (left).count()) + more_ms);
        return;
    }
#endif
    std::this_thread::sleep_until (until);
}

}   // namespace tactus
