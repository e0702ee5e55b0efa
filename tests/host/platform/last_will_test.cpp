// SPDX-License-Identifier: MIT
#include "host/io/temporary_folder.hpp"
#include "support/no_system_calls.hpp"

#include <host/platform/last_will.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

#include <unistd.h>

using namespace tactus;
using host::LastWill;

namespace
{
std::string contentOf (const std::string& file)
{
    std::ifstream in (file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

std::vector<LastWill::Report> rest() { return { { { 'r', 'e', 's', 't' }, false }, { { '!' }, false } }; }

/// Dies as told, with a will left to a file; returns what is written there then.
std::string afterDying (const std::string& file, const std::function<void()>& die, const std::string& awaited)
{
    std::ofstream { file };
    test::inChild ([&]
                   {
        for (const int fault : { SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL })
            ::signal (fault, SIG_DFL);   // not what the test runner makes of it
        auto will = LastWill::leave (file, rest());
        if (! will) return 1;
        die();
        return 0; });
    for (int i = 0; i < 1000 && contentOf (file) != awaited; ++i)   // the guardian writes a moment later
        std::this_thread::sleep_for (std::chrono::milliseconds (2));
    return contentOf (file);
}
}   // namespace

TEST_CASE ("a process that is killed leaves its device at rest", "[platform]")
{
    const TemporaryFolder folder;
    const auto file = (folder / "device").string();
    CHECK (afterDying (
               file, []
               { ::kill (::getpid(), SIGKILL); },
               "rest!")
           == "rest!");
}

TEST_CASE ("a process that crashes leaves its device at rest before it dies, and the guardian makes sure", "[platform]")
{
    const TemporaryFolder folder;
    const auto file = (folder / "device").string();
    for (const int fault : { SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL })
    {
        INFO (fault);
        CHECK (afterDying (
                   file, [fault]
                   { ::raise (fault); },
                   "rest!rest!")
               == "rest!rest!");
    }
}

TEST_CASE ("a process that takes its will back leaves nothing behind", "[platform]")
{
    const TemporaryFolder folder;
    const auto file = (folder / "device").string();
    std::ofstream { file };
    test::inChild ([&]
                   {
        {
            const auto will = LastWill::leave (file, rest());
        }
        ::kill (::getpid(), SIGKILL);
        return 0; });
    std::this_thread::sleep_for (std::chrono::milliseconds (50));
    CHECK (contentOf (file).empty());
}
