// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How a test waits while the window works, see tests/support/waiting.hpp.

#include "support/waiting.hpp"

#include <juce_events/juce_events.h>

namespace tactus::host::test
{

/// Handles messages for at least this time.
inline void handleMessages (int ms) { juce::MessageManager::getInstance()->runDispatchLoopUntil (ms); }

/// Lets the window work for at least this time, and until it has handled all messages so far and those that they cause, and has run all timers that are due,
/// however late a busy computer makes them.
inline void settle (int ms = 20)
{
    const auto handleAll = [] {
        bool handled = false;
        juce::MessageManager::callAsync ([&handled] { handled = true; });
        while (! handled)
            handleMessages (1);
    };
    for (int round = 0; round < 3; ++round)
        handleAll();
    handleMessages (ms);
    bool rang = false;
    juce::Timer::callAfterDelay (1, [&rang] { rang = true; });   // JUCE runs all timers that are due in one message
    while (! rang)
        handleMessages (1);
    handleAll();
}

/// Lets the window work until something is so. False if it still is not after a long time.
template <typename F>
bool waitFor (F&& isSo, int ms = 10)
{
    return tactus::test::eventually ({}, [&] {
        if (isSo()) return true;
        settle (ms);
        return false;
    });
}

}   // namespace tactus::host::test
