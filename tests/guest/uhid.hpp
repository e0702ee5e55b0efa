// SPDX-License-Identifier: MIT
#pragma once

#include <linux/uhid.h>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <span>
#include <string>
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

/// A device through the kernel's uhid (Linux: Documentation/hid/uhid.rst), without a bus.
class Uhid final : public VirtualDevice
{
public:
    static constexpr std::uint16_t usb = 3;

    Uhid (const char* name, const char* serial, std::uint16_t vid, std::uint16_t pid, std::span<const std::uint8_t> descriptor)
    {
        fd = ::open ("/dev/uhid", O_RDWR | O_CLOEXEC);
        if (fd < 0)
        {
            std::perror ("/dev/uhid");
            std::exit (2);
        }
        uhid_event e {};
        e.type = UHID_CREATE2;
        auto& c = e.u.create2;
        std::snprintf (reinterpret_cast<char*> (c.name), sizeof c.name, "%s", name);
        std::snprintf (reinterpret_cast<char*> (c.uniq), sizeof c.uniq, "%s", serial);
        std::memcpy (c.rd_data, descriptor.data(), descriptor.size());
        c.rd_size = static_cast<std::uint16_t> (descriptor.size());
        c.bus = usb;
        c.vendor = vid;
        c.product = pid;
        tell (e);
    }

    ~Uhid() override
    {
        uhid_event e {};
        e.type = UHID_DESTROY;
        tell (e);
        ::close (fd);
    }

    Uhid (const Uhid&) = delete;
    Uhid& operator= (const Uhid&) = delete;

    /// The answer to a request for the report with this id. Empty: the request is refused.
    std::function<std::vector<std::uint8_t> (std::uint8_t)> on_ask {};

    bool input (std::span<const std::uint8_t> report) override
    {
        uhid_event e {};
        e.type = UHID_INPUT2;
        e.u.input2.size = static_cast<std::uint16_t> (report.size());
        std::memcpy (e.u.input2.data, report.data(), report.size());
        tell (e);
        return true;
    }

    bool isOpen() const override { return opened; }

    void serve (double until, const Heard& output) override
    {
        for (;;)
        {
            const auto wait = waitUntil (until);
            pollfd p { fd, POLLIN, 0 };
            if (::ppoll (&p, 1, &wait, nullptr) <= 0)
            {
                if (now() >= until) return;
                continue;
            }
            uhid_event e {};
            if (::read (fd, &e, sizeof e) <= 0) return;
            if (e.type == UHID_OPEN) opened = true;
            if (e.type == UHID_CLOSE) opened = false;
            if (e.type == UHID_OUTPUT) output (std::span<const std::uint8_t> (e.u.output.data, e.u.output.size));
            if (e.type == UHID_GET_REPORT) reply (e);
            if (e.type == UHID_SET_REPORT)
            {
                output (std::span<const std::uint8_t> (e.u.set_report.data, e.u.set_report.size));
                uhid_event reply {};
                reply.type = UHID_SET_REPORT_REPLY;
                reply.u.set_report_reply.id = e.u.set_report.id;
                tell (reply);
            }
        }
    }

private:
    void tell (const uhid_event& e)
    {
        if (::write (fd, &e, sizeof e) < 0) std::perror ("uhid");
    }

    void reply (const uhid_event& asked)
    {
        const auto report = on_ask ? on_ask (asked.u.get_report.rnum) : std::vector<std::uint8_t> {};
        uhid_event e {};
        e.type = UHID_GET_REPORT_REPLY;
        auto& r = e.u.get_report_reply;
        r.id = asked.u.get_report.id;
        r.err = report.empty() ? EIO : 0;
        r.size = static_cast<std::uint16_t> (report.size());
        std::memcpy (r.data, report.data(), report.size());
        tell (e);
    }

    int fd = -1;
    bool opened = false;
};

/// The value of "--name VALUE" in the arguments.
inline double option (const std::vector<std::string>& args, const std::string& name, double otherwise)
{
    for (std::size_t i = 0; i + 1 < args.size(); ++i)
        if (args[i] == "--" + name) return std::atof (args[i + 1].c_str());
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
