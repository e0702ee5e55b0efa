// SPDX-License-Identifier: GPL-3.0-or-later
// A failed JUCE assertion is a bug in our code, so it aborts the test.
#include <juce_gui_basics/juce_gui_basics.h>

#define CATCH_CONFIG_EXTERNAL_INTERFACES   // for listeners
#include <catch2/catch.hpp>

#include <cstdlib>
#include <iostream>
#include <optional>

namespace
{
class Assertions final : public juce::Logger
{
    void logMessage (const juce::String& message) override
    {
        std::cerr << message << '\n';
        const bool of_display = message.contains ("XWindowSystem");      // no display, and a dialog opens its own window
        const bool at_exit = message.contains ("juce_Singleton.h:50");   // JUCE's shutdown creates the display singleton again and leaks it
        if (message.startsWith ("JUCE Assertion failure") && ! of_display && ! at_exit) std::abort();
    }
};

/// Installs the logger for the whole test run.
struct Watch
{
    Watch() { juce::Logger::setCurrentLogger (&logger); }
    ~Watch() { juce::Logger::setCurrentLogger (nullptr); }

    Assertions logger;
} watch;

/// Keeps JUCE alive from the first test to the last one. It cannot start twice on a display: its cursors and clipboard windows would be those
/// of a connection that has been closed.
struct KeepsJuce final : Catch::TestEventListenerBase
{
    using TestEventListenerBase::TestEventListenerBase;

    void testRunStarting (const Catch::TestRunInfo&) override
    {
        gui.emplace();
        ignoreXErrors();
    }
    void testRunEnded (const Catch::TestRunStats&) override { gui.reset(); }

    /// As JUCE does in a program, but not in a test: without a handler, Xlib ends the process. It complains about a Stage, which is not a
    /// window of the X server but gets a cursor anyway.
    void ignoreXErrors()
    {
        using Handler = int (*) (void* display, void* error);
        if (auto* set = reinterpret_cast<Handler (*) (Handler)> (xlib.getFunction ("XSetErrorHandler"))) set ([] (void*, void*) { return 0; });
    }

    juce::DynamicLibrary xlib { "libX11.so.6" };   // which JUCE loads, too
    std::optional<juce::ScopedJuceInitialiser_GUI> gui;
};

CATCH_REGISTER_LISTENER (KeepsJuce)
}   // namespace
