// SPDX-License-Identifier: MIT
#include "hid_clock.hpp"

#include <algorithm>

namespace tactus::host::hid
{
namespace
{
using Clock = HidPort::Clock;
}   // namespace

HidClock::HidClock (HidPort& p, double rate_hz)
    : port (p), period (toDuration (1.0 / rate_hz)), silence (toDuration (longest_silence / rate_hz)), loss (p.watchdog())
{
}

void HidClock::drive (Ticked& ticked) noexcept
{
    auto heard = Clock::now();
    auto due = heard + silence;
    port.readHere();
    for (;;)
    {
        const bool came = port.waitForReport (due);
        const auto now = Clock::now();
        const auto expected = heard + period;
        if (came) heard = now;
        by_timer.store (! came, std::memory_order_relaxed);
        replaced.store (! came && (! port.isConnected() || now - heard > loss), std::memory_order_relaxed);
        if (! came) timed.fetch_add (1, std::memory_order_relaxed);

        // If this thread came too late for a report, it is not known when the report arrived.
        if (came) due = port.wasLate() ? expected : Clock::time_point (std::chrono::nanoseconds (port.lastArrival()));
        const auto since = now - due;
        if (! ticked.tick (std::max (0.0, std::chrono::duration<double> (since).count()))) break;
        due = came ? now + silence : std::max (due + period, now);   // missed ticks are skipped
    }
    port.readElsewhere();
}

}   // namespace tactus::host::hid
