// SPDX-License-Identifier: GPL-3.0-or-later
#include "emergency.hpp"
#include "rearm_key.hpp"

#include <host/platform/failsafe.hpp>
#include <host/platform/signals.hpp>
#include <tactus/run/realtime.hpp>
#include <tactus/text/caught.hpp>

#include <chrono>
#include <limits>
#include <utility>

namespace tactus::host
{

namespace
{
std::atomic<Emergency*> under_signals { nullptr };   // the emergency stop that the signal handlers press
std::atomic<bool> asked_by_signal { false };         // SIGUSR2 has arrived

double inSeconds (std::chrono::steady_clock::time_point t) noexcept { return std::chrono::duration<double> (t.time_since_epoch()).count(); }
double now() noexcept { return inSeconds (std::chrono::steady_clock::now()); }
}   // namespace

Emergency::Emergency (Engine& e)
    : engine (e), pressed_at (-std::numeric_limits<double>::infinity()), rearmed_at (pressed_at.load()),
      alarms_told (Failsafe::alarms()), alarms_stopped (alarms_told)
{
    static_assert (std::atomic<double>::is_always_lock_free, "a signal handler writes it");
    under_signals = this;
    asked_by_signal = false;
    watchForEmergency ([]() noexcept { under_signals.load()->press(); },
                       []() noexcept { asked_by_signal = true; });
    listening = std::jthread ([this] (const std::stop_token& stop) {
        while (! stop.stop_requested())
            if (! caught ("the stop keys", [&] { listen (stop); })) press();   // a key may have been lost
    });
}

Emergency::~Emergency() { watchForEmergency (nullptr, nullptr); }

void Emergency::press() noexcept
{
    pressed_at.exchange (now());   // before the stop itself: rearm() compares this time
    engine.emergencyStop();
}

Result<> Emergency::rearm (std::chrono::steady_clock::time_point asked)
{
    auto last = pressed_at.load();
    if (inSeconds (asked) < pressed_at + pause_s)
        return Message::error ("run/rearm_too_early", {}, "the emergency stop was pressed less than a second ago",
                               "wait a second, make sure that forces may safely return, and rearm again");
    if (now() < rearmed_at + pause_s)
        return Message::error ("run/rearm_too_early", {}, "the last rearm was less than a second ago", "find out what stops the run, then rearm again");
    rearmed_at = now();
    engine.rearm();
    // A press on another thread since `pressed_at` was read must not be undone. A later press sees this rearm, and stops after it.
    if (! pressed_at.compare_exchange_strong (last, last)) engine.emergencyStop();
    return {};
}

/// Handles the keys, and the emergency signals, which all other threads block.
void Emergency::listen (const std::stop_token& stop)
{
    static_cast<void> (raisePriority (priority::stop));   // if real-time priority is refused, the run reports that
    takeEmergencySignals();
    constexpr auto patience = std::chrono::milliseconds (20);
    RearmKey rearm_key;
    while (! stop.stop_requested())
    {
        if (! hasKeys())
        {
            std::this_thread::sleep_for (patience);   // a signal interrupts the sleep
            continue;
        }
        const char key = keys.next (patience);
        if (key == ' ') press();
        if (key == '\x03') requestStop();   // Ctrl-C in a terminal that sends no signal for it
        if (key != '\0')
            rearm_key.typed (key, now());
        else if (rearm_key.isDue (now()) && ! rearm())
            came_too_early = true;
    }
}

void Emergency::before (Plan&, std::uint64_t) noexcept
{
    if (const auto now = Failsafe::alarms(); std::exchange (alarms_stopped, now) != now) engine.emergencyStop();
}

std::string Emergency::takeNotes()
{
    std::string notes;
    if (const auto now = Failsafe::alarms(); std::exchange (alarms_told, now) != now)
    {
        press();   // press() also makes rearm() refuse for a second
        const auto alarm = Failsafe::alarm();
        notes += "warning: " + sentence (alarm) + (hasKeys() ? " (R)" : "") + " [" + alarm.id + "]\n";
    }
    if (came_too_early.exchange (false)) notes += "R has no effect within a second of an emergency stop: when forces may safely return, press R again\n";
    if (asked_by_signal.exchange (false)) notes += "SIGUSR2 does not rearm: when forces may safely return, press R in this terminal\n";
    return notes;
}

}   // namespace tactus::host
