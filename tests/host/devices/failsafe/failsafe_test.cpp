// SPDX-License-Identifier: MIT
#include "support/guardian.hpp"
#include "support/no_system_calls.hpp"
#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <host/devices/failsafe/failsafe.hpp>
#include <host/devices/failsafe/last_failsafe.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <sstream>
#include <string_view>

#include <fcntl.h>
#include <sched.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace tactus;
using host::Failsafe;
using test::eventually;

namespace
{
std::string contentOf (const std::string& file)
{
    std::ifstream in (file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

std::vector<Failsafe::Report> rest() { return { { { 'r', 'e', 's', 't' }, false }, { { '!' }, false } }; }

/// True if the file has this content. A forked process may call it: it takes no memory, whose lock another thread may have held at the fork.
bool holds (const char* file, std::string_view content)
{
    std::array<char, 64> bytes;
    const int in = ::open (file, O_RDONLY | O_CLOEXEC);
    if (in < 0) return false;
    const auto count = ::read (in, bytes.data(), bytes.size());
    ::close (in);
    return count >= 0 && std::string_view (bytes.data(), static_cast<std::size_t> (count)) == content;
}

/// Suspends this process, with all its threads, until the other function returns. `freeze` sends the signal.
void freezeDuring (const std::function<void()>& freeze, const std::function<void()>& wait)
{
    const auto frozen = ::getpid();
    const auto waker = ::fork();
    if (waker == 0)
    {
        ::setpgid (0, 0);
        wait();
        ::kill (frozen, SIGCONT);
        ::_exit (0);
    }
    ::setpgid (waker, waker);   // here too, because the signal may come before the waker has done it
    freeze();
    ::waitpid (waker, nullptr, 0);
}

/// Suspends this process until the file has this content.
void freezeUntil (
    const std::string& file, const std::string& content, const std::function<void()>& freeze = [] { ::raise (SIGSTOP); })
{
    freezeDuring (freeze, [&] { eventually ([&] { return holds (file.c_str(), content); }); });
}

/// Makes it look to the child processes of this one as if the computer had slept for 100 s. False if the system refuses.
bool letChildrenSleep()
{
    constexpr int new_time = 0x80;   // CLONE_NEWTIME, which older headers lack
    if (::unshare (CLONE_NEWUSER | new_time) != 0 && ::unshare (new_time) != 0) return false;
    return static_cast<bool> (std::ofstream ("/proc/self/timens_offsets") << "boottime 100 0" << std::flush);
}

/// Forks a process that arms a failsafe on a file and dies. Returns what was written to the file, or with which status the process has ended by
/// itself.
std::string afterDying (const std::string& file, const std::function<void()>& die, const std::string& awaited)
{
    std::ofstream { file }.close();
    const auto end = test::inChild ([&] {
        for (const int fault : { SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL })
            ::signal (fault, SIG_DFL);   // without the test runner's handlers
        const auto failsafe = Failsafe::arm (file, rest());
        if (! failsafe) return 1;
        die();
        return 2;
    });
    if (end.status > 0) return "status " + std::to_string (end.status);
    eventually ([&] { return contentOf (file) == awaited; });   // the guardian writes a moment later
    return contentOf (file);
}
}   // namespace

TEST_CASE ("a killed process leaves its device at rest", "[platform]")
{
    const TemporaryFolder folder;
    const auto file = (folder / "device").string();
    CHECK (afterDying (
               file, [] { ::kill (::getpid(), SIGKILL); },
               "rest!")
           == "rest!");
}

TEST_CASE ("the guardian notes when and why it brought a device to rest", "[platform]")
{
    const TemporaryFolder folder;
    const auto file = (folder / "device").string();
    const auto* const before = std::getenv ("TACTUS_HOME");
    const std::string kept = before != nullptr ? before : "";
    ::setenv ("TACTUS_HOME", (folder / "home").c_str(), 1);
    CHECK (host::lastFailsafe().empty());
    CHECK (afterDying (
               file, [] { ::kill (::getpid(), SIGKILL); }, "rest!")
           == "rest!");
    CHECK (eventually ([] { return host::lastFailsafe().ends_with ("Z the program ended without closing its devices"); }));
    const auto noted = host::lastFailsafe();

    const auto note = folder / "home" / "last_failsafe.txt", other = folder / "other";   // the guardian follows no link
    std::ofstream (other) << "mine";
    std::filesystem::remove (note);
    std::filesystem::create_symlink (other, note);
    CHECK (afterDying (
               file, [] { ::kill (::getpid(), SIGKILL); }, "rest!")
           == "rest!");
    CHECK (test::stays (std::chrono::milliseconds (100), [&] { return contentOf (other.string()) == "mine"; }));
    before != nullptr ? ::setenv ("TACTUS_HOME", kept.c_str(), 1) : ::unsetenv ("TACTUS_HOME");
    CHECK (noted.starts_with ("20"));
}

TEST_CASE ("a process that dies leaves its device at rest, even if a child of it lives on with all that it had open", "[platform]")
{
    const TemporaryFolder folder;
    const auto file = (folder / "device").string();
    const auto pid_file = (folder / "child").string();
    const auto forkThenDie = [&] {
        const auto child = ::fork();
        if (child == 0)
        {
            test::letPass (std::chrono::seconds (60));
            ::_exit (0);
        }
        std::ofstream (pid_file) << child << std::flush;
        ::kill (::getpid(), SIGKILL);
    };
    CHECK (afterDying (file, forkThenDie, "rest!") == "rest!");
    const int child = std::stoi (contentOf (pid_file));
    CHECK (::kill (child, SIGKILL) == 0);   // it was still there
}

TEST_CASE ("the child of a fork neither arms a device nor writes to those of its parent", "[platform]")
{
    const TemporaryFolder folder;
    const auto file = (folder / "device").string();
    std::ofstream { file }.close();
    const auto end = test::inChild ([&] {
        const auto failsafe = Failsafe::arm (file, rest());
        if (! failsafe) return 1;
        const auto child = ::fork();
        if (child == 0)
        {
            if (Failsafe::arm (file, rest())) ::_exit (3);
            ::signal (SIGSEGV, SIG_DFL);   // the default, after the handler that the child still has
            ::raise (SIGSEGV);
        }
        int status = 0;
        ::waitpid (child, &status, 0);
        if (! WIFSIGNALED (status)) return 4;
        return contentOf (file).empty() ? 0 : 5;
    });
    CHECK (end.status == 0);
}

TEST_CASE ("the handlers of a program run after the last reports, and are back when nothing is armed", "[platform]")
{
    const TemporaryFolder folder;
    const auto file = (folder / "device").string();
    std::ofstream { file }.close();
    static constexpr int by_handler = 42;
    const auto own = [] (int) { ::_exit (by_handler); };
    const auto faults = test::inChild ([&] {
        ::signal (SIGBUS, own);
        const auto failsafe = Failsafe::arm (file, rest());
        ::raise (SIGBUS);
        return 1;
    });
    CHECK (faults.status == by_handler);
    CHECK (eventually ([&] { return contentOf (file).starts_with ("rest!"); }));

    const auto restored = test::inChild ([&] {
        ::signal (SIGBUS, own);
        {
            const auto failsafe = Failsafe::arm (file, rest());
        }
        struct sigaction now
        {
        };
        ::sigaction (SIGBUS, nullptr, &now);
        if (now.sa_handler != static_cast<void (*) (int)> (own)) return 1;
        const auto again = Failsafe::arm (file, rest());
        ::signal (SIGBUS, SIG_IGN);   // the program takes over while a device is armed
        {
            auto moved = Failsafe::arm (file, rest());
        }
        ::sigaction (SIGBUS, nullptr, &now);
        return now.sa_handler == SIG_IGN ? 0 : 2;
    });
    CHECK (restored.status == 0);
}

TEST_CASE ("a device that is too busy for the last reports gets them as soon as it takes any", "[platform]")
{
    const TemporaryFolder folder;
    const auto path = (folder / "device").string();
    REQUIRE (::mkfifo (path.c_str(), 0600) == 0);
    const int device = ::open (path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    REQUIRE (device >= 0);
    std::array<char, 4096> some {};
    while (::write (device, some.data(), some.size()) > 0)   // until there is no room
        ;
    test::inChild ([&] {
        const auto failsafe = Failsafe::arm (path, rest());
        if (! failsafe) return 1;
        ::kill (::getpid(), SIGKILL);
        return 0;
    });
    test::letPass (std::chrono::milliseconds (100));   // the first tries fail
    std::string last;
    CHECK (eventually ([&] {
        for (ssize_t got = 0; (got = ::read (device, some.data(), some.size())) > 0;)
            last.append (some.data(), static_cast<std::size_t> (got));
        return last.ends_with ("rest!");
    }));
    ::close (device);
}

TEST_CASE ("a process that crashes brings its device to rest before it dies, and the guardian does so again", "[platform]")
{
    const TemporaryFolder folder;
    const auto file = (folder / "device").string();
    for (const int fault : { SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL })
    {
        INFO (fault);
        CHECK (afterDying (
                   file, [fault] { ::raise (fault); },
                   "rest!rest!")
               == "rest!rest!");
    }
}

TEST_CASE ("a process that disarms its failsafe writes nothing", "[platform]")
{
    const TemporaryFolder folder;
    const auto file = (folder / "device").string();
    std::ofstream { file }.close();
    test::inChild ([&] {
        {
            const auto failsafe = Failsafe::arm (file, rest());
        }
        ::kill (::getpid(), SIGKILL);
        return 0;
    });
    CHECK (test::stays (std::chrono::milliseconds (100), [&] { return contentOf (file).empty(); }));
}

TEST_CASE ("a device that is given up while it is driven is left to the guardian, until it takes its reports", "[platform]")
{
    const TemporaryFolder folder;
    const auto path = (folder / "device").string();
    REQUIRE (::mkfifo (path.c_str(), 0600) == 0);
    const int device = ::open (path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    REQUIRE (device >= 0);
    std::array<char, 4096> some {};
    while (::write (device, some.data(), some.size()) > 0)   // until there is no room
        ;
    const auto taken = [&] {
        std::string all;
        for (ssize_t got = 0; (got = ::read (device, some.data(), some.size())) > 0;)
            all.append (some.data(), static_cast<std::size_t> (got));
        return all;
    };
    const auto file = (folder / "next").string();
    std::ofstream { file }.close();
    const bool was_taken = GENERATE (false, true);
    CAPTURE (was_taken);
    const auto end = test::inChild ([&] {   // this process goes on
        auto failsafe = Failsafe::arm (path, rest());
        if (! failsafe || ! failsafe->beat (true)) return 1;
        if (was_taken && ! eventually ([] { return Failsafe::alarms() == 1; })) return 2;   // the guardian has taken it, and cannot write either
        {
            const auto given_up = std::move (*failsafe);
        }
        auto next = Failsafe::arm (file, rest());   // in the same slot
        if (! next || ! next->beat (false)) return 3;
        test::letPass (std::chrono::milliseconds (100));   // the first tries fail
        std::string last;
        if (! eventually ([&] { return (last += taken()).ends_with ("rest!"); })) return 4;
        return contentOf (file).empty() && Failsafe::alarms() == (was_taken ? 1 : 0) ? 0 : 5;
    });
    CHECK (end.status == 0);
    ::close (device);
}

TEST_CASE ("a guardian that replaces another one brings the devices to rest that the other one had taken", "[platform]")
{
    const TemporaryFolder folder;
    const auto path = (folder / "device").string();
    REQUIRE (::mkfifo (path.c_str(), 0600) == 0);
    const int device = ::open (path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    REQUIRE (device >= 0);
    std::array<char, 4096> some {};
    while (::write (device, some.data(), some.size()) > 0)
        ;
    const auto end = test::inChild ([&] {
        auto failsafe = Failsafe::arm (path, rest());
        if (! failsafe || ! failsafe->beat (true)) return 1;
        pid_t first = -1;
        if (! eventually ([&] { return (first = test::guardianOf (::getpid())) > 0 && Failsafe::alarms() == 1; })) return 2;
        ::kill (first, SIGKILL);
        if (! eventually ([] { return Failsafe::alarms() == 2; })) return 3;   // it is dead
        std::string last;
        return eventually ([&] {
            for (ssize_t got = 0; (got = ::read (device, some.data(), some.size())) > 0;)
                last.append (some.data(), static_cast<std::size_t> (got));
            return last.ends_with ("rest!");
        })
                   ? 0
                   : 4;
    });
    CHECK (end.status == 0);
    ::close (device);
}

TEST_CASE ("the guardian brings the device of a frozen process to rest, and the process finds out when it continues", "[platform]")
{
    const TemporaryFolder folder;
    const auto file = (folder / "device").string(), other = (folder / "other").string();
    std::ofstream { file }.close();
    std::ofstream { other }.close();
    const auto end = test::inChild ([&] {
        auto resting = Failsafe::arm (other, rest());   // armed first, so the guardian looks at it first
        auto driven = Failsafe::arm (file, rest());
        if (! resting || ! driven) return 1;
        if (! resting->beat (false) || ! driven->beat (true)) return 2;
        freezeUntil (file, "rest!");
        if (Failsafe::alarms() != 1 || Failsafe::alarm().id != "run/frozen") return 3;
        if (driven->beat (true) || driven->beat (false) || driven->beat (true)) return 4;
        if (! resting->beat (false)) return 5;
        driven = Failsafe::arm (file, rest());   // now the device belongs to this process again
        if (! driven || ! driven->beat (false) || Failsafe::alarms() != 1) return 6;
        return 0;
    });
    CHECK (end.status == 0);
    CHECK (contentOf (file) == "rest!");
    CHECK (contentOf (other).empty());
}

TEST_CASE ("a process that was frozen together with its guardian finds out when it continues", "[platform]")
{
    const TemporaryFolder folder;
    const auto file = (folder / "device").string();
    std::ofstream { file }.close();
    const auto end = test::inChild ([&] {
        auto failsafe = Failsafe::arm (file, rest());
        if (! failsafe || ! failsafe->beat (false)) return 1;
        pid_t guardian = -1;
        if (! eventually ([&] { return (guardian = test::guardianOf (::getpid())) > 0; })) return 2;
        ::kill (guardian, SIGSTOP);
        if (::waitpid (guardian, nullptr, WUNTRACED) != guardian) return 3;
        if (! failsafe->beat (true)) return 4;
        freezeDuring ([] { ::raise (SIGSTOP); }, [] { test::letPass (std::chrono::milliseconds (1100)); });
        const bool noticed = ! failsafe->beat (true) && ! failsafe->beat (false) && Failsafe::alarms() == 1 && Failsafe::alarm().id == "run/frozen";
        ::kill (guardian, SIGCONT);
        return noticed ? 0 : 5;
    });
    CHECK (end.status == 0);
    CHECK (contentOf (file).empty());
}

TEST_CASE ("a signal to the whole group of a process freezes it, but not the guardian, which brings the device to rest", "[platform]")
{
    const TemporaryFolder folder;
    for (const int signal : { SIGSTOP, SIGTSTP })   // SIGTSTP: Ctrl-Z
    {
        INFO (signal);
        const auto file = (folder / std::to_string (signal)).string();
        std::ofstream { file }.close();
        const auto end = test::inChild ([&] {
            ::setpgid (0, 0);   // or the test would be frozen too
            ::signal (signal, SIG_DFL);
            auto failsafe = Failsafe::arm (file, rest());
            if (! failsafe || ! eventually ([] { return test::guardianOf (::getpid()) > 0; }) || ! failsafe->beat (true)) return 1;
            freezeUntil (file, "rest!", [signal] { ::kill (0, signal); });
            return ! failsafe->beat (true) && Failsafe::alarms() == 1 && Failsafe::alarm().id == "run/frozen" ? 0 : 2;
        });
        CHECK (end.status == 0);
        CHECK (contentOf (file) == "rest!");
    }
}

TEST_CASE ("no signal but KILL, STOP and faults takes the guardian away from a device", "[platform]")
{
    const TemporaryFolder folder;
    const auto file = (folder / "device").string();
    const auto signalThenDie = [] {
        pid_t guardian = -1;
        if (! eventually ([&] { return (guardian = test::guardianOf (::getpid())) > 0; })) return;
        const std::array others { SIGKILL, SIGSTOP, SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL };
        for (int signal = 1; signal <= SIGRTMAX; ++signal)   // those just below SIGRTMIN belong to the C library
            if ((signal <= SIGSYS || signal >= SIGRTMIN) && std::ranges::count (others, signal) == 0) ::kill (guardian, signal);
        ::kill (::getpid(), SIGKILL);
    };
    CHECK (afterDying (file, signalThenDie, "rest!") == "rest!");
}

TEST_CASE ("if the guardian is killed or frozen, there is an alarm, and another one takes its place", "[platform]")
{
    const TemporaryFolder folder;
    const auto file = (folder / "device").string();
    const int signal = GENERATE (SIGKILL, SIGSTOP);
    INFO (signal);
    const auto loseGuardianFirst = [&] {
        const auto guardian = [] { return test::guardianOf (::getpid()); };
        pid_t first = -1;
        if (! eventually ([&] { return (first = guardian()) > 0; }) || Failsafe::alarms() != 0) ::_exit (3);
        ::kill (first, signal);
        const auto hasNext = [&] {
            const auto now = guardian();   // read once: a process that is being killed raises the alarm before it is gone
            return now > 0 && now != first;
        };
        if (! eventually ([&] { return Failsafe::alarms() == 1 && hasNext(); })) ::_exit (4);
        if (! eventually ([] { return Failsafe::alarm().id == "run/unguarded"; })) ::_exit (5);
        static_cast<void> (Failsafe::arm (file, {}));   // returns only after the next guardian has been told everything
        ::kill (::getpid(), SIGKILL);
    };
    CHECK (afterDying (file, loseGuardianFirst, "rest!") == "rest!");
}

TEST_CASE ("a process finds out that the computer has slept, before it drives a device again", "[platform]")
{
    constexpr int refused = 77;
    const TemporaryFolder folder;
    const auto file = (folder / "device").string();
    std::ofstream { file }.close();
    const auto end = test::inChild ([&] {
        if (! letChildrenSleep()) return refused;
        auto failsafe = Failsafe::arm (file, rest());
        if (! failsafe || ! failsafe->beat (false) || Failsafe::alarms() != 0) return 1;
        const auto later = test::inChild ([&] {
            if (failsafe->beat (false) || failsafe->beat (false)) return 2;
            return Failsafe::alarms() == 1 && Failsafe::alarm().id == "run/slept" ? 0 : 3;
        });
        return later.status;
    });
    if (end.status == refused)
        WARN ("skipped: time namespaces are not available here");
    else
        CHECK (end.status == 0);
}
