// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/device.hpp>
#include <tactus/run/guard/effort_watch.hpp>
#include <tactus/run/guard/falling_limit.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>

namespace tactus
{

/// Limits of a guard. The defaults limit nothing, so that a simulated device is exact. The profile of a real device
/// sets them, and a session may only tighten them. A limit that is negative or not a number lets nothing through.
struct GuardLimits
{
    static constexpr double none = std::numeric_limits<double>::infinity();
    static constexpr double default_watchdog = 0.1;   ///< in s, for a real device whose profile does not set it

    double max_force = none;         ///< length of the vector, in N
    double max_torque = none;        ///< length of the vector, in N m
    double max_slew = none;          ///< length of the rate of change of force, in N/s
    double max_torque_slew = none;   ///< length of the rate of change of torque, in N m/s
    double ramp = 0.0;               ///< time from 0 to full effort after enabling, in s
    double watchdog = none;          ///< time without a fresh reading before the effort goes to 0, in s

    double max_axis_effort = none;   ///< for each axis separately, in N or N m
    double max_axis_slew = none;     ///< for each axis separately, in N/s or N m/s
    double max_signal = none;        ///< for each signal output separately, in N, m/s2 or 1, as calibrated
    double max_signal_slew = none;   ///< for each signal output separately, per s
    double max_brake = none;         ///< damping of the brake, in N s/m; never more than the device has
    double max_brake_slew = none;    ///< in N s/m per s
    double brake_at_stop = 0.0;      ///< damping of the brake during a stop, in N s/m; 0: a stop releases it. Only a device and its user set it

    double max_speed = none;             ///< speed of the tool as measured by SpeedWatch, in m/s
    double max_angular_speed = none;     ///< the same for the rotation of the tool, in rad/s
    double max_axis_speed = none;        ///< the same for each axis separately, in the unit of the axis per s
    double max_impulse = none;           ///< impulse in any direction within the window, as counted by ImpulseWatch, in N s
    double max_angular_impulse = none;   ///< the same for the torque, in N m s
    double max_axis_impulse = none;      ///< the same for the efforts on all axes together, in N s or N m s
    double impulse_window = 0.0;         ///< window of all three impulse limits, in s; 0: the whole session
    double max_energy = none;            ///< energy that force, torque and axes may give to the hand, as counted by EnergyWatch, in J
    double energy_window = 0.0;          ///< window of max_energy, in s; 0: the whole session
    double max_still = none;             ///< how long position or rotation may stay exactly the same under an effort, as counted by StillWatch, in s
    double still_force = none;           ///< the least force for max_still, in N
    double still_torque = none;          ///< the least torque for max_still, in N m

    double workspace_scale = 1.0;   ///< motion in the graph divided by motion of the device; the limits are those of the device

    double dead_man_pressure = 0.0;       ///< how hard the hand must press before the guard allows any effort, in N; 0: not required
    std::uint64_t dead_man_buttons = 0;   ///< buttons that must all be held, as in Reading::buttons; 0: none

    bool operator== (const GuardLimits&) const = default;
};

/// The stricter of the two values of each limit; this is how a session tightens a profile. For limits with windows: the smaller
/// limit and the longer window.
GuardLimits tightest (const GuardLimits&, const GuardLimits&) noexcept;

/// The limits of a device after a graph has asked for these: like tightest, but `workspace_scale` and `brake_at_stop` stay those of the device.
GuardLimits tightened (const GuardLimits& of_device, const GuardLimits& by) noexcept;

/// The last stage before a device, one per role, always present. It passes efforts that are finite and within the limits for
/// size and slew, shortens other efforts keeping their direction, and brings everything to zero when there is a cause to stop.
///
/// Each tick, in this order (docs/decisions/guard_order.md):
///
///     cause      see below
///     length     k w            so that |force| <= max_force, |torque| <= max_torque, each |axis| <= max_axis_effort; w: wanted now
///     crossfade  e = enabled k w + withheld h        h: effort at the stop
///     slew       e' + s (e - e')                     so that no part changes by more than its slew T; e': last tick
///
/// One factor k and one s scale force, torque and axes, so directions are kept, and the limits of size hold on the way as well.
/// Each signal is limited by itself, and so is the brake: its damping is at least 0 and at most max_brake, which prepare() lowers to what the
/// device has. A stop takes it to brake_at_stop, and from there it follows the ramp. A brake never pushes, so it does not count in impulse and
/// energy.
///
/// While there is a cause, `enabled` is 0 and `withheld` falls from 1 to 0 within fade_s, so a stop is never a step,
/// even without a slew limit; with one, it takes as long as the limit requires. When the cause is gone, `enabled` rises
/// to 1 within `ramp`, as at the start. Without any limit, a finite effort passes through bit for bit.
///
///     stop        cause                                                       ends
///     not_finite  the graph asked for a value that is not a number            with its cause, then the ramp
///     stale       no reading, or one that is old, frozen or not a number      once readings have been good for 1.5 times the watchdog, then the ramp
///     starved     more time lost than ticked, by more than the watchdog       with its cause, then the ramp
///     released    the dead-man's switch is not held                           with its cause, then the ramp
///     halted      requested: the end of a session, the stop button            with resume(), then the ramp
///     speed       the tool or an axis moves or turns too fast                 with rearm(), then the ramp
///     impulse     more effort for longer than the impulse limits allow        with rearm(), then the ramp
///     energy      the device gives the hand more than max_energy              with rearm(), then the ramp
///     emergency   the emergency stop was pressed                              with rearm(), then the ramp
///
/// Stops that need rearm() are signs of a fault in the loop or the device. Without the latch, the effort would come
/// back on its own and push until the next stop.
///
/// Good to know
///  - The guard is a total function: whatever the effort, reading or limits, the result is finite.
///  - The torque has its own slew limit, since N/s does not apply to it. Stops and the ramp apply to everything.
///  - A reading counts as recent for as long as the watchdog allows, so without that wait a device that reports too rarely would get a pulse
///    with each report.
///  - With ramp 0, full effort returns on the first good tick, as fast as the slew limit allows; after rearm(), within rearm_ramp_s.
///  - Limits count seconds, not ticks. Ticks that come too fast count as the time that has passed, so a device that reports faster than its
///    profile says gains nothing. Missing ticks count too: for the watchdog, impulse, energy, speed, and the end of a stop.
///  - Whatever rises (the slew, the ramp) advances by at most one period a tick, and by no more in total than the time that has passed. What
///    late ticks leave is kept for the ticks of a batch, up to the length of the watchdog. So there is no step after a pause.
///  - Energy and speed include the axes that efforts push: for each effort the axis of the same name, or axisN for effortN. An
///    effort without such an axis is limited in size, slew and impulse only.
///  - Speed, impulse and energy are measured from the last effort on the device and its motion, so an excess is
///    detected one tick late: the limit is exceeded during that tick and the fade. Impulse and energy count force and torque as
///    the motors rendered them (Reading::unrendered_force).
///  - If readings are slower than ticks, energy is the mean effort since the last new reading, times the motion since then. Otherwise
///    an effort that turns round just before each reading would seem to brake. A driver must report the age of a reading that it
///    repeats: the guard takes a repeated reading of age 0 for a tool at rest.
class Guard
{
public:
    /// Duration of a stop, unless a slew limit requires longer. Short for a hand (the fastest reflex takes about 30 ms),
    /// long compared with a tick, so that the stop itself does not jolt the device.
    static constexpr double fade_s = 0.005;

    /// Time from 0 to full effort after rearm(), in s, where the limits have no ramp of their own.
    static constexpr double rearm_ramp_s = 0.2;

    enum class Stop : std::uint32_t
    {
        none,
        not_finite,
        stale,
        starved,
        released,
        halted,
        speed,
        impulse,
        energy,
        emergency
    };

    /// True for stops that last until rearm().
    static constexpr bool latches (Stop stop) noexcept { return stop >= Stop::speed; }

    /// The values that made the guard withhold an effort. Trivially copyable, so that hosts can pass them to other threads.
    struct Event
    {
        /// The value that was not a number, or whose speed or impulse exceeded its limit: torque means the rotation of the tool.
        enum class Part : std::uint32_t
        {
            none,
            reading,
            force,
            torque,
            axis,
            signal,
            brake
        };

        Stop why = Stop::none;
        Part part = Part::none;
        double value = 0.0;                ///< the measured age, lost time, pressure, speed, impulse or energy, or the time without a change of position
        double limit = 0.0;                ///< the limit on this value
        double window = 0.0;               ///< window of the limit, in s; 0: the whole session
        std::array<double, 3> wanted {};   ///< force or torque that was not a number; for an axis, signal or brake, only the first component is used
        std::int32_t channel = 0;          ///< number of the axis or signal, from 0; if one coordinate is frozen, its number, and if all are, -1
        std::uint32_t valid = 1;           ///< 1 if the reading was valid
        ReadingFault fault {};             ///< what is wrong with the reading, if known; if it is `frozen`, `wanted` is the force or torque on the tool
        bool at_start = false;             ///< no effort had been let through since prepare(): nothing was taken from the hand
    };

    /// The layout says which axes the efforts push. [main thread]
    void prepare (const GuardLimits&, double dt_s, const DeviceLayout& = {}) noexcept;

    /// Tightens the limits to the stricter of what they are and these, and keeps everything that is counted. `workspace_scale` stays. What is
    /// on the device above a new limit of size falls to it within fade_s, or as slowly as the slew limits so far require; the new slew limits apply
    /// from then on, because they may be too slow for a force that their `max_force` no longer allows. False if nothing changes. [tick thread]
    bool tighten (const GuardLimits&) noexcept;

    /// Returns the effort for the device; it stays valid until the next call. `passed_s` is the time since the last tick, in s, by the wall
    /// clock (PassedTime); the last effort was on the device during this time. Without it, one period. [tick thread]
    const Effort& operator() (const Effort& wanted, const Reading&, double passed_s) noexcept;
    const Effort& operator() (const Effort& wanted, const Reading& reading) noexcept { return (*this) (wanted, reading, dt); }

    /// Brings the effort to zero and keeps it there until resume(). [tick thread]
    void halt() noexcept { asked_to_halt = true; }
    void resume() noexcept { asked_to_halt = false; }

    /// Like halt, but only rearm() ends it. rearm() also ends every other latched stop, but not a halt, and then resets the
    /// impulse and energy counts. Without a latched stop, it does nothing. [tick thread]
    void emergencyStop() noexcept;
    void rearm() noexcept;

    /// True during a stop that only rearm() can end, even if another cause is reported. [any thread that owns the guard]
    bool isLatched() const noexcept { return latched != Stop::none; }

    /// True if most ticks of the last whole second without a stop asked for more than the limits of size and slew allow, so the force is not the one
    /// that the graph describes. [any thread that owns the guard]
    bool isClipping() const noexcept { return clips; }

    /// The reason why the last effort was withheld. [any thread that owns the guard]
    Stop stop() const noexcept { return reason; }

    /// The values on the first tick of the latest stop, even after the stop has ended. If a reading stays bad but the reason
    /// changes to another known one, the values on the tick of that change. `why` is none if there has been no stop since prepare().
    const Event& latest() const noexcept { return event; }

    /// True once an effort has been let through since prepare(). [any thread that owns the guard]
    bool hasBegun() const noexcept { return has_begun; }

    /// The number of stops since prepare().
    std::uint64_t events() const noexcept { return count; }

    /// The number of changes of latest() since prepare().
    std::uint64_t changes() const noexcept { return change_count; }

    /// True while no effort is on the device, and its brake is as during a stop, so that it can be released without a step.
    bool isAtRest() const noexcept;

    /// Saves or restores what it has counted and let through, not its limits and not a halt: what holds an effort back now is not undone by a state
    /// of the past. [tick thread]
    void serialize (StateArchive&);

private:
    void forget() noexcept;
    void chooseWatches() noexcept;
    double brakeAtStop() const noexcept { return std::min (limits.brake_at_stop, limits.max_brake); }
    std::array<double, 5> onDevice() const noexcept;
    void useSizes (const std::array<double, 5>& level) noexcept;
    void lowerSizes (double steps) noexcept;
    Channels withoutRise (const Channels& wanted, const Channels& now, std::size_t size) const noexcept;
    void passTime (double passed_s) noexcept;
    double rise (double passed_s) noexcept;
    bool isUsable (const Reading&) const noexcept;
    void watch (const Reading&, bool is_usable, double passed_s) noexcept;
    double watchAxes (const Reading&, double elapsed_s, bool is_single) noexcept;
    bool isRecent (const Reading&) const noexcept;
    bool settles (Stop cause, double passed_s) noexcept;
    bool hasBrokenAxes (const Reading& reading) const noexcept { return watches_axes && ! isFinite (reading.axes); }
    bool isFrozen() const noexcept
    {
        return limits.max_still != GuardLimits::none && (still.time() > limits.max_still || still_turn.time() > limits.max_still);
    }
    void countImpulse (double passed_s, const Reading&) noexcept;
    void latch (Stop, double value, Event::Part = Event::Part::none, int channel = 0) noexcept;
    Stop causeOf (const Effort& wanted, const Reading&, bool is_usable) const noexcept;
    void describeFrozen (Event&) const noexcept;
    Event describeNow (Stop, const Effort& wanted, const Reading&) const noexcept;
    void note (Stop, const Effort& wanted, const Reading&) noexcept;
    void describeStale (Event&, const Reading&) const noexcept;
    void countClipping (const Effort& wanted, double passed_s) noexcept;
    Effort crossfaded (const Effort& wanted) const noexcept;
    double fit (Vec3& force, Vec3& torque, Channels& axes) const noexcept;
    void approach (const Effort& to, double step_s) noexcept;

    GuardLimits limits;                     // as they apply on this tick
    GuardLimits final_limits;               // what they become, while `is_falling`
    std::array<FallingLimit, 5> sizes {};   // of force, torque, axes, signals and the brake
    bool is_falling = false;                // limits of size still fall to tighter ones

    double dt = fade_s;    // in s; until prepare is called, a stop takes one tick
    double drift = 0.0;    // total time that has passed, less one period for each tick, in s
    double saved = 0.0;    // time that has passed and that no rising effort has used yet, in s
    double behind = 0.0;   // lost time that has not been made up by as much time with ticks, in s
    bool is_starved = false;
    bool is_unsettled = false;   // readings were bad, and have not been good for long enough since
    double good_s = 0.0;         // the time for which they have been good since
    double enabled = 1.0;        // progress of the enable ramp, 0…1
    bool has_rearmed = false;    // `enabled` is 0, or rises, after rearm()
    double withheld = 0.0;       // fraction of `at_stop` that is still on the device, 1…0
    Effort at_stop;
    Effort last;
    Stop reason = Stop::none;
    Stop latched = Stop::none;
    double seen = 0.0;   // the value that caused the latched stop
    Event::Part seen_part = Event::Part::none;
    int seen_channel = 0;
    bool is_news = false;     // the latched stop has not been reported yet
    bool has_begun = false;   // an effort has been let through since prepare()
    Event event;
    std::uint64_t count = 0, change_count = 0;   // of stops; of changes of `event`
    bool asked_to_halt = false;
    double judged_s = 0.0, clipped_s = 0.0;   // time in this second, and the part of it in which the effort was clipped
    bool clips = false;                       // most of the last second was

    bool is_watching = false;     // at least one limit needs the watches
    bool watches_turns = false;   // at least one limit needs the rotation
    bool watches_axes = false;    // at least one limit needs the axes
    std::uint64_t ticks = 0;
    MotionWatch motion;
    MeanEffort mean_effort;   // since the last new reading
    SpeedWatch speed, angular_speed;
    std::array<double, Channels::most> axis_velocity {};
    std::array<std::int8_t, Channels::most> axis_of_effort {};   // by effort, the number of the axis that it pushes; -1: unknown
    ImpulseWatch impulse, angular_impulse, axis_impulse;
    EnergyWatch energy;
    StillWatch still, still_turn;
};

/// The event in words, with its numbers: "the last reading is 31 ms old; the watchdog allows 20 ms".
std::string describe (const Guard::Event&);

}   // namespace tactus
