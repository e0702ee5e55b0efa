// SPDX-License-Identifier: GPL-3.0-or-later
#include "emergency.hpp"
#include "lone_key.hpp"

#include <host/base/platform/signals.hpp>
#include <tactus/run/realtime.hpp>
#include <tactus/text/caught.hpp>

#include <chrono>

namespace tactus::host
{

namespace
{
std::atomic<StopSwitch*> under_signals { nullptr };   // the switch that the signal handlers press
std::atomic<bool> asked_by_signal { false };          // SIGUSR2 has arrived

double now() noexcept { return std::chrono::duration<double> (std::chrono::steady_clock::now().time_since_epoch()).count(); }
}   // namespace

Emergency::Emergency (LiveSession& l, StopSwitch& s) : session (l), stops (s)
{
    under_signals = &stops;
    asked_by_signal = false;
    watchForEmergency ([]() noexcept { under_signals.load()->emergencyStop (By::program); },
                       []() noexcept { asked_by_signal = true; });
    listening = std::jthread ([this] (const std::stop_token& stop) {
        while (! stop.stop_requested())
            if (! caught ("the stop keys", [&] { listen (stop); })) stops.emergencyStop (By::person);   // a key may have been lost
    });
}

Emergency::~Emergency() { watchForEmergency (nullptr, nullptr); }

/// Handles the keys, and the emergency signals, which all other threads block.
void Emergency::listen (const std::stop_token& stop)
{
    static_cast<void> (raisePriority (priority::stop));   // if real-time priority is refused, the run reports that
    takeEmergencySignals();
    constexpr auto patience = std::chrono::milliseconds (20);
    LoneKey rearm_key { 'r' }, clutch_key { 's' };
    while (! stop.stop_requested())
    {
        if (! hasKeys())
        {
            std::this_thread::sleep_for (patience);   // a signal interrupts the sleep
            continue;
        }
        const char key = keys.next (patience);
        if (key == ' ') stops.emergencyStop (By::person);
        if (key == '\x03') requestStop();   // Ctrl-C in a terminal that sends no signal for it
        if (key != '\0')
        {
            rearm_key.typed (key, now());
            clutch_key.typed (key, now());
            continue;
        }
        if (rearm_key.isDue (now())) rearm();
        if (clutch_key.isDue (now())) clutch_turned = ! clutch_turned;
    }
}

void Emergency::rearm()
{
    const auto person_stops = stops.personStops();
    if (session.rearm())
        stops.startedAfter (person_stops);
    else
        came_too_early = true;
}

std::string Emergency::takeNotes()
{
    std::string notes;
    if (came_too_early.exchange (false)) notes += "R has no effect within a second of an emergency stop: when forces may safely return, press R again\n";
    if (asked_by_signal.exchange (false)) notes += "SIGUSR2 does not rearm: when forces may safely return, press R in this terminal\n";
    return notes;
}

}   // namespace tactus::host
