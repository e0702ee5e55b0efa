// SPDX-License-Identifier: MIT
#include "support/no_system_calls.hpp"
#include "support/temporary_folder.hpp"

#include <host/platform/failsafe.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

#include <unistd.h>

using namespace tactus;
using host::Failsafe;

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

/// Forks a process that arms a failsafe on a file and dies. Returns what was written to the file.
std::string afterDying (const std::string& file, const std::function<void()>& die, const std::string& awaited)
{
    std::ofstream { file };
    test::inChild ([&] {
        for (const int fault : { SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL })
            ::signal (fault, SIG_DFL);   // without the test runner's handlers
        const auto failsafe = Failsafe::arm (file, rest());
        if (! failsafe) return 1;
        die();
        return 0;
    });
    for (int i = 0; i < 1000 && contentOf (file) != awaited; ++i)   // the guardian writes a moment later
        std::this_thread::sleep_for (std::chrono::milliseconds (2));
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
    std::ofstream { file };
    test::inChild ([&] {
        {
            const auto failsafe = Failsafe::arm (file, rest());
        }
        ::kill (::getpid(), SIGKILL);
        return 0;
    });
    std::this_thread::sleep_for (std::chrono::milliseconds (50));
    CHECK (contentOf (file).empty());
}
