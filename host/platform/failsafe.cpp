// SPDX-License-Identifier: GPL-3.0-or-later
#include "failsafe.hpp"

#include <utility>

#if defined(__linux__)
#include <fcntl.h>
#include <linux/hidraw.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <mutex>
#include <system_error>
#endif

namespace tactus::host
{

#if defined(__linux__)

namespace
{
/// Plain bytes, because a signal handler reads it and it is sent through a socket.
struct FinalReports
{
    std::uint32_t slot = 0, count = 0;   // count 0: disarmed
    std::array<std::uint16_t, Failsafe::most_reports> sizes {};
    std::array<std::uint8_t, Failsafe::most_reports> is_feature {};
    std::array<std::uint8_t, Failsafe::most_bytes> bytes {};
};

struct Entry
{
    std::atomic<int> file { -1 };   // `reports` is valid only while this is an open file
    FinalReports reports;
};

std::array<Entry, Failsafe::most_devices> armed;
static_assert (std::atomic<int>::is_always_lock_free, "a signal handler reads it");

std::mutex changing;
int to_guardian = -1;

constexpr std::array faults { SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL };
std::array<struct sigaction, faults.size()> handled_before;

void write (int file, const FinalReports& reports) noexcept
{
    const auto* at = reports.bytes.data();
    for (std::size_t i = 0; i < reports.count; at += reports.sizes[i++])
        if (reports.is_feature[i] != 0)
            (void)::ioctl (file, HIDIOCSFEATURE (reports.sizes[i]), at);
        else if (::write (file, at, reports.sizes[i]) < 0)
            continue;   // there is nothing left to report the error to
}

void writeAll() noexcept
{
    for (const auto& entry : armed)
        if (const int file = entry.file.load(); file >= 0) write (file, entry.reports);
}

extern "C" void afterFault (int signal)
{
    const int kept = errno;
    writeAll();
    for (std::size_t i = 0; i < faults.size(); ++i)
        if (faults[i] == signal) ::sigaction (signal, &handled_before[i], nullptr);
    errno = kept;
    ::raise (signal);   // takes effect when this handler returns
}

/// Receives a message and, if it arms a failsafe, the device file. False once the other end is closed.
bool receive (int from, FinalReports& reports, int& file) noexcept
{
    iovec part { &reports, sizeof reports };
    alignas (cmsghdr) std::array<char, CMSG_SPACE (sizeof (int))> room {};
    msghdr message {};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = room.data();
    message.msg_controllen = room.size();

    ssize_t got = 0;
    while ((got = ::recvmsg (from, &message, 0)) < 0 && errno == EINTR)
        ;
    if (got != sizeof reports) return false;

    file = -1;
    if (const auto* header = CMSG_FIRSTHDR (&message); header != nullptr && header->cmsg_type == SCM_RIGHTS)
        std::memcpy (&file, CMSG_DATA (header), sizeof file);
    return true;
}

bool send (int to, const FinalReports& reports, int file) noexcept
{
    FinalReports copy = reports;
    iovec part { &copy, sizeof copy };
    alignas (cmsghdr) std::array<char, CMSG_SPACE (sizeof (int))> room {};
    msghdr message {};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    if (file >= 0)
    {
        message.msg_control = room.data();
        message.msg_controllen = room.size();
        auto* const header = CMSG_FIRSTHDR (&message);
        header->cmsg_level = SOL_SOCKET;
        header->cmsg_type = SCM_RIGHTS;
        header->cmsg_len = CMSG_LEN (sizeof file);
        std::memcpy (CMSG_DATA (header), &file, sizeof file);
    }
    return ::sendmsg (to, &message, MSG_NOSIGNAL) == sizeof copy;
}

/// The whole guardian process. It is forked from a process with threads, so nothing here may allocate or lock. It has its own
/// copy of `armed`.
[[noreturn]] void guard (int socket) noexcept
{
    // Ctrl-C is meant for the other process. Files that the other process has open must not stay open here.
    ::setsid();
    for (const int signal : { SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGQUIT })
        ::signal (signal, SIG_IGN);
    for (const int signal : faults)
        ::signal (signal, SIG_DFL);
    ::prctl (PR_SET_NAME, "tactus-guardian");
    if (::chdir ("/") != 0) ::_exit (1);
    if (socket != 0) ::dup2 (socket, 0);
    ::close_range (1, ~0U, 0);

    for (auto& entry : armed)
        entry.file = -1;

    static FinalReports reports;
    int file = -1;
    while (receive (0, reports, file))
    {
        if (reports.slot >= armed.size()) continue;
        auto& entry = armed[reports.slot];
        if (const int old = entry.file.exchange (-1); old >= 0) ::close (old);
        entry.reports = reports;
        if (reports.count > 0) entry.file = file;
    }
    writeAll();
    ::_exit (0);
}

std::string reason (int error) { return std::generic_category().message (error); }

/// Starts the guardian if there is none yet. Returns why this failed; empty if it did not. [with `changing` held]
std::string needGuardian()
{
    if (to_guardian >= 0) return {};
    std::array<int, 2> ends {};
    if (::socketpair (AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) return reason (errno);
    const auto child = ::fork();
    if (child == 0)
    {
        ::close (ends[0]);
        guard (ends[1]);
    }
    ::close (ends[1]);
    if (child < 0)
    {
        const auto why = reason (errno);
        ::close (ends[0]);
        return why;
    }
    to_guardian = ends[0];

    for (std::size_t i = 0; i < faults.size(); ++i)
    {
        struct sigaction action
        {
        };
        action.sa_handler = afterFault;
        ::sigaction (faults[i], &action, &handled_before[i]);
    }
    return {};
}
}   // namespace

Result<Failsafe> Failsafe::arm (const std::string& device_file, const std::vector<Report>& reports)
{
    const auto failed = [&] (std::string why) { return Message::error ("device/failsafe", device_file, std::move (why)); };

    const std::lock_guard lock (changing);
    std::size_t slot = 0, used = 0;
    while (slot < armed.size() && armed[slot].file.load() >= 0)
        ++slot;
    if (slot == armed.size()) return failed ("too many devices are open");

    auto& entry = armed[slot];
    auto& final = entry.reports;
    final = { .slot = static_cast<std::uint32_t> (slot), .count = static_cast<std::uint32_t> (reports.size()) };
    for (std::size_t i = 0; i < reports.size(); ++i)
    {
        const auto& r = reports[i];
        if (i == most_reports || used + r.bytes.size() > most_bytes) return failed ("there are too many reports");
        final.sizes[i] = static_cast<std::uint16_t> (r.bytes.size());
        final.is_feature[i] = r.is_feature;
        if (! r.bytes.empty()) std::memcpy (final.bytes.data() + used, r.bytes.data(), r.bytes.size());
        used += r.bytes.size();
    }

    const int file = ::open (device_file.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) return failed (reason (errno));
    auto why = needGuardian();
    if (why.empty() && ! send (to_guardian, final, file)) why = "the guardian process has died";
    if (! why.empty())
    {
        ::close (file);
        return failed (why);
    }
    entry.file = file;
    return Failsafe (static_cast<int> (slot));
}

Failsafe::~Failsafe()
{
    if (slot == none) return;
    const std::lock_guard lock (changing);
    auto& entry = armed[static_cast<std::size_t> (slot)];
    if (const int file = entry.file.exchange (-1); file >= 0) ::close (file);
    send (to_guardian, { .slot = static_cast<std::uint32_t> (slot), .count = 0 }, -1);
}

#else

Result<Failsafe> Failsafe::arm (const std::string& device_file, const std::vector<Report>&)
{
    return Message::error ("device/failsafe", device_file, "there is no failsafe on this system");
}

Failsafe::~Failsafe() = default;

#endif

Failsafe::Failsafe (Failsafe&& other) noexcept : slot (std::exchange (other.slot, none))
{
}

Failsafe& Failsafe::operator= (Failsafe&& other) noexcept
{
    std::swap (slot, other.slot);
    return *this;
}

}   // namespace tactus::host
