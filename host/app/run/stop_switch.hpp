// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <utility>

namespace tactus::host
{

/// Stops the runs of a window, however busy the message thread is. Any thread can press the switch. The tick thread of each run
/// checks it before every tick; the message thread notices a press when it has time.
class StopSwitch
{
public:
    /// How often each kind of stop was pressed.
    struct Presses
    {
        std::uint32_t stops = 0, emergencies = 0;

        bool operator== (const Presses&) const = default;
    };

    // [any thread, even in a signal handler]
    void stop() noexcept { stops.fetch_add (1, std::memory_order_relaxed); }
    void emergencyStop() noexcept { emergencies.fetch_add (1, std::memory_order_relaxed); }
    Presses presses() const noexcept { return { stops.load (std::memory_order_relaxed), emergencies.load (std::memory_order_relaxed) }; }

    /// The presses that the message thread knew of at its last notice(). A new run counts these as obeyed. So it also obeys a press that
    /// comes between notice() and its first tick. [message thread]
    const Presses& noticed() const noexcept { return known; }
    bool isAhead() const noexcept { return presses() != known; }   ///< true if there is a press to notice   [message thread]

    /// Marks all presses as noticed, and returns what noticed() returned before. [message thread]
    Presses notice() noexcept { return std::exchange (known, presses()); }

private:
    std::atomic<std::uint32_t> stops { 0 }, emergencies { 0 };
    Presses known;
};

}   // namespace tactus::host
