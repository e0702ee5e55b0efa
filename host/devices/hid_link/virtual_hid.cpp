// SPDX-License-Identifier: MIT
#include "virtual_hid.hpp"

#if defined(__linux__)
#include <host/base/platform/device_file.hpp>
#include <tactus/file/text_file.hpp>

#include <linux/uhid.h>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#endif

namespace tactus::host::hid
{

#if defined(__linux__)

namespace
{
constexpr auto door = "/dev/uhid";
constexpr std::uint16_t usb = 3, bluetooth = 5;   // BUS_… of <linux/input.h>

bool tell (int file, const uhid_event& event) { return ::write (file, &event, sizeof event) == static_cast<ssize_t> (sizeof event); }

template <std::size_t size>
void copyText (std::uint8_t (&into)[size], const std::string& text)
{
    std::memcpy (into, text.data(), std::min (text.size(), size - 1));   // the rest stays 0
}

/// The time that is left, for ppoll.
timespec timeUntil (VirtualHid::Clock::time_point until)
{
    const auto left = std::max (until - VirtualHid::Clock::now(), VirtualHid::Clock::duration::zero());
    const auto whole = std::chrono::duration_cast<std::chrono::seconds> (left);
    return { static_cast<time_t> (whole.count()), static_cast<long> (std::chrono::nanoseconds (left - whole).count()) };
}

void answer (int file, const uhid_event& asked, const Bytes& report)
{
    uhid_event e {};
    e.type = UHID_GET_REPORT_REPLY;
    auto& r = e.u.get_report_reply;
    r.id = asked.u.get_report.id;
    r.err = report.empty() ? EIO : 0;
    r.size = static_cast<std::uint16_t> (std::min (report.size(), sizeof r.data));
    std::memcpy (r.data, report.data(), r.size);
    tell (file, e);
}

ReportFile::Outcome taken (std::span<std::uint8_t> into, const std::uint8_t* data, std::size_t size)
{
    const auto n = std::min (size, into.size());
    std::memcpy (into.data(), data, n);
    return { .what = ReportFile::Outcome::Kind::report, .size = n };
}
}   // namespace

Result<std::unique_ptr<VirtualHid>> VirtualHid::plug (const DeviceIdentity& identity, const std::string& serial)
{
    const int file = ::open (door, O_RDWR | O_CLOEXEC | O_NONBLOCK);
    if (file < 0)
    {
        const auto why = std::generic_category().message (errno);
        if (isForbidden (door)) return Message::error ("hid/not_permitted", door, why, "run this program as root, or give this user access to the file");
        return Message::error ("fake/uhid", door, "the kernel makes no virtual HID devices here: " + why,
                               "load its module with \"sudo modprobe uhid\"; in a container, ask for the device");
    }
    std::unique_ptr<VirtualHid> device (new VirtualHid (file, serial));
    uhid_event e {};
    e.type = UHID_CREATE2;
    auto& c = e.u.create2;
    if (identity.descriptor.size() > sizeof c.rd_data) return Message::error ("fake/uhid", door, "the report descriptor is too long", "describe fewer reports");
    copyText (c.name, identity.info.product);
    copyText (c.uniq, serial);
    std::ranges::copy (identity.descriptor, c.rd_data);
    c.rd_size = static_cast<std::uint16_t> (identity.descriptor.size());
    c.bus = identity.info.bus == Bus::bluetooth ? bluetooth : usb;
    c.vendor = identity.info.vid;
    c.product = identity.info.pid;
    if (! tell (file, e)) return Message::error ("fake/uhid", door, "the kernel does not take the device: " + std::generic_category().message (errno), "");
    return device;
}

VirtualHid::~VirtualHid()
{
    uhid_event e {};
    e.type = UHID_DESTROY;
    tell (file, e);
    ::close (file);
}

VirtualHid::Outcome VirtualHid::read (std::span<std::uint8_t> into, Clock::time_point until)
{
    for (;;)
    {
        uhid_event e {};
        if (::read (file, &e, sizeof e) <= 0)
        {
            if (errno != EAGAIN && errno != EINTR) return { .what = Outcome::Kind::failure, .error = errno };
            const auto wait = timeUntil (until);
            pollfd p { file, POLLIN, 0 };
            if (::ppoll (&p, 1, &wait, nullptr) <= 0 && Clock::now() >= until) return {};
            continue;
        }
        if (e.type == UHID_OPEN) is_open = true;
        if (e.type == UHID_CLOSE) is_open = false;
        if (e.type == UHID_GET_REPORT) answer (file, e, on_ask ? on_ask (e.u.get_report.rnum, e.u.get_report.rtype == UHID_FEATURE_REPORT) : Bytes {});
        if (e.type == UHID_OUTPUT) return taken (into, e.u.output.data, e.u.output.size);
        if (e.type == UHID_SET_REPORT)
        {
            uhid_event done {};
            done.type = UHID_SET_REPORT_REPLY;
            done.u.set_report_reply.id = e.u.set_report.id;
            tell (file, done);
            return taken (into, e.u.set_report.data, e.u.set_report.size);
        }
    }
}

bool VirtualHid::send (std::span<const std::uint8_t> report)
{
    uhid_event e {};
    e.type = UHID_INPUT2;
    if (report.size() > sizeof e.u.input2.data) return false;
    e.u.input2.size = static_cast<std::uint16_t> (report.size());
    std::ranges::copy (report, e.u.input2.data);
    return tell (file, e);
}

std::string VirtualHid::path() const
{
    std::error_code failed;
    for (std::filesystem::directory_iterator at ("/sys/class/hidraw", failed), end; ! failed && at != end; at.increment (failed))
        if (const auto facts = readTextFile (at->path() / "device" / "uevent"); facts && facts->find ("HID_UNIQ=" + serial + "\n") != std::string::npos)
            return "/dev/" + at->path().filename().string();
    return {};
}

#else

Result<std::unique_ptr<VirtualHid>> VirtualHid::plug (const DeviceIdentity&, const std::string&)
{
    return Message::error ("fake/uhid", "", "virtual HID devices are made on Linux only", "choose another wire");
}
VirtualHid::~VirtualHid() = default;
VirtualHid::Outcome VirtualHid::read (std::span<std::uint8_t>, Clock::time_point) { return {}; }
bool VirtualHid::send (std::span<const std::uint8_t>) { return false; }
std::string VirtualHid::path() const { return {}; }

#endif

}   // namespace tactus::host::hid
