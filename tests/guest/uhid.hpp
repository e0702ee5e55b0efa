// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/hid_link/virtual_hid.hpp>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tactus::guest
{

inline double now()
{
    timespec t {};
    clock_gettime (CLOCK_MONOTONIC, &t);
    return static_cast<double> (t.tv_sec) + 1e-9 * static_cast<double> (t.tv_nsec);
}

/// A virtual HID device. It is plugged in as long as this object exists.
class VirtualDevice
{
public:
    using Heard = std::function<void (std::span<const std::uint8_t>)>;

    virtual ~VirtualDevice() = default;

    /// Returns false if the report did not fit; it is then lost.
    virtual bool input (std::span<const std::uint8_t> report) = 0;

    /// True while a program has the device open, as far as the device can tell.
    virtual bool isOpen() const = 0;

    /// Handles requests from the computer until the given time; calls back with each output report.
    virtual void serve (double until, const Heard&) = 0;
};

/// The timeout for poll: the remaining time, at most half a second.
inline timespec waitUntil (double until)
{
    const double left = until - now();
    return { 0, left > 0.0 ? static_cast<long> (std::min (left, 0.5) * 1e9) : 0 };
}

/// A device through the kernel's uhid, without a bus.
class Uhid final : public VirtualDevice
{
public:
    Uhid (const char* name, const char* serial, std::uint16_t vid, std::uint16_t pid, std::span<const std::uint8_t> descriptor)
    {
        host::hid::DeviceIdentity identity;
        identity.info.product = name;
        identity.info.vid = vid;
        identity.info.pid = pid;
        identity.descriptor.assign (descriptor.begin(), descriptor.end());
        auto plugged = host::hid::VirtualHid::plug (identity, serial);
        if (! plugged)
        {
            std::fprintf (stderr, "%s\n", describe (plugged.error()).c_str());
            std::exit (2);
        }
        device = std::move (*plugged);
    }

    /// The answer to a request for the report with this id. Empty: the request is refused.
    void answerWith (std::function<std::vector<std::uint8_t> (std::uint8_t)> answer)
    {
        device->on_ask = [answer = std::move (answer)] (std::uint8_t id, bool) { return answer (id); };
    }

    bool input (std::span<const std::uint8_t> report) override { return device->send (report); }
    bool isOpen() const override { return device->isOpen(); }

    void serve (double until, const Heard& output) override
    {
        using Clock = host::hid::VirtualHid::Clock;
        std::array<std::uint8_t, host::hid::longest_report> report {};
        for (double t = now(); t < until; t = now())
        {
            const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration> (std::chrono::duration<double> (until - t));
            const auto got = device->read (report, end);
            if (got.what == host::ReportFile::Outcome::Kind::failure) return;
            if (got.what == host::ReportFile::Outcome::Kind::report) output (std::span (report).first (got.size));
        }
    }

private:
    std::unique_ptr<host::hid::VirtualHid> device;
};

/// The value of "--name VALUE" in the arguments.
inline double option (const std::vector<std::string>& args, const std::string& name, double otherwise)
{
    for (std::size_t i = 0; i + 1 < args.size(); ++i)
        if (args[i] == "--" + name) return std::strtod (args[i + 1].c_str(), nullptr);
    return otherwise;
}

inline std::string text (const std::vector<std::string>& args, const std::string& name, const std::string& otherwise)
{
    for (std::size_t i = 0; i + 1 < args.size(); ++i)
        if (args[i] == "--" + name) return args[i + 1];
    return otherwise;
}

/// Blocks while the device is unplugged.
inline void pauseFor (double seconds)
{
    const auto whole = static_cast<time_t> (seconds);
    const timespec wait { whole, static_cast<long> ((seconds - static_cast<double> (whole)) * 1e9) };
    ::nanosleep (&wait, nullptr);
}

/// Writes a log to the file --log, or stdout.
inline void writeLog (const std::vector<std::string>& args, const std::string& lines)
{
    if (auto* file = std::fopen (text (args, "log", "/dev/stdout").c_str(), "w"))
    {
        std::fputs (lines.c_str(), file);
        std::fclose (file);
    }
}

/// Creates the file --mark after `enough` forces. A script that waits for the file does not have to guess how long it takes
/// until a device receives forces.
class Mark
{
public:
    explicit Mark (const std::vector<std::string>& args) : path (text (args, "mark", "")) {}

    void count()
    {
        if (++counted == enough && ! path.empty())
            if (auto* file = std::fopen (path.c_str(), "w")) std::fclose (file);
    }

private:
    static constexpr int enough = 200;
    std::string path;
    int counted = 0;
};

int board (const std::vector<std::string>& args);
int spaceMouse (const std::vector<std::string>& args);
int joystick (const std::vector<std::string>& args);
int wheel (const std::vector<std::string>& args);
int dualSense (const std::vector<std::string>& args);
int switchPro (const std::vector<std::string>& args);

}   // namespace tactus::guest
