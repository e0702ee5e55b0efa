// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_gui_basics/juce_gui_basics.h>

#include <catch2/catch.hpp>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tactus::host::test
{

/// An X server without a physical screen. `name` is empty if it cannot be started.
struct Screen
{
    Screen()
    {
        int ends[2];
        if (pipe (ends) != 0) return;
        process = fork();
        if (process == 0)
        {
            ::close (ends[0]);
            const auto end = std::to_string (ends[1]);
            // Never :0, because JUCE would open it in the other tests, which have no DISPLAY and need none.
            const auto number = ":" + std::to_string (1000 + getpid() % 50'000);
            if (std::freopen ("/dev/null", "w", stderr) != nullptr)
                execlp ("Xvfb", "Xvfb", number.c_str(), "-displayfd", end.c_str(), "-screen", "0", "1280x720x24", "-nolisten", "tcp", nullptr);
            _exit (127);
        }
        ::close (ends[1]);
        std::string number;
        for (char digit = 0; ::read (ends[0], &digit, 1) == 1 && digit != '\n';)
            number += digit;
        if (! number.empty()) name = ":" + number;
        ::close (ends[0]);
    }
    ~Screen()
    {
        if (process <= 0) return;
        ::kill (process, SIGTERM);
        waitpid (process, nullptr, 0);
    }
    Screen (const Screen&) = delete;
    Screen& operator= (const Screen&) = delete;

    pid_t process = -1;
    std::string name;
};

// NOLINTBEGIN(cert-env33-c): these commands are of the tests themselves

/// Runs a hidden test case of this program in its own process, on a virtual screen. JUCE opens its display once per process.
inline void onScreen (const char* test)
{
    const Screen screen;
    if (screen.name.empty() || std::system ("command -v xdotool > /dev/null") != 0)
    {
        std::puts ("skipped: Xvfb does not start, or xdotool is not installed");
        return;
    }
    const auto command = "DISPLAY=" + screen.name + " " + std::filesystem::read_symlink ("/proc/self/exe").string() + " \"" + test + '"';
    CHECK (std::system (command.c_str()) == 0);
}

inline void xdo (const std::string& what) { REQUIRE (std::system (("xdotool " + what).c_str()) == 0); }
// NOLINTEND(cert-env33-c)

/// Starts JUCE as in an application: it then ignores the X errors that a screen without a window manager causes.
struct Application
{
    static bool isOne() noexcept
    {
        juce::JUCEApplicationBase::createInstance = []() -> juce::JUCEApplicationBase* { return nullptr; };
        return true;
    }

    const bool is_one = isOne();   // before JUCE opens the display
    const juce::ScopedJuceInitialiser_GUI juce_runs;
};

}   // namespace tactus::host::test
