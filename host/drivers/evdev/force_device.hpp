// SPDX-License-Identifier: MIT
#pragma once

#include "event_device.hpp"

#include <host/devices/hid/calibration.hpp>
#include <host/devices/hid/vibration_tracker.hpp>
#include <tactus/tactus_device.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host::evdev
{

/// A wheel, a joystick or a pad with force feedback, through its event device. It uses a single effect: the constant force (FF_CONSTANT), or, if
/// the device has none, its two rumble motors (FF_RUMBLE). The effect is uploaded once and then updated. It lasts for `effect_lasts`, and is
/// restarted while a force acts, so it ends by itself when the program dies; the kernel removes it, too.
///
/// A device with a constant force gets no rumble, although most kernel drivers offer it: the same motor would render both, and no limit would hold
/// for the sum.
///
/// An update that comes before the port of the device can take it is skipped, unless it ends the force: Linux queues updates for a slow
/// device, and a queue is a delay.
///
/// Times are passed in, so that tests need no clock.
class ForceDevice
{
public:
    using Clock = std::chrono::steady_clock;

    /// `most_hz`: how many updates per second the person allows; 0: as many as the port takes, or 250 if that is unknown.
    ForceDevice (std::unique_ptr<EventDevice>, const hid::PidCalibration&, double most_hz);

    /// Uploads the effects, without a force. Returns the reason if it fails; empty if it succeeds. [opening thread]
    std::string prepare();

    /// Gives the wheel back the gain and the centring spring that it had, if they are known. The effects must rest. [opening thread]
    void restore();

    /// The sentence about settings that stay changed when the program ends, because the kernel does not tell their old values; empty if there are none.
    std::string whatStaysChanged() const;

    /// The description of the device. Refers to this object.
    void describe (tactus_device_about&);

    /// The limits, as in docs/safety.md.
    const GuardLimits& limits() const noexcept { return guard; }

    /// The next reading. While nothing changes, the state counts as a new reading every 10 ms: Linux reports only changes, and the
    /// loss of the device. There is no reading before the first event, because until then the state may be older than the opening of the device.
    /// TACTUS_DEVICE_OK, … [reading thread]
    std::int32_t read (std::chrono::milliseconds timeout, tactus_reading&, tactus_device_stamp&);

    /// Passes on an effort. 0, or an errno. [writing thread]
    int write (const tactus_effort&, Clock::time_point now);

    /// Ends force and rumble. 0, or an errno. [writing thread]
    int rest();

    const EventDevice& device() const noexcept { return *events; }
    std::chrono::duration<double> interval() const noexcept { return between; }   ///< at least, between two updates

private:
    struct Axis
    {
        std::string name;
        double scale = 1.0, offset = 0.0;
    };

    void note (const EventDevice::Event&);
    void fill (tactus_reading&) const;
    int pushTo (double effort, Clock::time_point now);
    int rumble (const double* signals, bool is_withheld, Clock::time_point now);
    int send (Clock::time_point now, bool must_start, bool is_update);
    void measure (Clock::time_point now);

    const std::unique_ptr<EventDevice> events;
    const hid::PidCalibration calibration;
    const bool pushes, rumbles;   // has a constant force; otherwise, has rumble motors
    std::chrono::duration<double> between;
    GuardLimits guard;
    std::string guard_text, sentence;
    std::vector<Axis> axes;
    std::array<int, 3> tool { -1, -1, -1 };   // which axes are the position
    int turned = -1;                          // which one is the rotation
    std::vector<const char*> axis_names, button_names;
    std::array<input_event, 1> stop {};
    tactus_device_bytes stop_bytes = TACTUS_DEVICE_BYTES_INIT;
    const tactus_device_bytes* stop_reports[1] {};

    // [reading thread]
    std::vector<double> values;
    std::uint32_t buttons = 0;
    bool has_come = false, in_frame = false;
    double frame_age = 0.0;

    // [writing thread]
    ff_effect effect {}, uploaded {};   // the wanted one, and the one in the kernel
    std::optional<Clock::time_point> busy_until, started, updated, tracked;
    double mean_interval = 0.0;
    int intervals = 0;   // in that mean
    std::array<hid::VibrationTracker, 2> amplitudes;

    std::atomic<double> reached_hz = 0.0;
};

}   // namespace tactus::host::evdev
