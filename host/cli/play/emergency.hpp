// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/base/platform/terminal.hpp>
#include <host/devices/live/live_session.hpp>

#include <atomic>
#include <string>
#include <thread>

namespace tactus::host
{

/// Presses the stop switch of a session, while this object exists: the space bar in a terminal, and SIGUSR1 from anywhere. Its own thread reads
/// the keys and handles the signals. Its priority is above that of the tick thread if the system allows it. So a stop takes effect however long the
/// main thread compiles, prints or waits, and however busy the tick thread is. For the signals, call holdEmergencySignals() before other threads
/// are started. R rearms if it comes alone (LoneKey), when StopSwitch::mayRearm allows it. Only one object of this class may exist at a time.
/// [main thread]
class Emergency final
{
public:
    /// Both must outlive this object.
    Emergency (LiveSession&, StopSwitch&);
    ~Emergency();
    Emergency (const Emergency&) = delete;
    Emergency& operator= (const Emergency&) = delete;

    bool hasKeys() const noexcept { return keys.areThere(); }
    void restoreTerminal() const noexcept { keys.restore(); }   ///< before the program ends without destructors   [any thread]

    /// True if S, which holds or releases the clutch, was pressed an odd number of times since the last call. [main thread]
    bool takeClutch() noexcept { return clutch_turned.exchange (false); }

    /// Messages for the user since the last call, one per line; "" if there are none. [main thread]
    std::string takeNotes();

private:
    void listen (const std::stop_token&);
    void rearm();

    LiveSession& session;
    StopSwitch& stops;
    Keys keys;
    std::atomic<bool> came_too_early { false }, clutch_turned { false };
    std::jthread listening;   // declared last: it uses the other members
};

}   // namespace tactus::host
