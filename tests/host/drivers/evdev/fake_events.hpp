// SPDX-License-Identifier: MIT
#pragma once

#include <host/drivers/evdev/event_device.hpp>

#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace tactus::test
{

/// The event devices of a computer, in memory. What a program does to them is noted; what they send, the test says.
class FakeEvents final : public host::evdev::EventSystem
{
public:
    using Info = host::evdev::EventDeviceInfo;
    using Event = host::evdev::EventDevice::Event;

    /// What a device was told.
    struct Told
    {
        std::string what;   // upload, play, stop, gain, autocenter
        int id = 0, level = 0, weak = 0, length_ms = 0;
    };

    /// A device, open or not.
    struct Device
    {
        Info info;
        bool is_there = true, is_denied = false, is_open = false, hangs = false;
        bool is_read = true;    // false: no read finds out that it is gone
        int upload_fails = 0;   // an errno
        std::deque<Event> waiting {};
        std::vector<Told> told {};
        int effects = 0;
    };

    static Info wheel()
    {
        Info info;
        info.path = "/nowhere/event5";
        info.name = "Test wheel";
        info.bus = 3;
        info.vid = 0x046d;
        info.pid = 0xc24f;
        info.has_constant = info.has_gain = info.has_autocenter = true;
        info.gain = 0x9000;
        info.autocenter = 0x4000;
        info.may_open = true;
        info.axes = { { .code = ABS_X, .name = "x", .minimum = 0, .maximum = 65535, .value = 32768 },
                      { .code = ABS_Z, .name = "z", .minimum = 0, .maximum = 255, .value = 255 } };
        info.buttons = { { .code = BTN_TRIGGER, .name = "trigger" }, { .code = BTN_THUMB, .name = "thumb" } };
        return info;
    }

    static Info pad()
    {
        auto info = wheel();
        info.name = "Test pad";
        info.has_constant = false;
        info.has_rumble = true;
        return info;
    }

    Device& add (Info info)
    {
        const std::lock_guard lock (mutex);
        devices.push_back (std::make_unique<Device>());
        devices.back()->info = std::move (info);
        return *devices.back();
    }

    template <typename F>
    auto with (F&& f) const
    {
        const std::lock_guard lock (mutex);
        return f();
    }

    void send (Device& to, std::initializer_list<Event> events)
    {
        {
            const std::lock_guard lock (mutex);
            to.waiting.insert (to.waiting.end(), events);
        }
        changed.notify_all();
    }

    /// The axis x, as a whole report.
    void move (Device& to, int x) { send (to, { { EV_ABS, ABS_X, x, 0.0 }, { EV_SYN, SYN_REPORT, 0, 0.0 } }); }

    void change (Device& d, bool is_there, bool hangs = false)
    {
        {
            const std::lock_guard lock (mutex);
            d.is_there = is_there;
            d.hangs = hangs;
        }
        changed.notify_all();
    }

    std::vector<Told> told (const Device& d) const
    {
        return with ([&] { return d.told; });
    }

    /// The force that acts: the last level while the effect plays; 0 if it was stopped since.
    int acting (const Device& d) const
    {
        return with ([&] {
            int level = 0;
            bool plays = false;
            for (const auto& t : d.told)
            {
                if (t.what == "upload") level = t.level;
                if (t.what == "play") plays = true;
                if (t.what == "stop") plays = false;
            }
            return plays && d.is_open ? level : 0;
        });
    }

    std::vector<Info> list() override
    {
        return with ([&] {
            std::vector<Info> all;
            for (const auto& d : devices)
                if (d->is_there && d->info.hasForceFeedback()) all.push_back (d->info);
            return all;
        });
    }

    Result<std::unique_ptr<host::evdev::EventDevice>> open (const std::string& path) override
    {
        const std::lock_guard lock (mutex);
        for (auto& d : devices)
            if (d->is_there && d->info.path == path)
            {
                if (d->is_denied) return Message::error ("device/not_opened", path, "this user may not open it: " + host::evdev::howToPermit (d->info), "");
                if (std::exchange (d->is_open, true)) return Message::error ("device/not_opened", path, "another role is using it", "");
                d->effects = 0;
                d->waiting.clear();
                return std::unique_ptr<host::evdev::EventDevice> (std::make_unique<Opened> (*this, *d));
            }
        return Message::error ("device/not_opened", path, "No such file or directory", "check that it is plugged in");
    }

private:
    class Opened final : public host::evdev::EventDevice
    {
    public:
        Opened (FakeEvents& o, Device& d) : of (o), device (d), about (d.info) {}
        ~Opened() override
        {
            const std::lock_guard lock (of.mutex);
            device.is_open = false;
        }
        Opened (const Opened&) = delete;
        Opened& operator= (const Opened&) = delete;

        const Info& info() const noexcept override { return about; }

        Got next (Event& to, int timeout_ms) override
        {
            std::unique_lock lock (of.mutex);
            of.changed.wait_for (lock, std::chrono::milliseconds (timeout_ms), [&] { return ! device.waiting.empty() || isGone(); });
            if (isGone()) return Got::gone;
            if (device.waiting.empty()) return Got::nothing;
            to = device.waiting.front();
            device.waiting.pop_front();
            return Got::event;
        }

        int upload (ff_effect& effect) override
        {
            std::unique_lock lock (of.mutex);
            of.changed.wait (lock, [&] { return ! device.hangs; });
            if (! device.is_there) return ENODEV;
            if (device.upload_fails != 0) return device.upload_fails;
            if (effect.id < 0) effect.id = static_cast<std::int16_t> (device.effects++);
            const bool is_constant = effect.type == FF_CONSTANT;
            device.told.push_back ({ .what = "upload",
                                     .id = effect.id,
                                     .level = is_constant ? effect.u.constant.level : effect.u.rumble.strong_magnitude,
                                     .weak = is_constant ? 0 : effect.u.rumble.weak_magnitude,
                                     .length_ms = effect.replay.length });
            return 0;
        }

        int tell (std::uint16_t code, int value) override
        {
            const std::lock_guard lock (of.mutex);
            if (! device.is_there) return ENODEV;
            const auto what = code == FF_GAIN ? "gain" : code == FF_AUTOCENTER ? "autocenter"
                                                     : value != 0              ? "play"
                                                                               : "stop";
            device.told.push_back ({ .what = what, .id = code, .level = value });
            return 0;
        }

    private:
        bool isGone() const noexcept { return ! device.is_there && device.is_read; }

        FakeEvents& of;
        Device& device;
        const Info about;
    };

    mutable std::mutex mutex;
    std::condition_variable changed;
    std::vector<std::unique_ptr<Device>> devices;
};

}   // namespace tactus::test
