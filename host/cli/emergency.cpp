// SPDX-License-Identifier: GPL-3.0-or-later
#include "emergency.hpp"

#include <host/platform/signals.hpp>

#include <atomic>

namespace tactus::host
{

namespace
{
std::atomic<Engine*> under_signals { nullptr };   // which know of no other
}

Emergency::Emergency (Engine& e) : engine (e)
{
    under_signals = &e;
    watchForEmergency ([]() noexcept
                       { under_signals.load()->emergencyStop(); },
                       []() noexcept
                       { under_signals.load()->rearm(); });
}

Emergency::~Emergency() { watchForEmergency (nullptr, nullptr); }

void Emergency::attend()
{
    while (const char key = keys.next())
        if (key == ' ')
            engine.emergencyStop();
        else if (key == 'r' || key == 'R')
            engine.rearm();
}

}   // namespace tactus::host
