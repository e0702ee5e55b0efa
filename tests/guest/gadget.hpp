// SPDX-License-Identifier: MIT
#pragma once

#include "uhid.hpp"

namespace tactus::guest
{

/// The device end of a USB gadget (Linux: Documentation/usb/gadget_hid.rst): a device on its own bus, with
/// polled endpoints. The script that creates the gadget plugs it in.
class Gadget final : public VirtualDevice
{
public:
    explicit Gadget (const char* path)
    {
        fd = ::open (path, O_RDWR | O_CLOEXEC | O_NONBLOCK);
        if (fd >= 0) return;
        std::perror (path);
        std::exit (2);
    }

    ~Gadget() override { ::close (fd); }

    Gadget (const Gadget&) = delete;
    Gadget& operator= (const Gadget&) = delete;

    bool input (std::span<const std::uint8_t> report) override { return ::write (fd, report.data(), report.size()) == static_cast<ssize_t> (report.size()); }
    bool isOpen() const override { return true; }

    void serve (double until, const Heard& output) override
    {
        for (;;)
        {
            const auto wait = waitUntil (until);
            pollfd p { fd, POLLIN, 0 };
            std::array<std::uint8_t, 64> report {};
            if (::ppoll (&p, 1, &wait, nullptr) > 0)
                if (const auto size = ::read (fd, report.data(), report.size()); size > 0) output (std::span (report).first (static_cast<std::size_t> (size)));
            if (now() >= until) return;
        }
    }

private:
    int fd = -1;
};

}   // namespace tactus::guest
