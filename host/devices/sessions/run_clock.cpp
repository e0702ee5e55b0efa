// SPDX-License-Identifier: MIT
#include "run_clock.hpp"

namespace tactus::host
{

/// Ticks by a timer until the device is available.
class RunClock::TimerUntilDevice final : public Ticked
{
public:
    TimerUntilDevice (RunClock& c, Ticked& t) : clock (c), ticked (t) {}

    bool tick (double late_s) noexcept override
    {
        clock.waited.fetch_add (1, std::memory_order_relaxed);
        goes_on = ticked.tick (late_s);
        return goes_on && clock.awaited->device() == nullptr;
    }

    bool goes_on = true;

private:
    RunClock& clock;
    Ticked& ticked;
};

RunClock::RunClock (hid::HidDevice& device, double rate_hz) : rate (rate_hz), is_there (true) { by_reports.emplace (device.port(), rate_hz); }
RunClock::RunClock (const AwaitedDevice& device, double rate_hz) : rate (rate_hz), awaited (&device) {}

void RunClock::drive (Ticked& ticked) noexcept
{
    if (! by_reports)
    {
        TimerUntilDevice waiting { *this, ticked };
        AbsoluteTimer { 1.0 / rate }.drive (waiting);
        if (! waiting.goes_on) return;
        by_reports.emplace (awaited->device()->port(), rate);
        is_there.store (true, std::memory_order_release);
    }
    by_reports->drive (ticked);
}

bool RunClock::isReplaced() const noexcept { return ! is_there.load (std::memory_order_acquire) || by_reports->isReplaced(); }
bool RunClock::isByTimer() const noexcept { return ! is_there.load (std::memory_order_acquire) || by_reports->isByTimer(); }

std::uint64_t RunClock::ticksByTimer() const noexcept
{
    return waited.load (std::memory_order_relaxed) + (is_there.load (std::memory_order_acquire) ? by_reports->ticksByTimer() : 0);
}

}   // namespace tactus::host
