// SPDX-License-Identifier: MIT
#include "force_device.hpp"

#include <tactus/text/json.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <thread>
#include <utility>

namespace tactus::host::evdev
{

namespace
{
using namespace std::chrono_literals;
using Seconds = std::chrono::duration<double>;

constexpr double usual_updates_hz = 250.0;   // if the update interval of the port is not known
constexpr double watchdog = 0.05, ramp = 0.2;
constexpr auto state_again = 10ms;   // several times within the watchdog
constexpr double largest_level = 32767.0, largest_motor = 65535.0;
constexpr std::uint16_t to_the_left = 0x4000;   // of a positive level
constexpr double rumble_hold = 12.5e-3;         // s, as for rumble motors with a HID profile
constexpr Seconds between_rumbles { 10e-3 };
constexpr double track_step = 1e-4, longest_gap = 0.1;   // s
constexpr double rumble_slew = 6300.0;                   // per s: a tone of full scale at 1 kHz
constexpr double longest_between = 0.25;                 // of the measured rate: s between updates that belong together
constexpr int averaged = 16;                             // of those intervals

/// In the form of readGuardLimits.
Json jsonOf (const GuardLimits& g)
{
    Json::Object all;
    const auto put = [&] (const char* key, double value, double without) {
        if (value != without) all.emplace_back (key, Json (value));
    };
    put ("max_force", g.max_force, GuardLimits::none);
    put ("max_slew", g.max_slew, GuardLimits::none);
    put ("max_torque", g.max_torque, GuardLimits::none);
    put ("max_torque_slew", g.max_torque_slew, GuardLimits::none);
    put ("max_signal", g.max_signal, GuardLimits::none);
    put ("max_signal_slew", g.max_signal_slew, GuardLimits::none);
    put ("max_speed", g.max_speed, GuardLimits::none);
    put ("max_angular_speed", g.max_angular_speed, GuardLimits::none);
    put ("max_energy", g.max_energy, GuardLimits::none);
    put ("energy_window", g.energy_window, 0.0);
    put ("max_still", g.max_still, GuardLimits::none);
    put ("still_force", g.still_force, GuardLimits::none);
    put ("still_torque", g.still_torque, GuardLimits::none);
    put ("ramp", g.ramp, 0.0);
    put ("watchdog", g.watchdog, GuardLimits::none);
    return all;
}

template <typename Names>
int indexOf (const Names& names, std::string_view name)
{
    const auto at = std::ranges::find (names, name);
    return at == std::end (names) ? -1 : static_cast<int> (at - std::begin (names));
}
}   // namespace

ForceDevice::ForceDevice (std::unique_ptr<EventDevice> d, const hid::PidCalibration& c, double most_hz)
    : events (std::move (d)), calibration (c), pushes (events->info().has_constant), rumbles (! pushes && events->info().has_rumble)
{
    const auto& info = events->info();
    const double of_port = info.update_interval_s;
    between = Seconds (most_hz > 0.0 ? std::max (of_port, 1.0 / most_hz) : of_port > 0.0 ? of_port
                                                                                         : 1.0 / usual_updates_hz);

    std::vector<std::string> names;
    const auto driven = hid::drivenAxis (calibration);
    double travel_driven = 0.0, quantum = 0.0;
    for (const auto& a : info.axes)
    {
        // From end to end, an axis goes from -1 to 1, or by its travel.
        const auto travel = calibration.travel.find (a.name);
        const double half = travel != calibration.travel.end() ? 0.5 * travel->second : 1.0;
        const double range = static_cast<double> (a.maximum) - static_cast<double> (a.minimum);
        Axis axis { .name = a.name, .scale = 2.0 / range * half, .offset = 0.0 };
        axis.offset = -half - static_cast<double> (a.minimum) * axis.scale;
        if (travel != calibration.travel.end() && a.name == driven)
        {
            travel_driven = travel->second;
            quantum = axis.scale;
        }
        values.push_back (axis.offset + static_cast<double> (a.value) * axis.scale);
        names.push_back (a.name);
        axes.push_back (std::move (axis));
    }
    const auto known = [&] (const char* name) { return calibration.travel.contains (name) ? indexOf (names, name) : -1; };
    if (calibration.turns)
        turned = known (driven.c_str());
    else
        tool = { known ("x"), known ("y"), known ("z") };
    for (std::size_t i = 0; i < info.buttons.size(); ++i)
        if (info.buttons[i].is_down) buttons |= 1u << i;

    if (pushes) hid::limitForce (guard, calibration, travel_driven, quantum);
    const bool moves_across = travel_driven <= 0.0 && std::ranges::any_of (tool, [] (int axis) { return axis >= 0; });   // y, but no x
    if (pushes && ! calibration.turns && moves_across) hid::limitStill (guard, calibration, GuardLimits::none);
    if (rumbles)
    {
        guard.max_signal = 1.0;
        guard.max_signal_slew = rumble_slew;
    }
    guard.watchdog = watchdog;
    guard.ramp = ramp;

    effect.type = pushes ? FF_CONSTANT : FF_RUMBLE;
    effect.id = -1;
    effect.direction = pushes ? to_the_left : 0;
    effect.replay.length = static_cast<std::uint16_t> (1e3 * hid::effect_lasts);
    for (auto& amplitude : amplitudes)
        amplitude.prepare (track_step, rumble_hold);
}

std::string ForceDevice::prepare()
{
    const auto& info = events->info();
    const int failed = events->upload (effect);
    uploaded = effect;
    if (failed != 0)
    {
        if (failed == ENOSPC) return "the device has no room for another effect: close other programs that use its force feedback";
        return std::string ("the device does not take an effect: ") + std::strerror (failed);
    }
    // Full gain, because the limits count on it; and no spring of the device's own beside the force.
    if (info.has_gain) static_cast<void> (events->tell (FF_GAIN, 0xffff));                    // if this fails, the force is weaker, which is no danger
    if (info.has_autocenter && pushes) static_cast<void> (events->tell (FF_AUTOCENTER, 0));   // if this fails, the spring can be felt
    return {};
}

void ForceDevice::restore()
{
    const auto& info = events->info();
    if (info.has_gain && info.gain) static_cast<void> (events->tell (FF_GAIN, *info.gain));   // the device may be gone
    if (! info.has_autocenter || ! pushes) return;
    // In steps, so that the spring does not begin with a jolt.
    constexpr int steps = 20;
    for (int step = 1; info.autocenter.value_or (0) > 0 && step <= steps; ++step)
    {
        if (events->tell (FF_AUTOCENTER, *info.autocenter * step / steps) != 0) return;
        if (step < steps) std::this_thread::sleep_for (std::chrono::milliseconds (20));
    }
}

std::string ForceDevice::whatStaysChanged() const
{
    const auto& info = events->info();
    const bool gain = info.has_gain && ! info.gain, spring = info.has_autocenter && pushes && ! info.autocenter;
    if (! gain && ! spring) return {};
    const auto between = gain && spring ? " and " : "";
    return std::string ("the kernel does not tell ") + (gain ? "the gain" : "") + between + (spring ? "the centring spring" : "") + " of "
           + printableName (info.name) + ", so after the program ends, " + (gain ? "the gain stays full" : "") + between
           + (spring ? "the spring stays off" : "") + ", until another program sets " + (gain && spring ? "them" : "it") + " or the device is plugged in again";
}

void ForceDevice::describe (tactus_device_about& to)
{
    const auto& info = events->info();
    const bool has_position = std::ranges::any_of (tool, [] (int axis) { return axis >= 0; });
    to.tool = (has_position ? TACTUS_DEVICE_POSITION : 0) | (turned >= 0 ? TACTUS_DEVICE_ROTATION : 0);
    if (pushes) to.tool |= calibration.turns ? TACTUS_DEVICE_TORQUE : TACTUS_DEVICE_FORCE;
    if (to.size >= offsetof (tactus_device_about, unrendered) + sizeof to.unrendered)   // as pushTo() has it
        to.unrendered = TACTUS_DEVICE_NO_FORCE_Y | TACTUS_DEVICE_NO_FORCE_Z | TACTUS_DEVICE_NO_TORQUE_X | TACTUS_DEVICE_NO_TORQUE_Z;
    to.signal_outputs = rumbles ? 2 : 0;
    sentence = printableName (info.name) + " at " + printableName (info.path) + ".";
    to.about = sentence.c_str();
    for (const auto& axis : axes)
        axis_names.push_back (axis.name.c_str());
    for (const auto& button : info.buttons)
        button_names.push_back (button.name.c_str());
    to.axes = axis_names.data();
    to.axis_count = axis_names.size();
    to.buttons = button_names.data();
    to.button_count = button_names.size();
    guard_text = jsonOf (guard).dump();
    to.guard = guard_text.c_str();

    // Another process may stop an effect of this one by its id. If the program dies, the kernel has removed it already, and nothing happens.
    stop[0].type = EV_FF;
    stop[0].code = static_cast<std::uint16_t> (effect.id);
    stop_bytes.bytes = reinterpret_cast<const std::uint8_t*> (stop.data());
    stop_bytes.count = sizeof stop;
    stop_reports[0] = &stop_bytes;
    to.rest_file = info.path.c_str();
    to.rest_reports = stop_reports;
    to.rest_report_count = 1;
    to.device_watchdog_s = hid::effect_lasts;
}

//==============================================================================
// Reading

void ForceDevice::note (const EventDevice::Event& event)
{
    const auto& info = events->info();
    if (event.type == EV_ABS)
    {
        const auto at = std::ranges::find (info.axes, event.code, &EventDeviceInfo::Axis::code);
        if (at == info.axes.end()) return;
        const auto i = static_cast<std::size_t> (at - info.axes.begin());
        values[i] = axes[i].offset + static_cast<double> (event.value) * axes[i].scale;
    }
    else if (event.type == EV_KEY)
    {
        const auto at = std::ranges::find (info.buttons, event.code, &EventDeviceInfo::Button::code);
        if (at == info.buttons.end()) return;
        const auto bit = 1u << static_cast<unsigned> (at - info.buttons.begin());
        buttons = event.value != 0 ? buttons | bit : buttons & ~bit;
    }
    else
        return;
    in_frame = true;
    frame_age = event.age_s;
}

void ForceDevice::fill (tactus_reading& to) const
{
    // As with the same device through HID: a stick's y increases towards the user, its z downwards.
    constexpr std::array signs { 1.0, -1.0, -1.0 };
    for (std::size_t i = 0; i < 3; ++i)
        if (tool[i] >= 0) to.position[i] = signs[i] * values[static_cast<std::size_t> (tool[i])];
    if (turned >= 0) to.rotation[1] = values[static_cast<std::size_t> (turned)];
    to.axis_count = static_cast<std::uint32_t> (values.size());
    std::ranges::copy (values, to.axes);
    to.buttons = buttons;
    to.valid = 1;
}

std::int32_t ForceDevice::read (std::chrono::milliseconds timeout, tactus_reading& to, tactus_device_stamp& stamp)
{
    const auto answer = [&] (double age) {
        fill (to);
        to.age_s = age;
        if (stamp.size >= offsetof (tactus_device_stamp, reached_hz) + sizeof stamp.reached_hz)
            stamp.reached_hz = reached_hz.load (std::memory_order_relaxed);
        return int { TACTUS_DEVICE_OK };
    };
    const auto wait = std::min<std::chrono::milliseconds> (timeout, state_again);
    const auto state = [&] { return has_come ? answer (0.0) : int { TACTUS_DEVICE_NONE }; };
    const auto until = Clock::now() + wait;
    EventDevice::Event event;
    for (;;)
        switch (events->next (event, static_cast<int> (wait.count())))
        {
        case EventDevice::Got::gone:
            return TACTUS_DEVICE_GONE;
        case EventDevice::Got::nothing:
            return state();
        case EventDevice::Got::event:
            note (event);
            if (event.type == EV_SYN && event.code == SYN_REPORT && std::exchange (in_frame, false))
            {
                has_come = true;
                return answer (frame_age);
            }
            if (! in_frame && Clock::now() > until) return state();   // events without an axis or a button must not delay this
        }
}

//==============================================================================
// Writing

/// Updates the effect, and starts it when that is due. [writing thread]
int ForceDevice::send (Clock::time_point now, bool must_start, bool is_update)
{
    int reports = 0;
    if (is_update)
    {
        if (const int failed = events->upload (effect); failed != 0) return failed;
        uploaded = effect;
        ++reports;
    }
    if (must_start)
    {
        if (const int failed = events->tell (static_cast<std::uint16_t> (effect.id), 1); failed != 0) return failed;
        started = now;
        ++reports;
    }
    if (is_update) measure (now);
    busy_until = now + std::chrono::duration_cast<Clock::duration> (reports * between);
    return 0;
}

/// The rate of updates that follow each other. [writing thread]
void ForceDevice::measure (Clock::time_point now)
{
    const double passed = updated ? Seconds (now - *updated).count() : 0.0;
    updated = now;
    if (passed <= 0.0 || passed > longest_between) return;
    intervals = std::min (intervals + 1, averaged);
    mean_interval += (passed - mean_interval) / intervals;
    if (intervals == averaged) reached_hz.store (1.0 / mean_interval, std::memory_order_relaxed);   // a zero follows at once: one interval says little
}

int ForceDevice::pushTo (double effort, Clock::time_point now)
{
    const double share = std::clamp (effort / calibration.full_force, -calibration.usable, calibration.usable);
    const double pushed = std::round (share * largest_level);
    const auto level = static_cast<std::int16_t> (calibration.is_reversed ? pushed : -pushed);
    const bool is_update = level != effect.u.constant.level;
    const bool must_start = level != 0 && (! started || now - *started >= Seconds (hid::effect_restarts));
    if (! is_update && ! must_start) return 0;
    if (level != 0 && busy_until && now < *busy_until) return 0;   // a newer one follows
    effect.u.constant.level = level;
    const int failed = send (now, must_start, is_update);
    if (failed != 0) effect = uploaded;   // a start may fail after the upload
    return failed;
}

int ForceDevice::rumble (const double* signals, bool is_withheld, Clock::time_point now)
{
    const double passed = tracked ? std::min (longest_gap, Seconds (now - *tracked).count()) : 0.0;
    tracked = now;
    std::array<std::uint16_t, 2> wanted {};
    for (std::size_t i = 0; i < 2; ++i)
    {
        if (is_withheld) amplitudes[i].forgetPeaks();
        for (int ticks = std::max (1, static_cast<int> (std::lround (passed / track_step))); ticks > 0; --ticks)
            amplitudes[i].tick (signals[i]);
        wanted[i] = static_cast<std::uint16_t> (std::lround (std::min (1.0, amplitudes[i].amplitude()) * largest_motor));
    }
    auto& sent = effect.u.rumble;
    const bool is_zero = wanted[0] == 0 && wanted[1] == 0;
    const bool is_update = wanted[0] != sent.strong_magnitude || wanted[1] != sent.weak_magnitude;
    const bool must_start = ! is_zero && (! started || now - *started >= Seconds (hid::effect_restarts));
    if (! is_update && ! must_start) return 0;
    if (! is_zero && ((busy_until && now < *busy_until) || (updated && now - *updated < between_rumbles))) return 0;
    sent = { wanted[0], wanted[1] };
    const int failed = send (now, must_start, is_update);
    if (failed != 0) effect = uploaded;
    return failed;
}

int ForceDevice::write (const tactus_effort& effort, Clock::time_point now)
{
    if (pushes) return pushTo (calibration.turns ? effort.torque[1] : effort.force[0], now);
    const bool is_withheld = effort.size >= offsetof (tactus_effort, is_withheld) + sizeof effort.is_withheld && effort.is_withheld != 0;
    return rumbles ? rumble (effort.signals, is_withheld, now) : 0;
}

int ForceDevice::rest()
{
    const int not_stopped = events->tell (static_cast<std::uint16_t> (effect.id), 0);
    effect.u = {};
    const int not_zeroed = events->upload (effect);
    if (not_zeroed == 0) uploaded = effect;
    started.reset();
    busy_until.reset();
    updated.reset();
    tracked.reset();
    for (auto& amplitude : amplitudes)
        amplitude.forgetPeaks();
    return not_stopped != 0 ? not_stopped : not_zeroed;
}

}   // namespace tactus::host::evdev
