// SPDX-License-Identifier: MIT
#pragma once

#include "device.hpp"

#include <limits>
#include <string>

namespace tactus
{

/// What a guard allows. The defaults limit nothing, so that a simulated device is exact; a real device's profile
/// sets them, and a session may only tighten them. A limit that is no number, or negative, lets nothing through.
struct GuardLimits
{
    static constexpr double none = std::numeric_limits<double>::infinity();

    double max_force = none;         ///< N, length of the vector
    double max_torque = none;        ///< N m, length of the vector
    double max_slew = none;          ///< N/s, length of the change of force
    double max_torque_slew = none;   ///< N m/s, length of the change of torque
    double ramp = 0.0;               ///< s from 0 to full effort after enabling
    double watchdog = none;          ///< s without a fresh reading before the effort goes to 0

    bool operator== (const GuardLimits&) const = default;
};

/// Each limit as strict as the stricter of the two: how a session tightens what a profile allows.
GuardLimits tightest (const GuardLimits&, const GuardLimits&) noexcept;

/// The last thing before a device, one per role, always there. It passes efforts that are finite, short and smooth
/// enough, shortens the others without turning them, and brings everything to zero when the input is stale.
///
/// Each tick, in this order:
///
///     cause      an effort that is not finite, a reading that is not valid or older than the watchdog, a halt
///     crossfade  e = enabled w + withheld h          w: wanted now, h: what was on the device at the stop
///     length     |e| <= max_force                    direction kept
///     slew       |e - e(last tick)| <= max_slew T    along the straight way there, so the length holds as well
///
/// While there is a cause, `enabled` is 0 and `withheld` falls from 1 to 0 within fade_s: a stop is never a step,
/// also without a slew limit; with one it takes as long as that needs. When the cause is gone, `enabled` rises to 1
/// within `ramp`, as it does at the start. Without any limit a finite effort passes to the bit.
///
/// Good to know
///  - Total: no effort, reading or limit makes it return anything but finite numbers.
///  - The torque has a limit of slew of its own, since N/s says nothing about it; stops and ramp go for both.
///  - With ramp 0 a device is back at full effort on the first good tick, as fast as the slew limit allows.
class Guard
{
public:
    /// How long a stop takes where no slew limit asks for longer. Short for a hand (the fastest reflex takes some
    /// 30 ms), long against the tick, so that the device is not struck by the stop itself.
    static constexpr double fade_s = 0.005;

    enum class Stop
    {
        none,
        not_finite,   ///< the graph asked for an effort that is not a number
        stale,        ///< the device has nothing to say, or not for longer than the watchdog allows
        halted        ///< asked for: the end of a session, the stop button
    };

    /// What there was to see when the guard last withheld an effort.
    struct Event
    {
        Stop why = Stop::none;
        Effort wanted;
        double age = 0.0;        ///< s, of the reading
        double watchdog = 0.0;   ///< s
        bool valid = true;       ///< of the reading
    };

    void prepare (const GuardLimits&, double dt_s) noexcept;             // [main thread]
    Effort operator() (const Effort& wanted, const Reading&) noexcept;   // [tick thread]

    /// Brings the effort to zero and keeps it there until resume. [tick thread]
    void halt() noexcept { asked_to_halt = true; }
    void resume() noexcept { asked_to_halt = false; }

    /// Why the last effort was withheld. [any thread that owns the guard]
    Stop stop() const noexcept { return reason; }

    /// The first tick of the latest stop, also when it is over; why is none if there was none since prepare.
    const Event& latest() const noexcept { return event; }

    /// True while nothing is on the device, so that it can be let go without a step.
    bool isAtRest() const noexcept { return last.force.isZero (0.0) && last.torque.isZero (0.0); }

private:
    Stop causeOf (const Effort& wanted, const Reading&) const noexcept;
    Effort crossfade (const Effort& wanted) noexcept;

    GuardLimits limits;
    double dt = fade_s;      // s; until prepare a stop takes one tick
    double enabled = 1.0;    // 0…1, how far the enable ramp has come
    double withheld = 0.0;   // 1…0, how much of `at_stop` is still on the device
    Effort at_stop;
    Effort last;
    Stop reason = Stop::none;
    Event event;
    bool asked_to_halt = false;
};

/// In words, with the numbers: "the last reading is 31 ms old, the watchdog allows 20 ms".
std::string describe (const Guard::Event&);

}   // namespace tactus
