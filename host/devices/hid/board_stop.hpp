// SPDX-License-Identifier: MIT
#pragma once

namespace tactus::host::hid
{

/// The link between a guard and the emergency stop of its device: the device is told when the guard stops in a way that only a rearm ends, and when
/// that stop is over. The device is told once its efforts are at zero, so that its stop is no step, and again and again, in case that a report is
/// lost. Only a rearm ends its stop, and only one that Tactus has caused: one that was pressed at the device stays, also right after a rearm.
/// [tick thread]
///
/// Someone who presses the button of the device may let go of the tool, which then becomes too fast. So after a stop of a limit, the device is told
/// only when it has had the time to say that it is stopped already. An emergency stop does not wait for this.
class BoardStop
{
public:
    enum class Says
    {
        nothing,
        stop,
        rearm
    };

    /// The stop of the guard.
    enum class Cause
    {
        none,   ///< or one that ends by itself
        limit,
        emergency
    };

    static constexpr double rearms_for = 0.2;    ///< s
    static constexpr double listens_for = 0.1;   ///< s; the device is asked for its own stop twice in this time

    /// Call it on each tick. `rests`: there is no effort on the device; `is_stopped`: what the device says of its own stop.
    Says operator() (Cause cause, bool rests, bool is_stopped, double dt_s) noexcept
    {
        const bool is_latched = cause != Cause::none;
        if (is_latched && ! was_latched && left_s <= 0.0)
        {
            is_told = false;
            listened_s = 0.0;
        }
        by_device = (by_device || (is_latched && ! is_told)) && is_stopped;
        if (! is_latched && was_latched && is_told && ! by_device) left_s = rearms_for;
        had_stopped = is_stopped || (had_stopped && ! is_latched && ! was_latched);
        if (had_stopped && ! is_stopped) left_s = 0.0;   // it is rearmed: from now on, a stop is its own
        was_latched = is_latched;
        if (is_latched)
        {
            left_s = 0.0;
            listened_s += dt_s;
            const bool listens = cause == Cause::limit && ! is_told && listened_s < listens_for;
            if (! rests || by_device || listens) return Says::nothing;
            is_told = true;
            return Says::stop;
        }
        if (left_s <= 0.0) return Says::nothing;
        left_s -= dt_s;
        return Says::rearm;
    }

private:
    bool was_latched = false;
    bool is_told = false;       // of the stop that is latched, or was last
    bool by_device = false;     // it had stopped before it was told to
    bool had_stopped = false;   // it has said so since the rearm began
    double listened_s = 0.0, left_s = 0.0;
};

}   // namespace tactus::host::hid
