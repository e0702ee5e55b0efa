// SPDX-License-Identifier: MIT
#pragma once

namespace tactus::host::hid
{

/// When a device with an emergency stop of its own is told of that of Tactus, and when that it is over. It is told once its efforts are at zero, so
/// that its stop is no step, and again and again, in case that a report is lost. Only a rearm ends its stop, and only one that Tactus has caused: one
/// that was pressed at the device stays, also right after a rearm. [tick thread]
class BoardStop
{
public:
    enum class Says
    {
        nothing,
        stop,
        rearm
    };

    static constexpr double rearms_for = 0.2;   ///< s

    /// Call it on each tick. `emergency`: the emergency stop of the run is latched; `rests`: there is no effort on the device; `is_stopped`: what the
    /// device says of its own stop.
    Says operator() (bool emergency, bool rests, bool is_stopped, double dt_s) noexcept
    {
        const bool begins = emergency && ! was_emergency && left_s <= 0.0;
        by_device = (begins || by_device) && is_stopped;
        if (! emergency && was_emergency && ! by_device) left_s = rearms_for;
        had_stopped = is_stopped || (had_stopped && ! emergency && ! was_emergency);
        if (had_stopped && ! is_stopped) left_s = 0.0;   // it is rearmed: from now on, a stop is its own
        was_emergency = emergency;
        if (emergency)
        {
            left_s = 0.0;
            return rests && ! by_device ? Says::stop : Says::nothing;
        }
        if (left_s <= 0.0) return Says::nothing;
        left_s -= dt_s;
        return Says::rearm;
    }

private:
    bool was_emergency = false;
    bool by_device = false;     // it had stopped before it was told to
    bool had_stopped = false;   // it has said so since the rearm began
    double left_s = 0.0;
};

}   // namespace tactus::host::hid
