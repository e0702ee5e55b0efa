// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_device.hpp"
#include "capture_service.hpp"

#include <host/base/platform/device_file.hpp>
#include <host/base/platform/signals.hpp>
#include <host/base/platform/wire_file.hpp>
#include <host/cli/report.hpp>
#include <host/devices/failsafe/failsafe.hpp>
#include <host/devices/hid_link/capture.hpp>
#include <host/devices/hid_link/hid_device.hpp>
#include <host/devices/hid_link/open_device.hpp>
#include <host/devices/hid_link/profile_library.hpp>
#include <host/devices/hid_link/serial_ports.hpp>
#include <host/devices/hid_link/udev_rule.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <thread>

namespace tactus::host
{
namespace
{
using namespace hid;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto look = 5ms;   // how often reports are taken, and whether the command must end

[[noreturn]] void failWithoutDevice (const std::string& text)
{
    fail ("capture/device", text, "name it: --device hid:PROFILE, serial:PROFILE@PORT, udp:PROFILE@ADDRESS, haply:HOST:PORT, bhaptics:HOST:PORT, or its path; "
                                  "`tactus devices` lists them");
}

/// The device that --device names. Ends the command if there is none with a profile.
FoundDevice deviceNamed (const std::string& text, const LoadedProfiles& profiles)
{
    const std::vector<std::pair<std::string, Json>> no_graph;
    auto parsed = tactus::parseDeviceOption ("device=" + text, no_graph, {});
    if (! parsed) failWithoutDevice (quote (text) + ": there is no such device");
    if (! isHid (parsed->description)) failWithoutDevice (quote (text) + " is no device with reports");
    auto found = findDevice (parsed->description, thisComputer(), profiles);
    for (const auto& m : found.messages)
        if (m.severity == Message::Severity::error) fail (Message::error (m.id, "--device " + text + m.where, m.text, m.remedy));
    return found;
}

bool goesOn (Clock::time_point begin, double duration_s)
{
    return ! stopRequested() && (duration_s <= 0.0 || Clock::now() - begin < std::chrono::duration<double> (duration_s));
}

/// Opens the device with its profile, and reads it.
std::string recordDescribed (const ChosenDevice& chosen, CaptureFile& file, double duration_s)
{
    CapturingSystem system { thisComputer(), file };
    HidDevice device { orFail (HidPort::open (system, chosen.device, chosen.profile)) };
    device.prepare (std::chrono::duration<double> (look).count());
    for (const auto begin = Clock::now(); file.isGood() && goesOn (begin, duration_s); std::this_thread::sleep_for (look))
        device.read();
    return describe (device.counts(), device.port().counts());
}

/// Reads a HID device without a profile.
void recordReports (const ConnectedDevice& device, CaptureFile& file, double duration_s)
{
    CapturingSystem system { thisComputer(), file };
    auto opened = system.open (device);
    if (! opened)
        fail (Message::error (opened.error().id, device.path, "cannot open it: " + opened.error().text,
                              opened.error().id == "hid/not_permitted" ? howToPermit (device) : "check that no other program is using it"));
    std::vector<std::uint8_t> report (longest_report + 1);
    for (const auto begin = Clock::now(); file.isGood() && goesOn (begin, duration_s);)
        if (! (*opened)->read (report, look)) return;
}

/// Reads a serial port without a profile.
void recordBytes (const ConnectedDevice& device, int baud, CaptureFile& file, double duration_s)
{
    auto line = WireFile::openSerial (device.path, baud);
    if (! line)
        fail (Message::error (line.error().id, device.path, "cannot open it: " + line.error().text,
                              isForbidden (device.path) ? howToPermit (device) : "name a serial port that no other program uses, such as /dev/ttyACM0"));
    std::array<std::uint8_t, 64> bytes {};
    for (const auto begin = Clock::now(); file.isGood() && goesOn (begin, duration_s);)
    {
        const auto got = line->read (bytes, Clock::now() + look);
        if (got.what == WireFile::Outcome::Kind::failure) return file.add (Capture::Line::What::gone, {});
        if (got.what == WireFile::Outcome::Kind::report) file.add (Capture::Line::What::in, std::span (bytes).first (got.size));
    }
}
}   // namespace

ChosenDevice chooseDevice (const std::string& text, const hid::LoadedProfiles& profiles)
{
    const auto profileFor = [&] (const ConnectedDevice& device) {
        const auto fitting = matching (profiles.profiles, device);
        return fitting.empty() ? nullptr : fitting.front();
    };
    const auto connected = eachOnce (thisComputer().connected(), profiles);
    std::error_code unseen;
    const auto ports = serialPorts();
    const bool is_port = std::ranges::find (ports, text, &SerialPort::path) != ports.end();   // in Windows, it is no file
    if (is_port || (text.find ('@') == text.npos && (text.find ('/') != text.npos || std::filesystem::exists (text, unseen))))
    {
        const auto at = std::ranges::find (connected, text, &ConnectedDevice::path);
        if (at != connected.end()) return { *at, profileFor (*at) };
        if (! is_port && ! std::filesystem::exists (text, unseen)) failWithoutDevice (quote (text) + ": there is no such device");
        ChosenDevice port;
        port.device.wire = Wire::serial;
        port.device.path = text;
        return port;
    }
    if (! text.empty())
    {
        auto found = deviceNamed (text, profiles);
        return { std::move (found.device), std::move (found.profile) };
    }
    std::vector<ChosenDevice> known;
    for (const auto& device : connected)
        if (auto profile = profileFor (device)) known.push_back ({ device, std::move (profile) });
    if (known.size() != 1) failWithoutDevice (known.empty() ? "no HID device with a profile is connected" : "several HID devices with a profile are connected");
    return std::move (known.front());
}

void readUnguarded() noexcept
{
#if ! defined(__linux__)
    Failsafe::allowUnguarded();
#endif
}

void captureDevice (const DeviceCapture& options)
{
    watchForStop();
    if (captureService (options)) return;
    readUnguarded();
    const auto profiles = loadProfileLibrary();
    const auto chosen = chooseDevice (options.device, profiles);
    const auto descriptor = chosen.device.wire == Wire::hid ? thisComputer().reportDescriptor (chosen.device) : Bytes {};
    const bool is_line = chosen.device.wire == Wire::serial && ! chosen.profile;
    const auto alone = is_line ? orFail (lockDevice (chosen.device.path)) : std::nullopt;   // another reader would take a part of the bytes of a run
    const auto file = orFail (CaptureFile::create (options.file, chosen.device, chosen.profile ? chosen.profile->id : std::string(), descriptor));
    const auto place = printableName (chosen.device.path);
    std::cout << "recording " << place << (chosen.profile ? ", profile " + printableName (chosen.profile->id) : std::string (", without a profile"))
              << "; move the tool along each axis, turn it, and press each button; Ctrl-C ends\n"
              << std::flush;
    std::string more;
    if (chosen.profile)
        more = "; " + recordDescribed (chosen, *file, options.duration_s);
    else if (chosen.device.wire == Wire::hid)
        recordReports (chosen.device, *file, options.duration_s);
    else
        recordBytes (chosen.device, options.baud, *file, options.duration_s);
    if (! file->isGood()) fail ("output/unwritable", options.file + ": the capture could not be written to its end", "check the disk");
    std::cout << "wrote " << printableName (options.file) << ": " << file->lines() << " lines" << more << "\n";
}

}   // namespace tactus::host
