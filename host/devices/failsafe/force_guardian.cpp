// SPDX-License-Identifier: MIT
// The guardian of a program that drives devices: a process of its own, which brings the devices to rest if the program dies or freezes. See
// host/devices/failsafe/failsafe.hpp.
#include <host/devices/failsafe/guardian.hpp>

#if defined(__linux__)
#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <utility>

using namespace tactus::host;
using guardian::FinalReports;
using guardian::SharedState;

namespace
{
constexpr int look_apart_ms = 10, looks_until_taken = static_cast<int> (Failsafe::patience.count()) / look_apart_ms;
constexpr int most_tries = 10'000 / look_apart_ms;   // a device that has not taken its reports after 10 s never will

struct ArmedDevice
{
    int file = -1;   // `reports` is valid only while this is an open file
    FinalReports reports {};
    std::uint32_t due = 0;   // the reports that are still to be written
    int tries = 0;
};
std::array<ArmedDevice, Failsafe::most_devices> armed;
std::array<ArmedDevice, Failsafe::most_devices> left;   // the program gave them up before they were at rest
std::size_t next_left = 0;

void close (ArmedDevice& device) noexcept
{
    if (device.file >= 0) ::close (device.file);
    device = {};
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

const char* notes = "";   // where note() writes

/// Notes when and why devices were brought to rest, for lastFailsafe(). Call after the reports are written.
void note (const char* cause) noexcept
{
    const int file = ::open (notes, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, S_IRUSR | S_IWUSR);
    if (file < 0) return;
    const auto now = ::time (nullptr);
    tm utc {};
    std::array<char, 100> line {};
    auto length = std::strftime (line.data(), line.size(), "%Y-%m-%dT%H:%M:%SZ ", ::gmtime_r (&now, &utc));
    length += static_cast<std::size_t> (std::snprintf (line.data() + length, line.size() - length, "%s\n", cause));
    static_cast<void> (::write (file, line.data(), length) < 0);   // it is only a note
    ::close (file);
}

/// Takes each device whose beats have stopped while an effort was on it. If a beat comes at the last moment, the exchange fails.
/// Later beats see that the device is taken, so the program and the guardian never both drive it. True if it has taken any.
bool lookAtBeats (SharedState& shared) noexcept
{
    bool has_taken = false;
    struct LastBeat
    {
        std::int64_t beat = SharedState::at_rest;
        int times = 0;
    };
    static std::array<LastBeat, Failsafe::most_devices> all;

    for (std::size_t i = 0; i < armed.size(); ++i)
    {
        auto beat = shared.beats[i].load();
        const bool stands_still = beat > SharedState::at_rest && beat == all[i].beat;
        all[i] = { beat, stands_still ? all[i].times + 1 : 0 };
        if (armed[i].file < 0 || all[i].times < looks_until_taken || ! shared.beats[i].compare_exchange_strong (beat, SharedState::taken)) continue;
        shared.raiseAlarm (SharedState::Cause::frozen, beat);
        armed[i].due = guardian::all_reports;
        has_taken = true;
    }
    return has_taken;
}

/// Writes the reports that are due. A device that is too busy for one is tried again the next time. True if there is a next time.
bool writeDue() noexcept
{
    bool again = false;
    const auto write = [&] (ArmedDevice& device) {
        if (device.file < 0 || device.due == 0) return;
        device.due = guardian::write (device.file, device.reports, device.due);
        if (++device.tries == most_tries) device.due = 0;
        again = again || device.due != 0;
    };
    for (auto& device : armed)
        write (device);
    for (auto& device : left)
    {
        write (device);
        if (device.due == 0) close (device);
    }
    return again;
}

/// Keeps a device whose slot becomes free, until its reports are written.
void keep (const ArmedDevice& device) noexcept
{
    auto& place = left[next_left++ % left.size()];   // if all are full, the oldest has been tried for the longest time
    close (place);
    place = device;
}

/// True if the message gives up a device that is driven.
bool takeOver (const FinalReports& reports, int file) noexcept
{
    if (reports.slot >= armed.size()) return false;
    auto& slot = armed[reports.slot];
    const bool is_given_up = reports.count == 0 && slot.file >= 0 && reports.due != 0;
    if (is_given_up) slot.due = guardian::all_reports;
    if (slot.due != 0)
        keep (std::exchange (slot, {}));
    else
        close (slot);
    if (reports.count > 0) slot = { file, reports, reports.due != 0 ? guardian::all_reports : 0, 0 };
    return is_given_up;
}

/// The memory that is shared with the program; null if it is not there.
SharedState* sharedMemory() noexcept
{
    struct stat about
    {
    };
    if (::fstat (guardian::memory_file, &about) != 0 || about.st_size < static_cast<off_t> (sizeof (SharedState))) return nullptr;
    void* const memory = ::mmap (nullptr, sizeof (SharedState), PROT_READ | PROT_WRITE, MAP_SHARED, guardian::memory_file, 0);
    return memory != MAP_FAILED ? static_cast<SharedState*> (memory) : nullptr;
}

/// Ctrl-C, Ctrl-Z and every signal to the process group, even SIGSTOP, are meant for the program: an own session keeps them away.
void ignoreSignals() noexcept
{
    ::setsid();
    for (int signal = 1; signal <= SIGRTMAX; ++signal)
        ::signal (signal, SIG_IGN);
    for (const int signal : guardian::faults)
        ::signal (signal, SIG_DFL);
    sigset_t all;
    sigfillset (&all);
    ::sigprocmask (SIG_UNBLOCK, &all, nullptr);
}
}   // namespace

int main (int count, char** arguments)
{
    ignoreSignals();
    if (count > 1) notes = arguments[1];
    auto* const shared = sharedMemory();
    if (shared == nullptr || ::chdir ("/") != 0) return 1;
    ::close_range (1, ~0U, 0);   // what the program had open must not stay open here

    static FinalReports reports;
    int file = -1;
    for (;;)
    {
        pollfd messages { .fd = guardian::message_socket, .events = POLLIN, .revents = 0 };
        const int ready = ::poll (&messages, 1, look_apart_ms);
        ++shared->looks;
        if (ready == 0)
        {
            const bool has_taken = lookAtBeats (*shared);
            writeDue();
            if (has_taken) note ("the program did not respond");
        }
        else if (ready > 0 && receive (guardian::message_socket, reports, file))
        {
            if (! takeOver (reports, file)) continue;
            writeDue();
            note ("the program gave up a device that was not at rest");
        }
        else if (ready > 0 || errno != EINTR)
            break;
    }
    bool has_any = false;
    for (auto& each : armed)
    {
        has_any = has_any || each.file >= 0;
        each.due = guardian::all_reports;
        each.tries = 0;
    }
    while (writeDue())
        ::poll (nullptr, 0, look_apart_ms);
    if (has_any) note ("the program ended without closing its devices");
    return 0;
}

#else
int main() { return 1; }
#endif
