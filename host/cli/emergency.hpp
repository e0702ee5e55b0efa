// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/platform/terminal.hpp>
#include <tactus/run/run.hpp>
#include <tactus/text/result.hpp>

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

namespace tactus::host
{

/// The emergency stop of a run, while this object exists: the space bar in a terminal, SIGUSR1 from anywhere, press(), and an
/// alarm of the failsafe. Its own thread reads the keys and handles the signals. Its priority is above that of the tick thread if the
/// system allows it. So a stop takes effect however long the main thread compiles, prints or waits, and however busy the tick thread is.
/// For the signals, call holdEmergencySignals() before other threads are started. As a listener of the run, this object looks for alarms
/// before every tick. R rearms if it comes alone (RearmKey), but not within a second of the stop, so that two keys pressed in a hurry do
/// not undo the stop. Only one object of this class may exist at a time. [main thread]
class Emergency final : public RunListener
{
public:
    static constexpr double pause_s = 1.0;   ///< shortest time from a stop, or from a rearm, to the next rearm

    /// The engine must outlive this object.
    explicit Emergency (Engine&);
    ~Emergency() override;
    Emergency (const Emergency&) = delete;
    Emergency& operator= (const Emergency&) = delete;

    bool hasKeys() const noexcept { return keys.areThere(); }
    void restoreTerminal() const noexcept { keys.restore(); }   ///< before the program ends without destructors   [any thread]

    /// Stops at once. [any thread, even in a signal handler]
    void press() noexcept;

    /// Lets forces rise again. Refuses if it was asked for before the latest stop, or within `pause_s` of a stop or a rearm. Id:
    /// run/rearm_too_early. [any thread]
    Result<> rearm (std::chrono::steady_clock::time_point asked = std::chrono::steady_clock::now());

    /// Messages for the user since the last call, one per line; "" if there are none. [main thread]
    std::string takeNotes();

    void before (Plan&, std::uint64_t tick) noexcept override;

private:
    void listen (const std::stop_token&);

    Engine& engine;
    Keys keys;
    std::atomic<double> pressed_at;   // time on the steady clock, in s
    std::atomic<double> rearmed_at;   // likewise
    std::atomic<bool> came_too_early { false };
    std::uint32_t alarms_told;      // number of alarms that the user has been told about
    std::uint32_t alarms_stopped;   // number of alarms that have stopped the run   [tick thread]
    std::jthread listening;         // declared last: it uses the other members
};

}   // namespace tactus::host
