// SPDX-License-Identifier: MIT
#include "patient_output.hpp"
#include "signals.hpp"

#include <tactus/file/atomic_file.hpp>

#if defined(_WIN32)
#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <cstdlib>
#elif defined(__linux__)
#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <iostream>
#include <limits.h>
#include <memory>
#include <streambuf>
#include <string_view>
#include <utility>
#endif

namespace tactus::host
{

#if defined(__linux__)

namespace
{
constexpr int pause_ms = 50;
std::atomic<int> most_looks { 0 };   // without progress, once a stop was requested

/// A file that takes bytes when it has room for them.
class Outlet
{
public:
    Outlet (int f, bool owns) : file (f), is_owned (owns) {}
    Outlet (const Outlet&) = delete;
    Outlet& operator= (const Outlet&) = delete;
    ~Outlet()
    {
        if (is_owned) ::close (file);
    }

    /// False, with errno, if not all bytes were written.
    bool write (const char* bytes, std::size_t size)
    {
        for (int looks = 0; size > 0;)
        {
            if (is_given_up)
            {
                errno = EINTR;
                return false;
            }
            pollfd room { .fd = file, .events = POLLOUT, .revents = 0 };
            const int ready = ::poll (&room, 1, pause_ms);
            // A pipe with room has room for this many bytes, so the write does not wait, even if other programs share the pipe.
            const auto written = ready > 0 ? ::write (file, bytes, std::min<std::size_t> (size, PIPE_BUF)) : -1;
            if (written > 0)
            {
                bytes += written;
                size -= static_cast<std::size_t> (written);
                looks = 0;
                continue;
            }
            if (ready > 0 && errno != EAGAIN && errno != EINTR) return false;
            if (ready == 0 && stopRequested() && ++looks >= most_looks) is_given_up = true;
        }
        return true;
    }

private:
    const int file;
    const bool is_owned;
    std::atomic<bool> is_given_up = false;   // several threads write messages
};

class OutletBuffer final : public std::streambuf
{
public:
    OutletBuffer (int file, bool owns) : outlet (file, owns), is_terminal (::isatty (file) != 0) { setp (room.data(), room.data() + room.size()); }
    ~OutletBuffer() override { sync(); }

private:
    /// A person sees each line as soon as it is complete.
    std::streamsize xsputn (const char* bytes, std::streamsize size) override
    {
        const auto put = std::streambuf::xsputn (bytes, size);
        const bool ends_line = is_terminal && std::string_view (bytes, static_cast<std::size_t> (size)).find ('\n') != std::string_view::npos;
        return ends_line && sync() != 0 ? 0 : put;
    }

    int sync() override
    {
        const auto size = static_cast<std::size_t> (pptr() - pbase());
        setp (room.data(), room.data() + room.size());   // what cannot be written is lost, as in a file buffer that is closed
        return outlet.write (room.data(), size) ? 0 : -1;
    }

    int_type overflow (int_type c) override
    {
        if (sync() != 0) return traits_type::eof();
        return traits_type::eq_int_type (c, traits_type::eof()) ? traits_type::not_eof (c) : sputc (traits_type::to_char_type (c));
    }

    Outlet outlet;
    const bool is_terminal;
    std::array<char, 16384> room;
};

class Pipe final : public std::ostream
{
public:
    explicit Pipe (int file) : std::ostream (nullptr), buffer (file, true) { rdbuf (&buffer); }

private:
    OutletBuffer buffer;
};

/// Waits until another program reads the pipe, or a stop is requested.
std::unique_ptr<std::ostream> openPatiently (const std::filesystem::path& path)
{
    for (;;)
    {
        const int file = ::open (path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
        if (file >= 0) return std::make_unique<Pipe> (file);
        const int why = errno;
        std::error_code unseen;
        const bool waits = why == EINTR || (why == ENXIO && std::filesystem::is_fifo (path, unseen));
        errno = why;
        if (! waits) return nullptr;
        if (stopRequested())
        {
            errno = EINTR;
            return nullptr;
        }
        ::poll (nullptr, 0, pause_ms);
    }
}

bool isFile (int file) noexcept
{
    struct stat status
    {
    };
    return ::fstat (file, &status) != 0 || S_ISREG (status.st_mode);
}

/// Standard error has no buffer, whether it is written through std::cerr or through stdio.
void replaceErrors()
{
    static Outlet errors (STDERR_FILENO, false);
    class DirectBuffer final : public std::streambuf
    {
        std::streamsize xsputn (const char* bytes, std::streamsize size) override { return errors.write (bytes, static_cast<std::size_t> (size)) ? size : 0; }
        int_type overflow (int_type c) override
        {
            const char one = traits_type::to_char_type (c);
            return errors.write (&one, 1) ? traits_type::not_eof (c) : traits_type::eof();
        }
    };
    static DirectBuffer buffer;
    std::cerr.rdbuf (&buffer);
    std::clog.rdbuf (&buffer);
#if defined(__GLIBC__)
    cookie_io_functions_t functions {};
    functions.write = [] (void*, const char* bytes, size_t size) -> ssize_t { return errors.write (bytes, size) ? static_cast<ssize_t> (size) : 0; };
    if (auto* file = ::fopencookie (nullptr, "w", functions))
    {
        std::setvbuf (file, nullptr, _IONBF, 0);
        stderr = file;
    }
#endif
}
}   // namespace

void giveUpBlockedOutputs (std::chrono::milliseconds after)
{
    const bool is_first = most_looks.exchange (static_cast<int> (after.count()) / pause_ms) == 0;
    if (! is_first) return;
    openPipesBy (openPatiently);
    if (! isFile (STDOUT_FILENO))
    {
        // Never freed: std::cout is flushed after all other objects are gone.
        static auto* const output = new OutletBuffer (STDOUT_FILENO, false);
        std::cout.rdbuf (output);
    }
    if (! isFile (STDERR_FILENO)) replaceErrors();
}

#elif defined(_WIN32)

/// A blocked output still blocks. Lines end as on Linux, so that the same command writes the same bytes; the console shows UTF-8 and colours.
void giveUpBlockedOutputs (std::chrono::milliseconds)
{
    for (const int file : { 0, 1, 2 })
        _setmode (file, _O_BINARY);
    for (const DWORD handle : { STD_OUTPUT_HANDLE, STD_ERROR_HANDLE })
    {
        DWORD mode = 0;
        if (auto* const console = GetStdHandle (handle); GetConsoleMode (console, &mode)) SetConsoleMode (console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
    }
    static const UINT before = GetConsoleOutputCP();   // the console belongs to the shell, too
    if (before == 0 || before == CP_UTF8 || ! SetConsoleOutputCP (CP_UTF8)) return;
    std::atexit ([] { SetConsoleOutputCP (before); });
}

#else

void giveUpBlockedOutputs (std::chrono::milliseconds)
{
}

#endif

}   // namespace tactus::host
