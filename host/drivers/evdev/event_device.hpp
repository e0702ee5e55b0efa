// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/result.hpp>

#include <linux/input.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host::evdev
{

/// The known properties of an event device of Linux (/dev/input/event…).
struct EventDeviceInfo
{
    struct Axis
    {
        std::uint16_t code = 0;   ///< ABS_X, …
        std::string name;         ///< x, y, z, rx, ry, rz, throttle, rudder, steering, accelerator, brake, hat0x, …
        int minimum = 0, maximum = 0;
        int value = 0;   ///< as the kernel knows it
    };
    struct Button
    {
        std::uint16_t code = 0;   ///< BTN_TRIGGER, …
        std::string name;         ///< trigger, …
        bool is_down = false;
    };

    std::string path, name, serial, place;   ///< place: the port that it is plugged in at, as the kernel names it; empty: unknown
    std::uint16_t bus = 0, vid = 0, pid = 0;
    bool has_constant = false, has_rumble = false;   ///< effects: FF_CONSTANT, FF_RUMBLE
    bool has_gain = false, has_autocenter = false;
    std::optional<int> gain {}, autocenter {};   ///< from 0 to 65535, if the driver in the kernel tells them (sysfs); evdev itself cannot read them
    bool may_open = false;                       ///< by this user, for reading and writing
    std::vector<Axis> axes {};
    std::vector<Button> buttons {};   ///< at most 32
    double update_interval_s = 0.0;   ///< the least time between two reports to it on its bus; 0: unknown

    bool hasForceFeedback() const noexcept { return has_constant || has_rumble; }
    bool isSameAs (const EventDeviceInfo&) const;   ///< the same device, wherever it is plugged in
};

/// An open event device. One thread calls next(), another one all other functions at the same time. The destructor closes it, and the kernel
/// removes its effects. A seam: tests have a device of their own.
class EventDevice
{
public:
    enum class Got
    {
        event,
        nothing,   ///< in time
        gone
    };
    struct Event
    {
        std::uint16_t type = 0, code = 0;
        int value = 0;
        double age_s = 0.0;   ///< time since the kernel got it
    };

    virtual ~EventDevice() = default;

    virtual const EventDeviceInfo& info() const noexcept = 0;   ///< as it was when it was opened

    /// Waits for the next event. After lost events (SYN_DROPPED), it returns the events that lead from the old state to the new one. [reading thread]
    virtual Got next (Event&, int timeout_ms) = 0;

    /// Uploads an effect. An effect with the id -1 is new, and gets an id. Waits as long as the kernel's driver does. 0, or an errno. [writing thread]
    virtual int upload (ff_effect&) = 0;

    /// Writes an event of the type EV_FF: the id of an effect with 1 (plays it) or 0 (stops it), or FF_GAIN and such. 0, or an errno. [writing thread]
    virtual int tell (std::uint16_t code, int value) = 0;
};

/// The event devices of a computer.
class EventSystem
{
public:
    virtual ~EventSystem() = default;

    /// The devices with force feedback, in the order of their numbers. [opening thread]
    virtual std::vector<EventDeviceInfo> list() = 0;

    /// Opens the device at a path for reading and writing. The error gives the reason if it fails. [opening thread]
    virtual Result<std::unique_ptr<EventDevice>> open (const std::string& path) = 0;
};

/// Through libevdev.
EventSystem& thisComputer();

/// A remedy for a user without permission to open a device, in one line.
std::string howToPermit (const EventDeviceInfo&);

}   // namespace tactus::host::evdev
