// SPDX-License-Identifier: MIT
#include "report_file.hpp"

#if defined(__linux__)
#include <fcntl.h>
#include <linux/hidraw.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>
#endif

namespace tactus::host
{

#if defined(__linux__)

namespace
{
using Outcome = ReportFile::Outcome;

Outcome failure (int error) noexcept { return { .what = Outcome::Kind::failure, .error = error }; }
}   // namespace

int waitForInput (int file, ReportFile::Clock::time_point until) noexcept
{
    for (;;)
    {
        const auto left = std::chrono::duration_cast<std::chrono::nanoseconds> (until - ReportFile::Clock::now()).count();
        if (left <= 0) return ETIMEDOUT;
        const timespec wait { .tv_sec = left / 1'000'000'000, .tv_nsec = left % 1'000'000'000 };
        pollfd polled { .fd = file, .events = POLLIN, .revents = 0 };
        const int ready = ::ppoll (&polled, 1, &wait, nullptr);
        if (ready < 0 && errno != EINTR) return errno;
        if (ready > 0) return (polled.revents & (POLLERR | POLLHUP | POLLNVAL)) != 0 ? EIO : 0;
    }
}

std::optional<ReportFile> ReportFile::open (const std::string& path) noexcept
{
    const int file = ::open (path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return std::nullopt;
    return std::optional<ReportFile> (std::in_place, file);
}

ReportFile::ReportFile (int descriptor) noexcept : file (descriptor)
{
    if (const int flags = ::fcntl (file, F_GETFL); (flags & O_NONBLOCK) == 0) ::fcntl (file, F_SETFL, flags | O_NONBLOCK);
}

ReportFile::~ReportFile()
{
    if (file >= 0) ::close (file);
}

Outcome ReportFile::read (std::span<std::uint8_t> into, Clock::time_point until) noexcept
{
    for (;;)
    {
        const auto got = ::read (file, into.data(), into.size());
        if (got > 0) return { .what = Outcome::Kind::report, .size = static_cast<std::size_t> (got) };
        if (got == 0) return failure (EIO);   // the end of the file: the system does not pass on empty reports
        if (errno == EINTR) continue;
        if (errno != EAGAIN) return failure (errno);
        const int waited = waitForInput (file, until);
        if (waited == ETIMEDOUT) return {};
        if (waited != 0) return failure (waited);
    }
}

Outcome ReportFile::ask (std::span<std::uint8_t> report) noexcept
{
    const int got = ::ioctl (file, HIDIOCGINPUT (report.size()), report.data());
    if (got < 0) return failure (errno);
    return { .what = Outcome::Kind::report, .size = static_cast<std::size_t> (got) };
}

#else

std::optional<ReportFile> ReportFile::open (const std::string&) noexcept
{
    return std::nullopt;
}
ReportFile::ReportFile (int) noexcept {}
ReportFile::~ReportFile() = default;
ReportFile::Outcome ReportFile::read (std::span<std::uint8_t>, Clock::time_point) noexcept { return { .what = Outcome::Kind::failure }; }
ReportFile::Outcome ReportFile::ask (std::span<std::uint8_t>) noexcept { return { .what = Outcome::Kind::failure }; }

#endif

}   // namespace tactus::host
