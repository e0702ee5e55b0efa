// SPDX-License-Identifier: MIT
#include "file_lock.hpp"

#include <utility>

#if defined(_WIN32)
#include <windows.h>
#else
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#endif

namespace tactus
{

std::optional<FileLock> FileLock::take (const std::filesystem::path& path) { return takeOpened (path, true); }
std::optional<FileLock> FileLock::takeExisting (const std::filesystem::path& path) { return takeOpened (path, false); }

std::optional<FileLock> FileLock::takeOpened (const std::filesystem::path& path, bool make)
{
#if defined(_WIN32)
    const auto opened = CreateFileW (path.c_str(), GENERIC_READ | GENERIC_WRITE, FILE_SHARE_DELETE, nullptr, make ? OPEN_ALWAYS : OPEN_EXISTING,
                                     FILE_ATTRIBUTE_NORMAL, nullptr);
    if (opened == INVALID_HANDLE_VALUE) return std::nullopt;
    return FileLock (reinterpret_cast<std::intptr_t> (opened));
#else
    // A serial line must not become the terminal of a session that has none: if it were unplugged, the program would end.
    const int opened = ::open (path.c_str(), O_RDWR | (make ? O_CREAT : 0) | O_NOCTTY | O_CLOEXEC, 0600);
    if (opened < 0) return std::nullopt;
    FileLock lock (opened);
    lock.owner = ::getpid();
    if (::flock (opened, LOCK_EX | LOCK_NB) != 0) return std::nullopt;
    return lock;
#endif
}

FileLock::FileLock (FileLock&& other) noexcept : handle (std::exchange (other.handle, none)), owner (other.owner) {}

FileLock& FileLock::operator= (FileLock&& other) noexcept
{
    if (this == &other) return *this;
    release();
    handle = std::exchange (other.handle, none);
    owner = other.owner;
    return *this;
}

FileLock::~FileLock() { release(); }

void FileLock::release() noexcept
{
    if (handle == none) return;
#if defined(_WIN32)
    CloseHandle (reinterpret_cast<HANDLE> (handle));
#else
    if (owner == ::getpid()) ::flock (static_cast<int> (handle), LOCK_UN);   // the child of a fork may still have the file open
    ::close (static_cast<int> (handle));
#endif
    handle = none;
}

}   // namespace tactus
