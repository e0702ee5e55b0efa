// SPDX-License-Identifier: MIT
// What JUCE asserts: where it fails, a defect of ours is what failed, and the test ends at once.
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
        const bool of_display = message.contains ("XWindowSystem");      // there is none, and a dialog asks for a window of its own
        const bool at_exit = message.contains ("juce_Singleton.h:50");   // JUCE's shutdown asks for its display once more, and leaves it
        if (message.startsWith ("JUCE Assertion failure") && ! of_display && ! at_exit) std::abort();
    }
};

/// From before the first test to after the last one.
struct Watch
{
    Watch() { juce::Logger::setCurrentLogger (&logger); }
    ~Watch() { juce::Logger::setCurrentLogger (nullptr); }

    Assertions logger;
} watch;
}   // namespace
