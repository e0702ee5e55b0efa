// SPDX-License-Identifier: MIT
#include "failsafe.hpp"
#include "guardian.hpp"
#include "last_failsafe.hpp"
#include <host/base/platform/preset_folder.hpp>

#include <tactus/text/caught.hpp>

#include <atomic>
#include <utility>

#if defined(__linux__)
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#endif

namespace tactus::host
{

#if defined(__linux__)

using guardian::faults;
using guardian::FinalReports;
using guardian::SharedState;

namespace
{
struct Entry
{
    std::atomic<int> file { -1 };   // `reports` is valid only while this is an open file
    FinalReports reports;
};

std::array<Entry, Failsafe::most_devices> armed;
static_assert (std::atomic<int>::is_always_lock_free, "a signal handler reads it");

constexpr std::int64_t shortest_sleep = 50'000'000;           // ns; far longer than the time between the two readings of hasSleptFor()
constexpr int look_apart_ms = 100, looks_until_frozen = 20;   // at the guardian; 2 s, so that a busy computer does not look like a frozen guardian
constexpr std::int64_t longest_pause = 1'000'000'000;         // ns between two beats; longer than `patience`: the guardian must have been frozen too

std::mutex changing;
std::atomic<SharedState*> shared { nullptr };   // from the first guardian on
int to_guardian = -1, memory_file = -1;
pid_t guardian_process = -1;
std::atomic<bool> is_child { false };   // of a process that used devices before it forked
bool handles_faults = false, is_watched = false;
std::string why_unguarded;   // why the last guardian could not be started; empty: it was

std::array<struct sigaction, faults.size()> handled_before;

std::int64_t nanoseconds (clockid_t clock) noexcept
{
    timespec now {};
    ::clock_gettime (clock, &now);
    return std::int64_t { now.tv_sec } * 1'000'000'000 + now.tv_nsec;
}

/// The steady clock pauses while the computer sleeps, and CLOCK_BOOTTIME does not. Read in this order, so that a delay between the
/// two readings looks like less sleep, never like more.
std::int64_t hasSleptFor() noexcept
{
    const auto with_sleep = nanoseconds (CLOCK_BOOTTIME);
    return with_sleep - nanoseconds (CLOCK_MONOTONIC);
}

void noticeSleep (SharedState& with) noexcept
{
    const auto now = hasSleptFor();
    auto before = with.asleep.load();
    if (now - before > shortest_sleep && with.asleep.compare_exchange_strong (before, now)) with.raiseAlarm (SharedState::Cause::slept, now - before);
}

void writeAll() noexcept
{
    for (const auto& entry : armed)
        if (const int file = entry.file.load(); file >= 0) guardian::write (file, entry.reports);
}

/// Writes the last reports, and then calls the handler that was there before ours. If that one faults or calls ours again, the default action follows.
extern "C" void afterFault (int signal, siginfo_t* info, void* context)
{
    static std::array<volatile std::sig_atomic_t, faults.size()> handling {};
    const int kept = errno;
    writeAll();
    const auto at = static_cast<std::size_t> (std::ranges::find (faults, signal) - faults.begin());
    const auto& before = handled_before[at];
    const bool is_default = (before.sa_flags & SA_SIGINFO) == 0 && (before.sa_handler == SIG_DFL || before.sa_handler == SIG_IGN);
    if (is_default || handling[at] != 0)
    {
        ::signal (signal, SIG_DFL);
        errno = kept;
        ::raise (signal);   // takes effect when this handler returns
        return;
    }
    handling[at] = 1;
    errno = kept;
    if ((before.sa_flags & SA_SIGINFO) != 0)
        before.sa_sigaction (signal, info, context);
    else
        before.sa_handler (signal);
    handling[at] = 0;   // a program that goes on after a fault, as those in managed languages do
}

std::string reason (int error) { return std::generic_category().message (error); }

/// Starts a guardian with these two files, in a session of its own, and with all signals blocked. Returns an errno; 0 if it worked.
int spawn (const char* program, int socket, pid_t& child)
{
    posix_spawn_file_actions_t files;
    posix_spawnattr_t how;
    sigset_t all;
    ::sigfillset (&all);
    ::posix_spawn_file_actions_init (&files);
    ::posix_spawnattr_init (&how);
    const int free = std::max ({ socket, memory_file, guardian::memory_file }) + 1;   // each file may have the number that the other one gets
    ::posix_spawn_file_actions_adddup2 (&files, memory_file, free);
    ::posix_spawn_file_actions_adddup2 (&files, socket, guardian::message_socket);
    ::posix_spawn_file_actions_adddup2 (&files, free, guardian::memory_file);
    ::posix_spawnattr_setflags (&how, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSID);
    ::posix_spawnattr_setsigmask (&how, &all);
    std::string name = guardian::program_name, notes = lastFailsafeFile().string();
    std::array<char*, 3> arguments { name.data(), notes.data(), nullptr };
    std::array<char*, 1> environment { nullptr };
    const int error = ::posix_spawn (&child, program, &files, &how, arguments.data(), environment.data());
    ::posix_spawnattr_destroy (&how);
    ::posix_spawn_file_actions_destroy (&files);
    return error;
}

/// Starts a guardian and gives it what is armed. Returns why it cannot; empty if it worked. [with `changing` held]
std::string tryGuardian()
{
    const auto name = std::string (guardian::program_name);
    const auto program = shipped ({ name, "../libexec/tactus/" + name });
    if (program.empty()) return "the program " + name + " is not next to those of Tactus";
    std::array<int, 2> ends {};
    if (::socketpair (AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) return reason (errno);
    pid_t child = -1;
    const int error = spawn (program.c_str(), ends[1], child);
    ::close (ends[1]);
    if (error != 0)
    {
        ::close (ends[0]);
        return program.string() + ": " + reason (error);
    }
    to_guardian = ends[0];
    guardian_process = child;
    for (std::size_t i = 0; i < armed.size(); ++i)
        if (const int file = armed[i].file.load(); file >= 0)
        {
            auto reports = armed[i].reports;
            reports.due = shared.load()->beats[i] == SharedState::taken ? 1 : 0;   // the killed guardian may not have written them
            guardian::send (to_guardian, reports, file);
        }
    return {};
}

/// The same without exceptions; notes the answer. [with `changing` held]
bool startGuardian()
{
    auto started = caught ("the guardian", tryGuardian);
    why_unguarded = started ? *started : started.error().text;
    return why_unguarded.empty();
}

/// Waits until the guardian is dead. Kills it if it gives no sign of life: frozen, it would let a force stay on. [without `changing` held]
void waitForEndOf (pid_t guardian, int socket) noexcept
{
    const auto& looks = shared.load()->looks;
    pollfd end { .fd = socket, .events = 0, .revents = 0 };
    auto seen = looks.load();
    for (int same = 0;;)
    {
        const int ready = ::poll (&end, 1, look_apart_ms);
        if (ready > 0) break;
        if (ready < 0) continue;
        const auto now = looks.load();
        same = now == seen ? same + 1 : 0;
        seen = now;
        if (same == looks_until_frozen) ::kill (guardian, SIGKILL);
    }
}

/// Runs on a thread, and replaces the guardian whenever someone kills or freezes it. As long as that fails, the alarm is raised again and again.
/// Nothing rearms within a second of an alarm, so the forces stay at zero.
void watchGuardian()
{
    constexpr auto pause = std::chrono::milliseconds (250);
    std::unique_lock lock (changing);
    for (;;)
    {
        if (to_guardian >= 0)
        {
            const auto socket = to_guardian;
            const auto child = guardian_process;
            const auto began = std::chrono::steady_clock::now();
            lock.unlock();
            waitForEndOf (child, socket);
            shared.load()->raiseAlarm (SharedState::Cause::unguarded, 0);
            ::waitpid (child, nullptr, 0);
            if (std::chrono::steady_clock::now() - began < pause) std::this_thread::sleep_for (pause);   // it ends as soon as it starts
            lock.lock();
            ::close (std::exchange (to_guardian, -1));
        }
        while (to_guardian < 0)
            if (! startGuardian())
            {
                shared.load()->raiseAlarm (SharedState::Cause::unguarded, 1);
                lock.unlock();
                std::this_thread::sleep_for (pause);
                lock.lock();
            }
    }
}

/// Forgets everything in the child of a fork: the devices and the guardian are the parent's, and the child has none of the threads. Otherwise the
/// guardian would not notice the end of the parent while the child lives, and a fault of the child would write to the parent's devices.
void forgetInChild() noexcept
{
    for (auto& entry : armed)
        if (const int file = entry.file.exchange (-1); file >= 0) ::close (file);
    if (to_guardian >= 0) ::close (std::exchange (to_guardian, -1));
    if (memory_file >= 0) ::close (std::exchange (memory_file, -1));
    is_child = true;
}

/// Creates the memory that is shared with the guardians. Returns an errno; 0 if it worked. [with `changing` held]
int shareMemory()
{
    memory_file = ::memfd_create ("tactus", MFD_CLOEXEC);
    if (memory_file < 0 || ::ftruncate (memory_file, sizeof (SharedState)) != 0) return errno;
    void* const memory = ::mmap (nullptr, sizeof (SharedState), PROT_READ | PROT_WRITE, MAP_SHARED, memory_file, 0);
    if (memory == MAP_FAILED) return errno;
    auto* const fresh = new (memory) SharedState;
    fresh->asleep = hasSleptFor();
    shared = fresh;
    return 0;
}

/// Starts the first guardian and the thread that watches it, unless they are there. Returns why this failed; empty if it did not. [with `changing`
/// held]
std::string needGuardian()
{
    static const int forks = ::pthread_atfork ([] { changing.lock(); }, [] { changing.unlock(); },
                                               [] {
                                                   forgetInChild();
                                                   changing.unlock();
                                               });
    if (forks != 0) return reason (forks);
    if (shared.load() == nullptr)
        if (const int error = shareMemory(); error != 0) return reason (error);
    if (guardian_process < 0 && ! startGuardian()) return why_unguarded;   // if it has just died, watchGuardian() starts another one
    if (is_watched) return {};
    const auto watched = caught ("the watch over the guardian", [] {
        std::thread ([] {
            for (;;)
                if (! caught ("the watch over the guardian", watchGuardian)) shared.load()->raiseAlarm (SharedState::Cause::unguarded, 1);
        }).detach();
    });
    is_watched = watched.has_value();
    return is_watched ? std::string() : watched.error().text;
}

/// Sets the handlers of faults while anything is armed. Then restores the previous ones, unless ours have been replaced. [with `changing` held]
void handleFaults (bool on) noexcept
{
    if (std::exchange (handles_faults, on) == on) return;
    for (std::size_t i = 0; i < faults.size(); ++i)
    {
        struct sigaction ours
        {
        };
        ours.sa_sigaction = afterFault;
        ours.sa_flags = SA_SIGINFO | SA_ONSTACK;   // a program may have a stack for handlers, and its handler may need it
        struct sigaction now
        {
        };
        if (on)
            ::sigaction (faults[i], &ours, &handled_before[i]);
        else if (::sigaction (faults[i], nullptr, &now) == 0 && (now.sa_flags & SA_SIGINFO) != 0 && now.sa_sigaction == afterFault)
            ::sigaction (faults[i], &handled_before[i], nullptr);
    }
}

std::string whyUnguarded()
{
    const std::lock_guard lock (changing);
    return why_unguarded;
}

bool isAnythingArmed() noexcept
{
    return std::ranges::any_of (armed, [] (const auto& entry) { return entry.file.load() >= 0; });
}
}   // namespace

Result<Failsafe> Failsafe::arm (const std::string& device_file, const std::vector<Report>& reports)
{
    const int file = ::open (device_file.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);   // a tty must not become that of this session
    if (file < 0) return Message::error ("device/failsafe", device_file, reason (errno));
    auto failsafe = arm (file, device_file, reports);
    ::close (file);
    return failsafe;
}

Result<Failsafe> Failsafe::arm (int descriptor, const std::string& name, const std::vector<Report>& reports)
{
    const auto failed = [&] (std::string why) { return Message::error ("device/failsafe", name, std::move (why)); };

    if (is_child) return failed ("a process that was forked from one that has used devices cannot open devices; start a new one");
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

    const int file = ::fcntl (descriptor, F_DUPFD_CLOEXEC, 0);
    if (file < 0) return failed (reason (errno));
    auto why = needGuardian();
    if (why.empty())
    {
        noticeSleep (*shared.load());
        shared.load()->beats[slot] = SharedState::at_rest;
        // If the guardian has just died, the next one gets everything that is armed.
        if (! guardian::send (to_guardian, final, file) && errno != EPIPE && errno != EBADF) why = reason (errno);
    }
    if (! why.empty())
    {
        ::close (file);
        return failed (why);
    }
    entry.file = file;
    handleFaults (true);
    return Failsafe (static_cast<int> (slot), shared.load()->asleep);
}

Failsafe::~Failsafe()
{
    if (slot == none || is_child) return;
    const std::lock_guard lock (changing);
    auto& entry = armed[static_cast<std::size_t> (slot)];
    const bool is_driven = shared.load()->beats[static_cast<std::size_t> (slot)].exchange (SharedState::at_rest) > SharedState::at_rest;
    if (const int file = entry.file.exchange (-1); file >= 0) ::close (file);
    guardian::send (to_guardian, { .slot = static_cast<std::uint32_t> (slot), .count = 0, .due = is_driven ? 1u : 0u }, -1);
    if (! isAnythingArmed()) handleFaults (false);
}

bool Failsafe::beat (bool driven) noexcept
{
    if (slot == none) return true;
    auto& with = *shared.load();
    noticeSleep (with);
    if (is_child) return false;
    const auto now = nanoseconds (CLOCK_MONOTONIC);
    auto& latest = with.beats[static_cast<std::size_t> (slot)];
    auto before = latest.load();
    if (before > SharedState::at_rest && now - before > longest_pause && latest.compare_exchange_strong (before, SharedState::taken))
        with.raiseAlarm (SharedState::Cause::frozen, before);
    const bool is_ours = before != SharedState::taken && latest.compare_exchange_strong (before, driven ? now : SharedState::at_rest);
    return is_ours && with.asleep == asleep;
}

std::uint32_t Failsafe::alarms() noexcept
{
    const auto* with = shared.load();
    return with == nullptr ? 0 : with->alarms.load();
}

Message Failsafe::alarm()
{
    constexpr auto remedy = "make sure that forces may safely return, then rearm";
    const auto* with = shared.load();
    if (with == nullptr) return {};
    const auto detail = with->detail.load();
    const auto inMs = [] (std::int64_t ns) { return std::to_string (ns / 1'000'000) + " ms"; };
    switch (with->cause.load())
    {
    case SharedState::Cause::frozen:
        return Message::warning ("run/frozen", {},
                                 "this program did not serve a device for " + inMs (nanoseconds (CLOCK_MONOTONIC) - detail)
                                     + ", because it was suspended or the computer or the device was too busy, so the device was brought to rest; all"
                                       " forces are held at zero",
                                 remedy);
    case SharedState::Cause::unguarded:
        return Message::warning ("run/unguarded", {},
                                 "the guardian process, which brings the devices to rest if this program dies, has been killed or frozen; "
                                     + (detail == 0 ? "another one takes its place" : "another one cannot be started: " + whyUnguarded())
                                     + "; all forces are held at zero",
                                 remedy);
    case SharedState::Cause::slept:
        return Message::warning ("run/slept", {}, "the computer was suspended for " + inMs (detail) + "; all forces are held at zero", remedy);
    }
    return {};
}

#else

namespace
{
std::atomic<bool> is_unguarded_allowed { false };
}

void Failsafe::allowUnguarded() noexcept { is_unguarded_allowed = true; }

Result<Failsafe> Failsafe::arm (const std::string& device_file, const std::vector<Report>&)
{
    if (is_unguarded_allowed) return Message::error ("device/no_failsafe", device_file, "there is no failsafe on this system");
    return Message::error ("device/failsafe", device_file,
                           "Tactus has no guardian process on this system, which would bring a device with forces to rest, and no such device was tried here",
                           "use Linux; or give `tactus play` the option --untried, and keep a hand on a switch for the supply of the motors");
}

Result<Failsafe> Failsafe::arm (int, const std::string& name, const std::vector<Report>& reports) { return arm (name, reports); }

Failsafe::~Failsafe() = default;
bool Failsafe::beat (bool) noexcept { return true; }
std::uint32_t Failsafe::alarms() noexcept { return 0; }
Message Failsafe::alarm() { return {}; }

#endif

Failsafe::Failsafe (Failsafe&& other) noexcept : slot (std::exchange (other.slot, none)), asleep (other.asleep)
{
}

Failsafe& Failsafe::operator= (Failsafe&& other) noexcept
{
    std::swap (slot, other.slot);
    std::swap (asleep, other.asleep);
    return *this;
}

}   // namespace tactus::host
