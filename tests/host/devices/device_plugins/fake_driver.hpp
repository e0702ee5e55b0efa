// SPDX-License-Identifier: MIT
#pragma once

#include "support/waiting.hpp"

#include <host/devices/device_plugins/open_plugin_device.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace tactus::test
{

/// A driver within the test. It does what the test says, and remembers what it was told. There is one at a time.
class FakeDriver
{
public:
    /// What the device was told.
    struct Told
    {
        std::string what;   // "open", "force", "rest", "close"
        double force = 0.0;
        double at_s = 0.0;   // since the fake was made
    };

    /// A reading that comes next.
    struct Sent
    {
        tactus_reading reading {};
        std::uint64_t number = 0;
        double time_s = 0.0;
        std::uint32_t fault = 0;
        int answer = TACTUS_DEVICE_OK;
    };

    FakeDriver()
    {
        now = this;
        auto made = host::DeviceDriver::within (entry());
        INFO ((made ? std::string() : made.error().text));
        REQUIRE (made);
        driver = std::move (*made);
    }
    ~FakeDriver()
    {
        letGo();
        now = nullptr;
    }
    FakeDriver (const FakeDriver&) = delete;
    FakeDriver& operator= (const FakeDriver&) = delete;

    // What `open` says.
    std::uint32_t tool = TACTUS_DEVICE_POSITION | TACTUS_DEVICE_FORCE;
    std::vector<const char*> axes {}, efforts {}, buttons {};
    int signal_inputs = 0, signal_outputs = 0;
    double rate_hz = 1000.0, mass = 0.0, device_watchdog_s = 0.02;
    std::uint32_t stamps = TACTUS_DEVICE_NUMBERS;
    std::string guard = R"({"max_force": "2 N", "ramp": "10 ms", "watchdog": "50 ms"})";
    std::string rest_file {};
    std::function<void (tactus_device_about&)> changes {};

    // How the functions behave from now on.
    std::atomic<bool> opens = true, is_gone = false, spins = false, read_hangs = false, write_hangs = false, close_hangs = false, rest_fails = false;
    std::atomic<int> write_answer = TACTUS_DEVICE_OK, write_takes_ms = 0;

    std::shared_ptr<const host::DeviceDriver> driver;
    const Stopwatch watch;

    /// Ends the calls that hang.
    void letGo()
    {
        read_hangs = write_hangs = close_hangs = false;
        changed.notify_all();
    }

    void send (Sent s)
    {
        {
            const std::lock_guard lock (mutex);
            waiting.push_back (s);
        }
        changed.notify_all();
    }

    /// A good reading.
    void send (double x)
    {
        Sent s;
        s.reading.valid = 1;
        s.reading.position[0] = x;
        s.number = ++number;
        send (s);
    }

    std::vector<Told> told() const
    {
        const std::lock_guard lock (mutex);
        return log;
    }
    std::string lastTold() const
    {
        const std::lock_guard lock (mutex);
        return log.empty() ? std::string() : log.back().what;
    }
    int count (const std::string& what) const
    {
        const auto all = told();
        return static_cast<int> (std::ranges::count (all, what, &Told::what));
    }
    int reads() const noexcept { return calls; }

    std::unique_ptr<host::PluginDevice> open (host::PluginDevice::Options options = usual(), Messages* messages = nullptr)
    {
        Messages found;
        auto opened = driver->open ({ { "driver", "fake" }, { "port", "a" } }, found);
        if (messages != nullptr) *messages = found;
        std::string wrong;
        for (const auto& m : found)
            wrong += m.text + "\n";
        INFO (wrong);
        REQUIRE (opened);
        auto armed = host::armFailsafe (opened->about());
        REQUIRE (armed);
        auto device = std::make_unique<host::PluginDevice> (std::move (opened), std::move (*armed), options);
        device->prepare (1e-3);
        return device;
    }

    /// Long enough that a busy computer does not count as silent.
    static host::PluginDevice::Options usual()
    {
        return { .silence_s = 5.0, .look_again = std::chrono::milliseconds (2), .patience = std::chrono::milliseconds (500), .real_time = false };
    }

private:
    static inline FakeDriver* now = nullptr;

    static void say (const tactus_plugin_report* report, const std::string& text) noexcept { report->put (report->context, text.data(), text.size()); }

    static std::int32_t check (const tactus_device_description* given, const tactus_plugin_report* report) noexcept
    {
        if (std::string (given->port) != "wrong") return TACTUS_DEVICE_OK;
        say (report, "the port is wrong");
        return TACTUS_DEVICE_FAILED;
    }

    static void* openDevice (const tactus_device_description*, tactus_device_about* about, const tactus_plugin_report* report) noexcept
    {
        if (! now->opens)
        {
            say (report, "nobody is there");
            return nullptr;
        }
        static const std::string last = "rest!";
        static const tactus_device_bytes bytes { sizeof bytes, reinterpret_cast<const std::uint8_t*> (last.data()), last.size() };
        static const tactus_device_bytes* const reports[] { &bytes };
        about->tool = now->tool;
        about->about = "A fake.";
        about->axes = now->axes.data();
        about->axis_count = now->axes.size();
        about->efforts = now->efforts.data();
        about->effort_count = now->efforts.size();
        about->buttons = now->buttons.data();
        about->button_count = now->buttons.size();
        about->signal_inputs = now->signal_inputs;
        about->signal_outputs = now->signal_outputs;
        about->mass = now->mass;
        about->rate_hz = now->rate_hz;
        about->guard = now->guard.c_str();
        about->device_watchdog_s = now->device_watchdog_s;
        about->stamps = now->stamps;
        if (! now->rest_file.empty())
        {
            about->rest_file = now->rest_file.c_str();
            about->rest_reports = reports;
            about->rest_report_count = 1;
        }
        if (now->changes) now->changes (*about);
        now->tell ({ "open" });
        return now;
    }

    static std::int32_t read (void*, std::int32_t timeout_ms, tactus_reading* to, tactus_device_stamp* stamp, const tactus_plugin_report* report) noexcept
    {
        auto& self = *now;
        ++self.calls;
        std::unique_lock lock (self.mutex);
        if (self.read_hangs) self.changed.wait (lock, [&self] { return ! self.read_hangs; });
        if (self.is_gone)
        {
            say (report, "it was pulled out");
            return TACTUS_DEVICE_GONE;
        }
        if (self.spins)
        {
            to->valid = 1;
            return TACTUS_DEVICE_OK;
        }
        self.changed.wait_for (lock, std::chrono::milliseconds (timeout_ms), [&self] { return ! self.waiting.empty() || self.is_gone || self.read_hangs; });
        if (self.waiting.empty()) return TACTUS_DEVICE_NONE;
        const auto sent = self.waiting.front();
        self.waiting.pop_front();
        const auto size = to->size;
        *to = sent.reading;
        to->size = size;
        stamp->number = sent.number;
        stamp->time_s = sent.time_s;
        stamp->fault = sent.fault;
        if (sent.answer == TACTUS_DEVICE_FAILED) say (report, "it is broken");
        return sent.answer;
    }

    static std::int32_t write (void*, const tactus_effort* effort, const tactus_plugin_report* report) noexcept
    {
        auto& self = *now;
        if (self.write_takes_ms > 0) letPass (std::chrono::milliseconds (self.write_takes_ms));
        std::unique_lock lock (self.mutex);
        if (self.write_hangs) self.changed.wait (lock, [&self] { return ! self.write_hangs; });
        self.log.push_back ({ "force", effort->force[0], self.watch.s() });
        self.latest = *effort;
        if (self.write_answer == TACTUS_DEVICE_FAILED) say (report, "it is busy");
        return self.write_answer;
    }

    static std::int32_t rest (void*, const tactus_plugin_report* report) noexcept
    {
        now->tell ({ "rest", 0.0, now->watch.s() });
        if (! now->rest_fails) return TACTUS_DEVICE_OK;
        say (report, "it is stuck");
        return TACTUS_DEVICE_FAILED;
    }

    static void close (void*) noexcept
    {
        if (now == nullptr) return;
        {
            std::unique_lock lock (now->mutex);
            if (now->close_hangs) now->changed.wait (lock, [] { return ! now->close_hangs; });
        }
        now->tell ({ "close" });
    }

    void tell (Told t)
    {
        const std::lock_guard lock (mutex);
        log.push_back (std::move (t));
    }

    static const tactus_device_driver& entry()
    {
        static const char* const keys[] { "port" };
        static const tactus_device_driver one { sizeof one,
                                                TACTUS_DEVICE_ABI,
                                                "fake",
                                                "1",
                                                "A driver within a test.",
                                                keys,
                                                1,
                                                check,
                                                openDevice,
                                                read,
                                                write,
                                                rest,
                                                close,
                                                nullptr };
        return one;
    }

    mutable std::mutex mutex;
    std::condition_variable changed;
    std::deque<Sent> waiting;
    std::vector<Told> log;
    tactus_effort latest {};
    std::uint64_t number = 0;
    std::atomic<int> calls = 0;

public:
    tactus_effort lastEffort() const
    {
        const std::lock_guard lock (mutex);
        return latest;
    }
};

inline FakeDriver::Sent good (std::uint64_t number = 0)
{
    FakeDriver::Sent sent;
    sent.reading.valid = 1;
    sent.number = number;
    return sent;
}

/// The next reading that the driver sends, once the device has it.
inline Reading readingOf (host::PluginDevice& device, FakeDriver& fake, FakeDriver::Sent sent)
{
    const auto before = device.counts();
    fake.send (sent);
    REQUIRE (eventually ([&] {
        const auto now = device.counts();
        return now.readings + now.refused + now.repeated > before.readings + before.refused + before.repeated;
    }));
    return device.read();
}

}   // namespace tactus::test
