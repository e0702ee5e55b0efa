// SPDX-License-Identifier: MIT
#pragma once

#include "device.hpp"
#include "effort_watch.hpp"

#include <array>
#include <cstdint>
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

    double max_axis_effort = none;   ///< N or N m, of each axis by itself
    double max_axis_slew = none;     ///< N/s or N m/s, of each axis by itself
    double max_signal = none;        ///< N, m/s2 or 1, as it is calibrated, of each signal output by itself

    double max_speed = none;       ///< m/s of the tool, as SpeedWatch sees it
    double max_impulse = none;     ///< N s of force, whatever its direction, within the window, as ImpulseWatch counts
    double impulse_window = 0.0;   ///< s; 0: the whole session
    double max_energy = none;      ///< J that the device gives to the hand, as EnergyWatch counts
    double energy_window = 0.0;    ///< s; 0: the whole session

    double dead_man_pressure = 0.0;       ///< N that the hand must press with, for any effort; 0: it need not
    std::uint64_t dead_man_buttons = 0;   ///< those that must all be held, as Reading::buttons; 0: none

    bool operator== (const GuardLimits&) const = default;
};

/// Each limit as strict as the stricter of the two: how a session tightens what a profile allows. Of two limits with
/// windows, the smaller within the longer window.
GuardLimits tightest (const GuardLimits&, const GuardLimits&) noexcept;

/// The last thing before a device, one per role, always there. It passes efforts that are finite, short and smooth
/// enough, shortens the others without turning them, and brings everything to zero when there is a cause to stop.
///
/// Each tick, in this order:
///
///     cause      see below
///     crossfade  e = enabled w + withheld h          w: wanted now, h: what was on the device at the stop
///     length     |e| <= max_force                    direction kept; axes and signals each by itself
///     slew       |e - e(last tick)| <= max_slew T    along the straight way there, so the length holds as well
///
/// While there is a cause, `enabled` is 0 and `withheld` falls from 1 to 0 within fade_s: a stop is never a step,
/// also without a slew limit; with one it takes as long as that needs. When the cause is gone, `enabled` rises to 1
/// within `ramp`, as it does at the start. Without any limit a finite effort passes to the bit.
///
///     stop        cause                                                       ends
///     not_finite  the graph asked for what is no number                       with its cause, then the ramp
///     stale       no reading, one that is no number, or an old one            with its cause, then the ramp
///     released    the dead-man's switch is not held                           with its cause, then the ramp
///     halted      asked for: the end of a session, the stop button            with resume(), then the ramp
///     speed       the tool moves faster than max_speed                        with rearm(), then the ramp
///     impulse     more force for longer than max_impulse allows               with rearm(), then the ramp
///     energy      the device gives the hand more than max_energy              with rearm(), then the ramp
///     emergency   somebody pressed the emergency stop                         with rearm(), then the ramp
///
/// Those that need rearm() are signs that the loop, or the device, does what nobody wants: they would come back by
/// themselves, and in between push.
///
/// Good to know
///  - Total: no effort, reading or limit makes it return anything but finite numbers.
///  - The torque has a limit of slew of its own, since N/s says nothing about it; stops and ramp go for all.
///  - With ramp 0 a device is back at full effort on the first good tick, as fast as the slew limit allows.
///  - Speed, impulse and energy are of what was on the device and of how it moved, so they are seen a tick after: the
///    limit is passed by that tick and the fade.
class Guard
{
public:
    /// How long a stop takes where no slew limit asks for longer. Short for a hand (the fastest reflex takes some
    /// 30 ms), long against the tick, so that the device is not struck by the stop itself.
    static constexpr double fade_s = 0.005;

    enum class Stop : std::uint32_t
    {
        none,
        not_finite,
        stale,
        released,
        halted,
        speed,
        impulse,
        energy,
        emergency
    };

    /// True for those that stay until rearm().
    static constexpr bool latches (Stop stop) noexcept { return stop >= Stop::speed; }

    /// What there was to see when the guard last withheld an effort. Plain bytes, for hosts to hand on.
    struct Event
    {
        /// What was no number.
        enum class Part : std::uint32_t
        {
            none,
            reading,
            force,
            torque,
            axis,
            signal
        };

        Stop why = Stop::none;
        Part part = Part::none;
        double value = 0.0;                ///< age, pressure, speed, impulse or energy: what was seen
        double limit = 0.0;                ///< what is allowed of it
        double window = 0.0;               ///< s, of the limit; 0: the whole session
        std::array<double, 3> wanted {};   ///< of a force or torque that is no number; of an axis or signal, the first
        std::int32_t channel = 0;          ///< of the axis or signal, from 0
        std::uint32_t valid = 1;           ///< the reading was
    };

    void prepare (const GuardLimits&, double dt_s) noexcept;             // [main thread]
    Effort operator() (const Effort& wanted, const Reading&) noexcept;   // [tick thread]

    /// Brings the effort to zero and keeps it there until resume. [tick thread]
    void halt() noexcept { asked_to_halt = true; }
    void resume() noexcept { asked_to_halt = false; }

    /// As halt, but only rearm ends it, which also ends whatever else has stopped the guard for good; a halt stays. What
    /// was counted towards those limits is forgotten. [tick thread]
    void emergencyStop() noexcept;
    void rearm() noexcept;

    /// Why the last effort was withheld. [any thread that owns the guard]
    Stop stop() const noexcept { return reason; }

    /// The first tick of the latest stop, also when it is over; why is none if there was none since prepare.
    const Event& latest() const noexcept { return event; }

    /// How often latest() has become another one.
    std::uint64_t events() const noexcept { return count; }

    /// True while nothing is on the device, so that it can be let go without a step.
    bool isAtRest() const noexcept;

private:
    void watch (const Reading&) noexcept;
    void countImpulse() noexcept;
    void latch (Stop, double value) noexcept;
    Stop causeOf (const Effort& wanted, const Reading&) const noexcept;
    Event describeNow (Stop, const Effort& wanted, const Reading&) const noexcept;
    Effort crossfade (const Effort& wanted) noexcept;

    GuardLimits limits;
    double dt = fade_s;      // s; until prepare a stop takes one tick
    double enabled = 1.0;    // 0…1, how far the enable ramp has come
    double withheld = 0.0;   // 1…0, how much of `at_stop` is still on the device
    Effort at_stop;
    Effort last;
    Stop reason = Stop::none;
    Stop latched = Stop::none;
    double seen = 0.0;      // what latched it
    bool is_news = false;   // and is not told yet
    Event event;
    std::uint64_t count = 0;
    bool asked_to_halt = false;

    bool is_watching = false;   // a limit that needs the watches
    std::uint64_t ticks = 0;
    SpeedWatch speed;
    ImpulseWatch impulse;
    EnergyWatch energy;
};

/// In words, with the numbers: "the last reading is 31 ms old, the watchdog allows 20 ms".
std::string describe (const Guard::Event&);

}   // namespace tactus
