// SPDX-License-Identifier: GPL-3.0-or-later
#include "last_will.hpp"

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
/// Plain bytes, so that a signal handler may look at it and a socket carry it.
struct Will
{
    std::uint32_t slot = 0, count = 0;   // count 0: taken back
    std::array<std::uint16_t, LastWill::most_reports> sizes {};
    std::array<std::uint8_t, LastWill::most_reports> is_feature {};
    std::array<std::uint8_t, LastWill::most_bytes> bytes {};
};

struct Entry
{
    std::atomic<int> file { -1 };   // what is below is only there while this is
    Will will;
};

std::array<Entry, LastWill::most_wills> wills;
static_assert (std::atomic<int>::is_always_lock_free, "a signal handler reads it");

std::mutex changing;
int to_guardian = -1;

constexpr std::array faults { SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL };
std::array<struct sigaction, faults.size()> handled_before;

void execute (int file, const Will& will) noexcept
{
    const auto* at = will.bytes.data();
    for (std::size_t i = 0; i < will.count; at += will.sizes[i++])
        if (will.is_feature[i] != 0)
            (void)::ioctl (file, HIDIOCSFEATURE (will.sizes[i]), at);
        else if (::write (file, at, will.sizes[i]) < 0)
            continue;   // nobody is left to be told
}

void executeAll() noexcept
{
    for (const auto& entry : wills)
        if (const int file = entry.file.load(); file >= 0) execute (file, entry.will);
}

extern "C" void afterFault (int signal)
{
    const int kept = errno;
    executeAll();
    for (std::size_t i = 0; i < faults.size(); ++i)
        if (faults[i] == signal) ::sigaction (signal, &handled_before[i], nullptr);
    errno = kept;
    ::raise (signal);   // comes when this returns
}

/// A message and, for a will that is not taken back, the device file. False if there is nobody any more.
bool receive (int from, Will& will, int& file) noexcept
{
    iovec part { &will, sizeof will };
    alignas (cmsghdr) std::array<char, CMSG_SPACE (sizeof (int))> room {};
    msghdr message {};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = room.data();
    message.msg_controllen = room.size();

    ssize_t got = 0;
    while ((got = ::recvmsg (from, &message, 0)) < 0 && errno == EINTR)
        ;
    if (got != sizeof will) return false;

    file = -1;
    if (const auto* header = CMSG_FIRSTHDR (&message); header != nullptr && header->cmsg_type == SCM_RIGHTS) std::memcpy (&file, CMSG_DATA (header), sizeof file);
    return true;
}

bool send (int to, const Will& will, int file) noexcept
{
    Will copy = will;
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
    return ::sendmsg (to, &message, MSG_NOSIGNAL) == sizeof will;
}

/// All that the guardian does. It was forked from a process with threads, so nothing here may allocate or lock; it has a
/// copy of `wills` to itself.
[[noreturn]] void guard (int socket) noexcept
{
    // Ctrl-C is for the others. What else was open must not be kept open by this.
    ::setsid();
    for (const int signal : { SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGQUIT })
        ::signal (signal, SIG_IGN);
    for (const int signal : faults)
        ::signal (signal, SIG_DFL);
    ::prctl (PR_SET_NAME, "tactus-guardian");
    if (::chdir ("/") != 0) ::_exit (1);
    if (socket != 0) ::dup2 (socket, 0);
    ::close_range (1, ~0U, 0);

    for (auto& entry : wills)
        entry.file = -1;

    static Will will;   // of this process alone
    int file = -1;
    while (receive (0, will, file))
    {
        if (will.slot >= wills.size()) continue;
        auto& entry = wills[will.slot];
        if (const int old = entry.file.exchange (-1); old >= 0) ::close (old);
        entry.will = will;
        if (will.count > 0) entry.file = file;
    }
    executeAll();
    ::_exit (0);
}

std::string reason (int error) { return std::generic_category().message (error); }

/// Nothing, or why there is none. [with `changing` held]
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

tl::expected<LastWill, std::string> LastWill::leave (const std::string& device_file, const std::vector<Report>& reports)
{
    const std::lock_guard lock (changing);
    std::size_t slot = 0, used = 0;
    while (slot < wills.size() && wills[slot].file.load() >= 0)
        ++slot;
    if (slot == wills.size()) return tl::unexpected (std::string ("too many devices are open"));

    auto& entry = wills[slot];
    auto& will = entry.will;
    will = { .slot = static_cast<std::uint32_t> (slot), .count = static_cast<std::uint32_t> (reports.size()) };
    for (std::size_t i = 0; i < reports.size(); ++i)
    {
        const auto& r = reports[i];
        if (i == most_reports || used + r.bytes.size() > most_bytes) return tl::unexpected (std::string ("there are too many reports"));
        will.sizes[i] = static_cast<std::uint16_t> (r.bytes.size());
        will.is_feature[i] = r.is_feature;
        if (! r.bytes.empty()) std::memcpy (will.bytes.data() + used, r.bytes.data(), r.bytes.size());
        used += r.bytes.size();
    }

    const int file = ::open (device_file.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) return tl::unexpected (reason (errno));
    auto why = needGuardian();
    if (why.empty() && ! send (to_guardian, will, file)) why = "the guardian process has died";
    if (! why.empty())
    {
        ::close (file);
        return tl::unexpected (why);
    }
    entry.file = file;
    return LastWill (static_cast<int> (slot));
}

LastWill::~LastWill()
{
    if (slot == none) return;
    const std::lock_guard lock (changing);
    auto& entry = wills[static_cast<std::size_t> (slot)];
    if (const int file = entry.file.exchange (-1); file >= 0) ::close (file);
    send (to_guardian, { .slot = static_cast<std::uint32_t> (slot), .count = 0 }, -1);
}

#else

tl::expected<LastWill, std::string> LastWill::leave (const std::string&, const std::vector<Report>&)
{
    return tl::unexpected (std::string ("on this system nothing is written for a process that died"));
}

LastWill::~LastWill() = default;

#endif

LastWill::LastWill (LastWill&& other) noexcept : slot (std::exchange (other.slot, none))
{
}

LastWill& LastWill::operator= (LastWill&& other) noexcept
{
    std::swap (slot, other.slot);
    return *this;
}

}   // namespace tactus::host
