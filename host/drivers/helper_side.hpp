// SPDX-License-Identifier: MIT
// The memory that a driver shares with its helper process (helper_program.hpp), and the pipe that ends with the driver. The helper gets both as numbers in
// its arguments.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#if defined(_WIN32)
#include <windows.h>

#include <thread>
#else
#include <poll.h>
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace tactus::host
{

#if defined(_WIN32)

inline HANDLE handleOf (int number) noexcept
{
    return reinterpret_cast<HANDLE> (static_cast<std::intptr_t> (number));
}   // it has 32 bits
inline int numberOf (HANDLE handle) noexcept { return static_cast<int> (reinterpret_cast<std::intptr_t> (handle)); }

/// New memory of zeros; -1, if there is none.
inline int makeShared (std::size_t size) noexcept
{
    const auto made = ::CreateFileMappingW (INVALID_HANDLE_VALUE, nullptr, PAGE_READWRITE, 0, static_cast<DWORD> (size), nullptr);
    return made != nullptr ? numberOf (made) : -1;
}

/// Null if it cannot be mapped.
inline void* mapShared (int memory, std::size_t size) noexcept { return ::MapViewOfFile (handleOf (memory), FILE_MAP_ALL_ACCESS, 0, 0, size); }
inline void unmapShared (void* at, std::size_t) noexcept { ::UnmapViewOfFile (at); }
inline void closeShared (int memory) noexcept { ::CloseHandle (handleOf (memory)); }

/// True if the other end of the pipe is closed, or something comes, within this time.
inline bool pipeEnds (int pipe, int wait_ms) noexcept
{
    for (int waited = 0;; ++waited)
    {
        DWORD there = 0;
        if (::PeekNamedPipe (handleOf (pipe), nullptr, 0, nullptr, &there, nullptr) == 0 || there > 0) return true;
        if (waited >= wait_ms) return false;
        ::Sleep (1);
    }
}

/// Writes to a pipe. True if all is out.
inline bool writePipe (int pipe, const std::string& text) noexcept
{
    DWORD out = 0;
    return ::WriteFile (handleOf (pipe), text.data(), static_cast<DWORD> (text.size()), &out, nullptr) != 0 && out == text.size();
}

/// Ends this process after so many seconds, unless it is called again; 0: does not end it.
inline void endProcessAfter (unsigned seconds)
{
    static HANDLE timer = nullptr;
    if (timer != nullptr) ::DeleteTimerQueueTimer (nullptr, timer, nullptr);
    timer = nullptr;
    if (seconds == 0) return;
    const auto end = [] (void*, BOOLEAN) -> void { ::TerminateProcess (::GetCurrentProcess(), 1); };
    ::CreateTimerQueueTimer (&timer, nullptr, end, nullptr, 1000 * seconds, 0, WT_EXECUTEONLYONCE);
}

#else

inline int makeShared (std::size_t size) noexcept
{
    const int made = ::memfd_create ("tactus-driver", MFD_CLOEXEC);
    if (made < 0 || ::ftruncate (made, static_cast<off_t> (size)) == 0) return made;
    ::close (made);
    return -1;
}

inline void* mapShared (int memory, std::size_t size) noexcept
{
    void* const at = ::mmap (nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, memory, 0);
    return at != MAP_FAILED ? at : nullptr;
}
inline void unmapShared (void* at, std::size_t size) noexcept { ::munmap (at, size); }
inline void closeShared (int memory) noexcept { ::close (memory); }

inline bool pipeEnds (int pipe, int wait_ms) noexcept
{
    pollfd end { pipe, POLLIN, 0 };
    return ::poll (&end, 1, wait_ms) > 0;
}

inline bool writePipe (int pipe, const std::string& text) noexcept
{
    return ::write (pipe, text.data(), text.size()) == static_cast<ssize_t> (text.size());
}

inline void endProcessAfter (unsigned seconds) noexcept { ::alarm (seconds); }

#endif

}   // namespace tactus::host
