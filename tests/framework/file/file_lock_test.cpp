// SPDX-License-Identifier: MIT
#include <tactus/file/file_lock.hpp>

#include <catch2/catch.hpp>

#ifndef _WIN32
#include <fcntl.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace tactus;

TEST_CASE ("a serial line that is locked does not become the terminal of a program without one, which would end when it is unplugged", "[file]")
{
    const int other_end = ::posix_openpt (O_RDWR | O_NOCTTY | O_CLOEXEC);
    REQUIRE (other_end >= 0);
    REQUIRE (::grantpt (other_end) == 0);
    REQUIRE (::unlockpt (other_end) == 0);
    const std::string line = ::ptsname (other_end);

    const auto child = ::fork();
    if (child == 0)   // as a service is, or a program that cron starts
    {
        ::setsid();
        const auto lock = FileLock::takeExisting (line);
        ::_exit (! lock ? 2 : ::open ("/dev/tty", O_RDWR) >= 0 ? 1
                                                               : 0);
    }
    int status = 0;
    REQUIRE (::waitpid (child, &status, 0) == child);
    CHECK (WIFEXITED (status));
    CHECK (WEXITSTATUS (status) == 0);
    ::close (other_end);
}
#endif
