// SPDX-License-Identifier: GPL-3.0-or-later
// Reports that the tick thread reads itself.

#include "hid_port.hpp"

#include <algorithm>
#include <thread>
#include <utility>

namespace tactus::host::hid
{

bool HidPort::waitForReport (Clock::time_point until) noexcept
{
    if (! turn.isMine())
    {
        has_turn = false;
        const bool came = arrived.wait (until);
        if (came) turn.ask();   // the device is alive, so from its next report on, read it here
        return came;
    }
    if (! std::exchange (has_turn, true) && arrived.wait (Clock::now())) return true;   // the last report that the other thread read
    return readUntil (until);
}

/// Returns as soon as a report is there and no other one follows at once. The system waits in whole milliseconds; for what is left,
/// this thread looks often. If nothing comes, the reading thread gets the turn back, because it waits more exactly.
///
/// The system keeps a few reports and drops those that come later. So if many are waiting, as after a long tick, they are old, and
/// this waits for one more.
bool HidPort::readUntil (Clock::time_point until) noexcept
{
    constexpr auto look_apart = std::chrono::microseconds (50);
    constexpr int most_waiting = 32;
    bool came = false;
    for (int waiting = 0;;)
    {
        const bool has_newest = came && waiting < most_waiting;
        const auto left = until - Clock::now();
        const auto whole = std::max (std::chrono::floor<std::chrono::milliseconds> (left), std::chrono::milliseconds (0));
        const auto got = turn.transport().read (buffer, came && waiting > 0 ? std::chrono::milliseconds (0) : whole);
        if (got && *got > 0)
        {
            arrive (std::span (buffer).first (*got));
            came = true;
            ++waiting;
            continue;
        }
        const bool is_gone = ! got || ! isConnected();
        if (is_gone || (! came && Clock::now() >= until)) turn.giveBack (! got);
        if (has_newest || (came && Clock::now() >= until)) return true;
        waiting = 0;
        if (is_gone) return arrived.wait (until);
        if (Clock::now() >= until) return false;
        if (whole.count() == 0) std::this_thread::sleep_for (std::min<Clock::duration> (look_apart, std::max (left, Clock::duration (0))));
    }
}

void HidPort::readElsewhere() noexcept { turn.giveBack(); }

/// [the thread that has the turn to read]
void HidPort::arrive (std::span<const std::uint8_t> report)
{
    const auto now = std::chrono::duration_cast<std::chrono::nanoseconds> (Clock::now().time_since_epoch()).count();
    reports.fetch_add (1, std::memory_order_relaxed);
    push (report, now);
    last_arrival.store (now, std::memory_order_release);
}

}   // namespace tactus::host::hid
