// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "running.hpp"
#include "support/waiting.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tactus::test
{

/// A program with its own terminal, on which the test types. Its messages go to the terminal or to a file.
class OnTerminal
{
public:
    OnTerminal (const std::vector<std::string>& arguments, bool prints_on_it) : is_read (prints_on_it)
    {
        grantpt (hand);
        unlockpt (hand);
        const std::string name = ptsname (hand), messages = scratch.path ("err");
        paper = open (name.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
        std::vector<char*> words { const_cast<char*> (TACTUS_PROGRAM) };
        for (const auto& a : arguments)
            words.push_back (const_cast<char*> (a.c_str()));
        words.push_back (nullptr);

        process = fork();
        if (process != 0) return;
        setsid();
        const int terminal = open (name.c_str(), O_RDWR);
        ioctl (terminal, TIOCSCTTY, 0);
        dup2 (terminal, STDIN_FILENO);
        dup2 (open ("/dev/null", O_WRONLY), STDOUT_FILENO);
        dup2 (prints_on_it ? terminal : open (messages.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600), STDERR_FILENO);
        execvp (words[0], words.data());
        _exit (127);
    }

    ~OnTerminal()
    {
        if (process > 0)
        {
            kill (process, SIGKILL);
            waitpid (process, nullptr, 0);
        }
        close (paper);
        close (hand);
    }
    OnTerminal (const OnTerminal&) = delete;
    OnTerminal& operator= (const OnTerminal&) = delete;

    void type (const std::string& keys) const { REQUIRE (::write (hand, keys.data(), keys.size()) == static_cast<ssize_t> (keys.size())); }
    void signal (int number) const { kill (process, number); }

    /// All that it has printed so far.
    std::string err()
    {
        if (! is_read) return textOf (scratch.path ("err"));
        char bytes[4096];
        for (ssize_t size = 0; (size = ::read (hand, bytes, sizeof bytes)) > 0;)
            said.append (bytes, static_cast<std::size_t> (size));
        return said;
    }

    bool hasUnreadKeys() const
    {
        int waiting = 0;
        return ioctl (paper, FIONREAD, &waiting) != 0 || waiting > 0;
    }

    /// True while a signal waits for its handler.
    bool hasPending (int number) const
    {
        std::ifstream status (proc ("status"));
        unsigned long long pending = 0;
        for (std::string line; std::getline (status, line);)
            if (line.starts_with ("SigPnd:") || line.starts_with ("ShdPnd:")) pending |= std::stoull (line.substr (7), nullptr, 16);
        return (pending >> (number - 1) & 1) != 0;
    }

    std::ptrdiff_t threads() const
    {
        std::error_code failed;
        return std::distance (std::filesystem::directory_iterator (proc ("task"), failed), {});
    }

    /// Waits until it ends by itself. Returns its exit status.
    int finish()
    {
        int result = -1;
        const bool is_over = eventually (std::chrono::milliseconds (20), [&] {
            err();   // otherwise it would wait for the terminal
            return waitpid (process, &result, WNOHANG) != 0;
        });
        if (! is_over) return -1;
        process = -1;
        return WIFEXITED (result) ? WEXITSTATUS (result) : -WTERMSIG (result);
    }

private:
    std::string proc (const std::string& file) const { return "/proc/" + std::to_string (process) + "/" + file; }

    Scratch scratch;
    int hand = posix_openpt (O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC), paper = -1;
    pid_t process = -1;
    bool is_read;
    std::string said;
};

}   // namespace tactus::test
