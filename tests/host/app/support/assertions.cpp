// SPDX-License-Identifier: MIT
// A failed JUCE assertion is a bug in our code, so it aborts the test.
#include <juce_core/juce_core.h>

#include <cstdlib>
#include <iostream>

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
}   // namespace
