// SPDX-License-Identifier: MIT
#include "terminal.hpp"

#if defined(_WIN32)
#include <io.h>
#include <windows.h>
#else
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>
#endif

namespace tactus::host
{

bool stderrIsTerminal() noexcept
{
#if defined(_WIN32)
    return _isatty (2) != 0;
#else
    return isatty (2) != 0;
#endif
}

int stderrColumns() noexcept
{
#if defined(_WIN32)
    CONSOLE_SCREEN_BUFFER_INFO screen;
    return GetConsoleScreenBufferInfo (GetStdHandle (STD_ERROR_HANDLE), &screen) ? screen.srWindow.Right - screen.srWindow.Left + 1 : 0;
#else
    winsize size {};
    return ioctl (2, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
#endif
}

#if defined(_WIN32)
struct Keys::SavedMode
{
};
Keys::Keys() = default;
Keys::~Keys() = default;
void Keys::restore() const noexcept {}
char Keys::next (std::chrono::milliseconds) noexcept { return 0; }
#else
struct Keys::SavedMode
{
    termios mode;
};

Keys::Keys()
{
    termios mode;
    if (isatty (STDIN_FILENO) == 0 || tcgetpgrp (STDIN_FILENO) != getpgrp() || tcgetattr (STDIN_FILENO, &mode) != 0) return;
    auto found = std::make_unique<SavedMode> (SavedMode { mode });
    mode.c_lflag &= ~static_cast<tcflag_t> (ICANON | ECHO);
    mode.c_cc[VMIN] = 1;   // a single key is enough; another program may have left a larger number here
    mode.c_cc[VTIME] = 0;
    if (tcsetattr (STDIN_FILENO, TCSANOW, &mode) == 0) before = std::move (found);
}

Keys::~Keys() { restore(); }

void Keys::restore() const noexcept
{
    if (before && tcgetpgrp (STDIN_FILENO) == getpgrp()) tcsetattr (STDIN_FILENO, TCSANOW, &before->mode);
}

char Keys::next (std::chrono::milliseconds patience) noexcept
{
    const auto ours = [] { return tcgetpgrp (STDIN_FILENO) == getpgrp(); };   // reading in the background would stop the program
    pollfd waiting { STDIN_FILENO, POLLIN, 0 };
    const bool any = before && poll (&waiting, 1, static_cast<int> (patience.count())) == 1;
    char key = 0;
    if (any && ours() && read (STDIN_FILENO, &key, 1) == 1) return key;
    if (any) poll (nullptr, 0, static_cast<int> (patience.count()));   // the terminal is closed or belongs to another program: sleep, do not spin
    return '\0';
}
#endif

}   // namespace tactus::host
