// SPDX-License-Identifier: MIT
#include "signals.hpp"

#if defined(__linux__)
#include <array>
#include <fcntl.h>
#include <string_view>
#include <unistd.h>
#endif

namespace tactus::host
{

/// The system keeps the main thread until the process ends: a destructor of its thread-specific data would tell this, too, but only a thread itself can
/// set one, and the session may be opened by another thread.
bool mainThreadHasEnded() noexcept
{
#if defined(__linux__)
    const int file = ::open ("/proc/self/stat", O_RDONLY | O_CLOEXEC);   // "PID (NAME) STATE …", of the main thread
    if (file < 0) return false;
    std::array<char, 64> text {};   // a NAME has at most 15 bytes
    const auto length = ::read (file, text.data(), text.size());
    ::close (file);
    const std::string_view begin (text.data(), length > 0 ? static_cast<std::size_t> (length) : 0);
    const auto name_end = begin.rfind (") ");
    return name_end + 2 < begin.size() && begin[name_end + 2] == 'Z';
#else
    return false;
#endif
}

}   // namespace tactus::host
