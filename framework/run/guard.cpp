// SPDX-License-Identifier: MIT
#include "guard.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace tactus
{
namespace
{
constexpr double most_behind = 50.0;   // times the watchdog; a limit, so that a run that keeps up again recovers in the end
constexpr double settles_in = 1.5;     // times the watchdog; more than 1, so that a reading that is on its way out does not count

// A few units in the last place below the limit, so that rounding cannot exceed it.
constexpr double just_under = 1.0 - 16.0 * std::numeric_limits<double>::epsilon();

/// The share of v, 0…1, whose length is at most `most`. v must be finite; its length may overflow.
double shareWithin (const Vec3& v, double most) noexcept
{
    if (most == GuardLimits::none) return 1.0;
    // What is clearly shorter needs no scaling, unless a square could leave the range of doubles.
    if (most > 1e-140 && most < 1e140 && v.squaredNorm() < 0.999 * most * most) return 1.0;

    const double biggest = v.cwiseAbs().maxCoeff();
    if (biggest == 0.0) return 1.0;

    const double length = (v / biggest).norm();
    return biggest * length <= most ? 1.0 : most / biggest / length * just_under;
}

double shareWithin (double v, double most) noexcept { return std::abs (v) <= most ? 1.0 : most / std::abs (v) * just_under; }

/// Moves from `from` towards `to`, by at most `most`.
double approached (double from, double to, double most) noexcept
{
    if (most == GuardLimits::none) return to;

    // Uses halves, because the difference of two finite numbers may be infinite.
    const double half_way = 0.5 * to - 0.5 * from;
    return std::abs (half_way) <= 0.5 * most ? to : from + std::copysign (most * just_under, half_way);
}

/// The largest change of a value in this time. Without a limit it is unlimited, even if no time has passed.
double stepOf (double slew, double s) noexcept { return slew == GuardLimits::none ? slew : slew * s; }

/// Limits each value of `to` separately: at most `most` from 0, and at most `most_step` from its last value.
/// Values that are no longer commanded go to 0.
[[gnu::noinline]] Channels approached (const Channels& from, const Channels& to, double most, double most_step) noexcept
{
    Channels all;
    for (int i = 0, n = std::max (from.size(), to.size()); i < n; ++i)
        all.set (i, approached (from[i], std::clamp (to[i], -most, most), most_step));
    return all;
}

/// The share of all values, 0…1, with which each is at most `most`.
[[gnu::noinline]] double shareWithin (const Channels& all, double most) noexcept
{
    double share = 1.0;
    for (const double v : all)
        share = std::min (share, shareWithin (v, most));
    return share;
}

[[gnu::noinline]] Channels mixed (double a, const Channels& x, double b, const Channels& y) noexcept
{
    Channels all;
    for (int i = 0, n = std::max (x.size(), y.size()); i < n; ++i)
        all.set (i, a * x[i] + b * y[i]);
    return all;
}

/// The most that each part of an effort may have.
struct Most
{
    double force, torque, axis;
};

/// The share, 0…1, with which no part has more than it may. A tiny share is subnormal and has lost digits, so the parts are then scaled down first.
double shareWithin (Vec3& force, Vec3& torque, Channels& axes, const Most& most) noexcept
{
    constexpr double smallest = 1e-280, less = 0x1p-512;
    for (;;)
    {
        double share = std::min (shareWithin (force, most.force), shareWithin (torque, most.torque));
        if (axes.size() > 0) share = std::min (share, shareWithin (axes, most.axis));
        if (share >= smallest || share == 0.0) return share;
        force *= less;
        torque *= less;
        axes = mixed (less, axes, 0.0, {});
    }
}

/// The first n values; missing ones are 0.
[[gnu::noinline]] Channels resized (const Channels& all, int n) noexcept
{
    Channels some;
    for (int i = 0; i < n; ++i)
        some.set (i, all[i]);
    return some;
}

/// Most devices have only a tool, so the code for channels is kept off the fast path.
bool hasChannels (const Effort& e) noexcept { return (e.axes.size() | e.signals.size()) != 0; }
[[gnu::noinline]] bool channelsAreFinite (const Effort& e) noexcept { return isFinite (e.axes, e.signals); }

/// The largest value, whatever its sign.
[[gnu::noinline]] double largest (const Channels& all) noexcept
{
    double most = 0.0;
    for (const double v : all)
        most = std::max (most, std::abs (v));
    return most;
}

/// The limits in `sizes` of a guard, in this order, and the slew limits.
constexpr std::array size_limits { &GuardLimits::max_force, &GuardLimits::max_torque, &GuardLimits::max_axis_effort, &GuardLimits::max_signal,
                                   &GuardLimits::max_brake };
constexpr std::array slew_limits { &GuardLimits::max_slew, &GuardLimits::max_torque_slew, &GuardLimits::max_axis_slew, &GuardLimits::max_signal_slew,
                                   &GuardLimits::max_brake_slew };

double orNothing (double limit) noexcept { return limit >= 0.0 ? limit : 0.0; }
double orForever (double s) noexcept { return s >= 0.0 ? s : GuardLimits::none; }
double orReleased (double damping) noexcept { return damping > 0.0 && isFinite (damping) ? damping : 0.0; }

/// The window for a limit: infinity (the whole session) if `window` is 0; 0 if the limit is not set.
double windowOf (double limit, double window) noexcept
{
    if (limit == GuardLimits::none) return 0.0;
    return window > 0.0 ? window : GuardLimits::none;
}

/// The inverse of windowOf.
double asSet (double window) noexcept { return window == GuardLimits::none ? 0.0 : window; }

/// The smallest of the three limits; `none` only if no impulse is limited.
double smallestImpulse (const GuardLimits& l) noexcept { return std::min ({ l.max_impulse, l.max_angular_impulse, l.max_axis_impulse }); }

/// For each effort, the number of the axis that it pushes, or -1: the axis of the same name, or axisN for effortN.
std::array<std::int8_t, Channels::most> axesOf (const DeviceLayout& layout)
{
    constexpr std::string_view effort = "effort", axis = "axis";
    std::array<std::int8_t, Channels::most> all;
    all.fill (-1);
    for (std::size_t i = 0; i < std::min (layout.efforts.size(), all.size()); ++i)
    {
        const std::string_view name = layout.efforts[i];
        int index = indexOf (layout.axes, name);
        for (std::size_t k = 0; index < 0 && name.starts_with (effort) && k < layout.axes.size(); ++k)
        {
            const std::string_view other = layout.axes[k];
            if (other.starts_with (axis) && other.substr (axis.size()) == name.substr (effort.size())) index = static_cast<int> (k);
        }
        if (index < Channels::most) all[i] = static_cast<std::int8_t> (index);
    }
    return all;
}
}   // namespace

GuardLimits tightest (const GuardLimits& a, const GuardLimits& b) noexcept
{
    const auto less = [] (double x, double y) { return std::min (orNothing (x), orNothing (y)); };
    const auto longer = [] (double of_a, double in_a, double of_b, double in_b) { return asSet (std::max (windowOf (of_a, in_a), windowOf (of_b, in_b))); };

    return {
        .max_force = less (a.max_force, b.max_force),
        .max_torque = less (a.max_torque, b.max_torque),
        .max_slew = less (a.max_slew, b.max_slew),
        .max_torque_slew = less (a.max_torque_slew, b.max_torque_slew),
        .ramp = std::max (orForever (a.ramp), orForever (b.ramp)),
        .watchdog = less (a.watchdog, b.watchdog),
        .max_axis_effort = less (a.max_axis_effort, b.max_axis_effort),
        .max_axis_slew = less (a.max_axis_slew, b.max_axis_slew),
        .max_signal = less (a.max_signal, b.max_signal),
        .max_signal_slew = less (a.max_signal_slew, b.max_signal_slew),
        .max_brake = less (a.max_brake, b.max_brake),
        .max_brake_slew = less (a.max_brake_slew, b.max_brake_slew),
        .brake_at_stop = std::max (orReleased (a.brake_at_stop), orReleased (b.brake_at_stop)),
        .max_speed = less (a.max_speed, b.max_speed),
        .max_angular_speed = less (a.max_angular_speed, b.max_angular_speed),
        .max_axis_speed = less (a.max_axis_speed, b.max_axis_speed),
        .max_impulse = less (a.max_impulse, b.max_impulse),
        .max_angular_impulse = less (a.max_angular_impulse, b.max_angular_impulse),
        .max_axis_impulse = less (a.max_axis_impulse, b.max_axis_impulse),
        .impulse_window = longer (smallestImpulse (a), a.impulse_window, smallestImpulse (b), b.impulse_window),
        .max_energy = less (a.max_energy, b.max_energy),
        .energy_window = longer (a.max_energy, a.energy_window, b.max_energy, b.energy_window),
        .max_still = less (a.max_still, b.max_still),
        .still_force = less (a.still_force, b.still_force),
        .still_torque = less (a.still_torque, b.still_torque),
        .workspace_scale = a.workspace_scale * b.workspace_scale,
        .dead_man_pressure = std::max (orForever (a.dead_man_pressure), orForever (b.dead_man_pressure)),
        .dead_man_buttons = a.dead_man_buttons | b.dead_man_buttons,
    };
}

GuardLimits tightened (const GuardLimits& of_device, const GuardLimits& by) noexcept
{
    auto limits = tightest (of_device, by);
    limits.workspace_scale = of_device.workspace_scale;
    limits.brake_at_stop = of_device.brake_at_stop;
    return limits;
}

void Guard::prepare (const GuardLimits& wanted, double dt_s, const DeviceLayout& layout) noexcept
{
    *this = Guard();
    if (isFinite (dt_s) && dt_s > 0.0) dt = dt_s;
    limits = tightest (wanted, {});
    if (layout.brake > 0.0) limits.max_brake = std::min (limits.max_brake, layout.brake);
    axis_of_effort = axesOf (layout);
    chooseWatches();
    enabled = 0.0;
    forget();
}

void Guard::chooseWatches() noexcept
{
    const auto limitsAny = [] (auto... all) { return ((all != GuardLimits::none) || ...); };
    watches_turns = limitsAny (limits.max_angular_speed, limits.max_energy);
    const bool knows_axes = std::ranges::any_of (axis_of_effort, [] (int axis) { return axis >= 0; });
    watches_axes = knows_axes && limitsAny (limits.max_axis_speed, limits.max_energy);
    is_watching = watches_turns || watches_axes || limitsAny (limits.max_speed, limits.max_still, smallestImpulse (limits));
}

bool Guard::tighten (const GuardLimits& wanted) noexcept
{
    const auto before = limits;
    const auto& current = is_falling ? final_limits : limits;
    const auto tighter = tightened (current, wanted);
    if (tighter == current) return false;

    limits = final_limits = tighter;
    const auto level = onDevice();
    for (std::size_t i = 0; i < sizes.size(); ++i)
        sizes[i].tighten (tighter.*size_limits[i], level[i], fade_s / dt);
    is_falling = true;
    for (const auto slew : slew_limits)
        limits.*slew = before.*slew;
    useSizes (level);

    const bool watched_turns = watches_turns, watched_axes = watches_axes;
    chooseWatches();
    if (watches_turns != watched_turns || watches_axes != watched_axes)
    {
        motion.forget();   // it does not know the last rotation or the last axes
        mean_effort = {};
    }
    for (auto* all : { &impulse, &angular_impulse, &axis_impulse })
        all->lengthen (windowOf (smallestImpulse (limits), limits.impulse_window), dt);
    energy.allow (limits.max_energy, windowOf (limits.max_energy, limits.energy_window));
    return true;
}

/// The size of the force, torque, effort on an axis, signal and braking on the device, in the order of `sizes`.
std::array<double, 5> Guard::onDevice() const noexcept
{
    return { length (last.force), length (last.torque), largest (last.axes), largest (last.signals), last.brake };
}

/// The limits of size that apply now, and all others once nothing on the device is above its new limit any more.
void Guard::useSizes (const std::array<double, 5>& level) noexcept
{
    is_falling = false;
    for (std::size_t i = 0; i < sizes.size(); ++i)
        is_falling = is_falling || ! sizes[i].isReached (level[i]);
    if (! is_falling) limits = final_limits;
    for (std::size_t i = 0; i < sizes.size(); ++i)
        limits.*size_limits[i] = sizes[i].now();
}

/// Lowers the limits of size that fall. `steps`: the time that has passed, in periods.
[[gnu::noinline]] void Guard::lowerSizes (double steps) noexcept
{
    const auto level = onDevice();
    for (std::size_t i = 0; i < sizes.size(); ++i)
        sizes[i].advance (level[i], steps);
    useSizes (level);
}

/// While a limit of several values falls, each of them stays where it is or falls, unless the new limit allows more.
[[gnu::noinline]] Channels Guard::withoutRise (const Channels& wanted, const Channels& now, std::size_t size) const noexcept
{
    Channels all;
    for (int i = 0; i < wanted.size(); ++i)
    {
        const double most = std::max (sizes[size].goal(), std::abs (now[i]));
        all.set (i, std::clamp (wanted[i], -most, most));
    }
    return all;
}

void Guard::emergencyStop() noexcept
{
    is_news = is_news || latched != Stop::emergency;
    latched = Stop::emergency;
}

void Guard::rearm() noexcept
{
    // A limit that was exceeded on the last tick takes effect on the next one, and only then can it be rearmed.
    const bool has_effect = latched == Stop::emergency || ! is_news;
    if (! isLatched() || ! has_effect) return;
    forget();
    has_rearmed = true;
}

/// Forgets latched stops, and what the watches have counted.
void Guard::forget() noexcept
{
    latched = Stop::none;
    motion = {};
    mean_effort = {};
    speed = angular_speed = {};
    axis_velocity = {};
    for (auto* all : { &impulse, &angular_impulse, &axis_impulse })
        all->prepare (windowOf (smallestImpulse (limits), limits.impulse_window), dt);
    energy.prepare (limits.max_energy, windowOf (limits.max_energy, limits.energy_window));
}

bool Guard::isAtRest() const noexcept
{
    const auto none = [] (const Channels& all) { return std::all_of (all.begin(), all.end(), [] (double v) { return v == 0.0; }); };
    const bool braked = last.brake != 0.0 && last.brake != brakeAtStop();
    return last.force.isZero (0.0) && last.torque.isZero (0.0) && none (last.axes) && none (last.signals) && ! braked;
}

void Guard::latch (Stop why, double value, Event::Part part, int channel) noexcept
{
    if (latched != Stop::none) return;
    latched = why;
    seen = value;
    seen_part = part;
    seen_channel = channel;
    is_news = true;
}

/// Counts time, and the ticks that are missing. Starvation ends once ticks have made up for all of it but half of the watchdog's time, so a
/// run that is starved again and again gets no force in between.
void Guard::passTime (double passed_s) noexcept
{
    drift += passed_s - dt;
    if (limits.watchdog == GuardLimits::none) return;
    behind = std::clamp (behind + (passed_s - dt) - dt, 0.0, most_behind * limits.watchdog);
    is_starved = behind > (is_starved ? 0.5 : 1.0) * limits.watchdog;
}

/// The time by which everything that rises may advance on this tick, in s.
double Guard::rise (double passed_s) noexcept
{
    const double most = limits.watchdog == GuardLimits::none ? GuardLimits::default_watchdog : limits.watchdog;
    saved = std::min (saved + passed_s, std::max (most, dt));
    const double step = std::min (saved, dt);
    saved -= step;
    return step;
}

/// Updates the watches with the motion of the device under its last effort. `is_usable`: see isUsable.
void Guard::watch (const Reading& reading, bool is_usable, double passed_s) noexcept
{
    const Fine now = Fine (static_cast<std::int64_t> (ticks++)) * dt + drift;   // a signed number converts in one instruction
    const double weight = std::max (passed_s / dt, 1e-9);                       // of the last effort in a mean; never 0, even within a batch of reports
    if (! is_usable || ! isFinite (reading.age))
    {
        mean_effort.add (last, reading, weight, watches_axes);
        // While an effort is on the device, the distance to the next reading counts, so a device cannot hide its motion behind bad readings.
        if (! isAtRest()) return;
        motion.forget();
        mean_effort = {};
        return;
    }

    motion.begin (reading, now);
    const Vec3 moved = motion.moved / limits.workspace_scale;
    if (limits.max_speed != GuardLimits::none)
    {
        speed (moved, motion.elapsed);
        if (const double v = speed.speed(); ! (v <= limits.max_speed)) latch (Stop::speed, v);
    }

    // Most devices have a new reading on each tick. The mean is then the last effort itself.
    const bool is_new = motion.isNew (dt), is_single = is_new && mean_effort.isEmpty();
    if (! is_single) mean_effort.add (last, reading, weight, watches_axes);
    double work = (is_single ? Vec3 (last.force - reading.unrendered_force) : mean_effort.force()).dot (moved);
    if (watches_turns)
    {
        const Vec3 turned = motion.turned (reading);
        if (limits.max_angular_speed != GuardLimits::none)
        {
            angular_speed (turned, motion.elapsed);
            if (const double w = angular_speed.speed(); ! (w <= limits.max_angular_speed)) latch (Stop::speed, w, Event::Part::torque);
        }
        work += (is_single ? Vec3 (last.torque - reading.unrendered_torque) : mean_effort.torque()).dot (turned);
    }
    if (watches_axes) work += watchAxes (reading, motion.elapsed, is_single);
    if (is_new && ! is_single) mean_effort = {};
    if (limits.max_energy != GuardLimits::none)
        if (const double given = energy (work, passed_s); ! (given <= limits.max_energy)) latch (Stop::energy, given);
    if (limits.max_still == GuardLimits::none) return;
    still (reading.position, last.force, limits.still_force, passed_s);
    still_turn (reading.rotation, last.torque, limits.still_torque, passed_s);
}

/// A reading from the future comes from a clock that differs from ours, so its age is unknown.
bool Guard::isRecent (const Reading& reading) const noexcept
{
    return reading.age <= limits.watchdog && (reading.age >= -dt || limits.watchdog == GuardLimits::none);
}

/// True after a stop for bad readings, until they have been good for long enough.
[[gnu::noinline]] bool Guard::settles (Stop cause, double passed_s) noexcept
{
    is_unsettled = limits.watchdog != GuardLimits::none;
    good_s = cause == Stop::stale ? 0.0 : good_s + std::min (passed_s, dt);
    if (good_s > settles_in * limits.watchdog) is_unsettled = false;
    return is_unsettled;
}

/// The work in J that the last efforts have done on the axes that they push. `is_single`: only the last one was on the device since the
/// last reading.
[[gnu::noinline]] double Guard::watchAxes (const Reading& reading, double elapsed_s, bool is_single) noexcept
{
    double work = 0.0;
    for (std::size_t i = 0; i < axis_of_effort.size(); ++i)
    {
        const int axis = axis_of_effort[i];
        if (axis < 0) continue;
        const double moved = motion.axisMoved (reading, axis);
        auto& velocity = axis_velocity[i];
        velocity = SpeedWatch::filtered (velocity, moved, elapsed_s);
        if (! (std::abs (velocity) <= limits.max_axis_speed)) latch (Stop::speed, std::abs (velocity), Event::Part::axis, axis);
        work += (is_single ? last.axes[static_cast<int> (i)] : mean_effort.axis (i)) * moved;
    }
    return work;
}

/// Adds the impulse of the last effort, as the motors rendered it. It was on the device since the last tick.
void Guard::countImpulse (double passed_s, const Reading& reading) noexcept
{
    // If the driver does not know what the motors rendered, the effort counts in full.
    const auto rendered = [] (const Vec3& written, const Vec3& unrendered) {
        const Vec3 left = written - unrendered;
        const double square = left.squaredNorm();
        return square == 0.0 && left.isZero (0.0) ? 0.0 : length (isFinite (square) || isFinite (left) ? left : written);
    };
    const auto add = [&] (ImpulseWatch& watch, double limit, double effort, Event::Part part) {
        if (const double pushed = watch (effort * passed_s, passed_s); ! (pushed <= limit)) latch (Stop::impulse, pushed, part);
    };
    if (limits.max_impulse != GuardLimits::none)
        add (impulse, limits.max_impulse, rendered (last.force, reading.unrendered_force), Event::Part::none);
    if (limits.max_angular_impulse != GuardLimits::none)
        add (angular_impulse, limits.max_angular_impulse, rendered (last.torque, reading.unrendered_torque), Event::Part::torque);
    if (limits.max_axis_impulse == GuardLimits::none) return;
    double sum = 0.0;
    for (const double effort : last.axes)
        sum += std::abs (effort);
    add (axis_impulse, limits.max_axis_impulse, sum, Event::Part::axis);
}

/// True if the reading is valid and finite, whatever its age.
bool Guard::isUsable (const Reading& reading) const noexcept
{
    return reading.valid && isFinite (reading.position, reading.rotation) && ! hasBrokenAxes (reading);
}

Guard::Stop Guard::causeOf (const Effort& wanted, const Reading& reading, bool is_usable) const noexcept
{
    if (latched == Stop::emergency) return latched;
    if (! isFinite (wanted.force, wanted.torque, wanted.brake) || wanted.brake < 0.0) return Stop::not_finite;
    if (hasChannels (wanted) && ! channelsAreFinite (wanted)) return Stop::not_finite;
    if (! is_usable || ! isRecent (reading) || isFrozen()) return Stop::stale;
    if (is_starved) return Stop::starved;
    if (latched != Stop::none) return latched;
    if (asked_to_halt) return Stop::halted;

    const bool is_held = (reading.buttons & limits.dead_man_buttons) == limits.dead_man_buttons
                         && (limits.dead_man_pressure == 0.0 || reading.pressure >= limits.dead_man_pressure);
    return is_held ? Stop::none : Stop::released;
}

[[gnu::noinline]] void Guard::note (Stop why, const Effort& wanted, const Reading& reading) noexcept
{
    event = describeNow (why, wanted, reading);
    event.at_start = ! has_begun;
    ++change_count;
}

/// Here the force is limited: first a reason to stop is looked for, then the effort is faded, shortened and slowed down.
const Effort& Guard::operator() (const Effort& wanted, const Reading& reading, double passed_s) noexcept
{
    const double passed = passed_s >= 0.0 && isFinite (passed_s) ? passed_s : dt;
    passTime (passed);
    if (is_falling) lowerSizes (passed / dt);
    const bool is_usable = isUsable (reading);
    if (is_watching)
    {
        countImpulse (passed, reading);
        watch (reading, is_usable, passed);
    }
    auto cause = causeOf (wanted, reading, is_usable);
    const bool is_bad = cause == Stop::stale && has_begun;
    if ((is_bad || is_unsettled) && settles (cause, passed) && cause == Stop::none) cause = Stop::stale;
    // A stop that has begun continues while ticks are missing. A stop that begins now, and everything that rises, advances by one period at most.
    const double rising_s = rise (passed), step_s = reason != Stop::none && cause != Stop::none ? passed : rising_s;

    if (cause != reason && cause != Stop::none)
    {
        const bool begins = reason == Stop::none;
        const bool ends_a_run = cause == Stop::halted && event.why != Stop::none;   // latest() then still reports the stop before the halt
        if ((begins && ! ends_a_run) || (latches (cause) && is_news))
        {
            note (cause, wanted, reading);
            ++count;
        }
        if (latches (cause)) is_news = false;
        if (begins)
        {
            at_stop = last;
            withheld = 1.0;
            enabled = 0.0;
        }
    }
    else if (cause == Stop::stale && event.why == Stop::stale && reading.fault != ReadingFault::none && reading.fault != event.fault && ! isFrozen())
        note (cause, wanted, reading);   // the same stop with another reason, such as a silent board that is now too hot
    reason = cause;
    has_begun |= reason == Stop::none;
    if (reason != Stop::none) saved = 0.0;   // time that was left during a stop does not make the force rise faster after it

    withheld = std::max (0.0, withheld - step_s / fade_s);
    if (reason == Stop::none && enabled < 1.0)
    {
        const double ramp = limits.ramp > 0.0 || ! has_rearmed ? limits.ramp : rearm_ramp_s;
        enabled = ramp > 0.0 ? std::min (1.0, enabled + rising_s / ramp) : 1.0;
    }
    if (enabled == 1.0) has_rearmed = false;
    enabled == 1.0 ? approach (wanted, step_s) : approach (crossfaded (wanted), step_s);
    countClipping (wanted, passed);
    return last;
}

/// A stop, and the rise after it, do not count as clipping. They have their own messages.
void Guard::countClipping (const Effort& wanted, double passed_s) noexcept
{
    constexpr double window_s = 1.0, part = 1e-3;   // of the effort: less is not felt
    if (reason != Stop::none || enabled < 1.0) return;
    const auto differs = [] (const auto& a, const auto& b) { return ! ((a - b).stableNorm() <= part * b.stableNorm()); };
    bool is_clipped = differs (last.force, wanted.force) || differs (last.torque, wanted.torque);
    for (const auto& [given, asked] : { std::pair { &last.axes, &wanted.axes }, std::pair { &last.signals, &wanted.signals } })
        for (int i = 0; i < std::min (given->size(), asked->size()); ++i)
            is_clipped = is_clipped || ! (std::abs ((*given)[i] - (*asked)[i]) <= part * std::abs ((*asked)[i]));
    judged_s += passed_s;
    if (is_clipped) clipped_s += passed_s;
    if (judged_s < window_s) return;
    clips = clipped_s > 0.5 * judged_s;
    judged_s = clipped_s = 0.0;
}

/// Leaves out the parts of the effort that are limited to 0, rather than scaling the others to 0, and returns the share of the rest,
/// 0…1, that is within the limits of size.
double Guard::fit (Vec3& force, Vec3& torque, Channels& axes) const noexcept
{
    if (! (limits.max_force > 0.0)) force.setZero();
    if (! (limits.max_torque > 0.0)) torque.setZero();
    if (! (limits.max_axis_effort > 0.0) && axes.size() > 0) axes = resized ({}, axes.size());
    return shareWithin (force, torque, axes, { limits.max_force, limits.max_torque, limits.max_axis_effort });
}

/// Moves the last effort towards this one, as far as the limits of size and slew allow. One factor scales force, torque and axes,
/// so what they do together keeps its direction.
void Guard::approach (const Effort& to, double step_s) noexcept
{
    last.brake = approached (last.brake, std::clamp (to.brake, 0.0, limits.max_brake), stepOf (limits.max_brake_slew, step_s));
    const bool has_channels = hasChannels (last) || hasChannels (to);
    Vec3 to_force = to.force, to_torque = to.torque;
    Channels to_axes;
    if (has_channels) to_axes = resized (to.axes, std::max (last.axes.size(), to.axes.size()));
    if (is_falling) to_axes = withoutRise (to_axes, last.axes, 2);
    const double size = fit (to_force, to_torque, to_axes);

    if (limits.max_slew == GuardLimits::none && limits.max_torque_slew == GuardLimits::none && ! has_channels)
    {
        last.force = size * to_force;
        last.torque = size * to_torque;
        return;
    }

    // Half steps, because the difference of two finite numbers may be infinite.
    Vec3 force = 0.5 * size * to_force - 0.5 * last.force, torque = 0.5 * size * to_torque - 0.5 * last.torque;
    Channels axes;
    if (has_channels) axes = mixed (0.5 * size, to_axes, -0.5, last.axes);
    const double half_s = 0.5 * step_s;
    const Most most { stepOf (limits.max_slew, half_s), stepOf (limits.max_torque_slew, half_s), stepOf (limits.max_axis_slew, half_s) };
    const double step = shareWithin (force, torque, axes, most);

    const bool arrives = step == 1.0;
    last.force = arrives ? Vec3 (size * to_force) : Vec3 (last.force + 2.0 * step * force);
    last.torque = arrives ? Vec3 (size * to_torque) : Vec3 (last.torque + 2.0 * step * torque);
    if (! has_channels) return;
    last.axes = ! arrives ? mixed (1.0, last.axes, 2.0 * step, axes) : size == 1.0 ? to_axes
                                                                                   : mixed (size, to_axes, 0.0, {});
    last.signals = approached (last.signals, is_falling ? withoutRise (to.signals, last.signals, 3) : to.signals,
                               limits.max_signal, stepOf (limits.max_signal_slew, step_s));
}

/// During a stop, and while the effort rises again.
Effort Guard::crossfaded (const Effort& wanted) const noexcept
{
    if (reason != Stop::none)
        return { withheld * at_stop.force, withheld * at_stop.torque, mixed (withheld, at_stop.axes, 0.0, {}), mixed (withheld, at_stop.signals, 0.0, {}),
                 withheld * at_stop.brake + (1.0 - withheld) * brakeAtStop() };

    // The limits of size come first: a graph that asks for ten times the limit must not get all of it after a tenth of the ramp.
    // enabled + rest never exceeds 1, so the effort can safely return before the fade is over.
    Effort within = wanted;
    const double size = fit (within.force, within.torque, within.axes), part = enabled * size, rest = std::min (withheld, 1.0 - enabled);
    within.signals = approached ({}, within.signals, limits.max_signal, GuardLimits::none);
    return { part * within.force + rest * at_stop.force, part * within.torque + rest * at_stop.torque,
             mixed (part, within.axes, rest, at_stop.axes), mixed (enabled, within.signals, rest, at_stop.signals),
             enabled * std::clamp (wanted.brake, 0.0, limits.max_brake) + rest * at_stop.brake + (1.0 - enabled - rest) * brakeAtStop() };
}

}   // namespace tactus
