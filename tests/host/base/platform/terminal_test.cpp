// SPDX-License-Identifier: MIT
#include "support/no_system_calls.hpp"

#include <host/base/platform/terminal.hpp>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

using namespace tactus;

namespace
{
/// A virtual terminal: whatever is written to `hand` arrives as typed input.
struct Typewriter
{
    int hand = posix_openpt (O_RDWR | O_NOCTTY);

    Typewriter()
    {
        grantpt (hand);
        unlockpt (hand);
    }
    ~Typewriter() { close (hand); }

    /// Makes it the terminal of this process, which is a child process.
    int become() const
    {
        setsid();
        const int paper = open (ptsname (hand), O_RDWR);
        ioctl (paper, TIOCSCTTY, 0);
        dup2 (paper, STDIN_FILENO);
        return paper;
    }
};

tcflag_t modeOf (int terminal)
{
    termios mode {};
    tcgetattr (terminal, &mode);
    return mode.c_lflag;
}
}   // namespace

TEST_CASE ("typed keys arrive one by one and are not echoed, and the terminal is restored afterwards", "[platform]")
{
    const Typewriter typewriter;
    if (typewriter.hand < 0)
    {
        WARN ("skipped: no terminal can be created here (/dev/ptmx, /dev/pts)");
        return;
    }
    const auto end = test::inChild ([&] {
        const int paper = typewriter.become();
        const auto before = modeOf (paper);
        {
            host::Keys keys;
            if (! keys.areThere()) return 1;
            if (modeOf (paper) & (ICANON | ECHO)) return 2;
            if (! (modeOf (paper) & ISIG)) return 3;   // Ctrl-C would not work
            if (keys.next() != 0) return 4;
            if (write (typewriter.hand, " r", 2) != 2) return 5;
            pollfd typed { STDIN_FILENO, POLLIN, 0 };
            poll (&typed, 1, 10000);
            if (keys.next() != ' ') return 6;
            if (keys.next() != 'r') return 7;
            if (keys.next() != 0) return 8;
        }
        return modeOf (paper) == before ? 0 : 9;
    });
    CHECK (end.signal == 0);
    CHECK (end.status == 0);
}

TEST_CASE ("without a terminal there are no keys", "[platform]")
{
    const auto end = test::inChild ([] {
        dup2 (open ("/dev/null", O_RDONLY), STDIN_FILENO);
        host::Keys keys;
        return ! keys.areThere() && keys.next() == 0 ? 0 : 1;
    });
    CHECK (end.status == 0);
}
