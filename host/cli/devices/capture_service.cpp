// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_service.hpp"

#if defined(TACTUS_SERVICES)

#include <host/base/platform/signals.hpp>
#include <host/cli/report.hpp>
#include <host/devices/device_plugins/open_plugin_device.hpp>
#include <host/devices/hid_link/capture.hpp>
#include <host/drivers/bhaptics/vest.hpp>
#include <host/drivers/haply/inverse3.hpp>
#include <host/drivers/websocket/service_relay.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <thread>

namespace tactus::host
{

namespace
{
using Clock = std::chrono::steady_clock;

constexpr auto look = std::chrono::milliseconds (5);   // how often readings are taken, and whether the command must end

struct Service
{
    const char *driver, *usual_address;
};

constexpr Service services[] { { "haply", usual_inverse3_service }, { "bhaptics", usual_player } };
}   // namespace

bool captureService (const DeviceCapture& options)
{
    const auto colon = options.device.find (':');
    const auto name = options.device.substr (0, colon);
    const auto* service = std::ranges::find (services, name, &Service::driver);
    if (service == std::end (services)) return false;
    const auto text = colon == options.device.npos ? std::string() : options.device.substr (colon + 1);
    const auto address = ServiceAddress::read (text, service->usual_address);
    if (! address) fail ("capture/device", quote (text) + " is no address of a service", "write it as " + name + ":" + service->usual_address);

    const auto file = orFail (hid::CaptureFile::createForMessages (options.file, name));
    const auto relay = orFail (ServiceRelay::make (*address, [&file] (bool is_from_service, const std::string& message) {
        file->add (is_from_service ? hid::Capture::Line::What::in : hid::Capture::Line::What::out,
                   { reinterpret_cast<const std::uint8_t*> (message.data()), message.size() });
    }));
    auto made = openPluginDevice ({ { "driver", name }, { "port", "localhost:" + std::to_string (relay->port()) } });
    if (const auto why = relay->trouble(); ! why.empty())
        fail ("capture/device", address->host + ":" + address->port + ": " + why, "start the service, or correct the address");
    for (const auto& m : made.messages)
        if (m.severity == Message::Severity::error) fail (m);
    std::cout << "recording " << printableName (address->host + ":" + address->port) << ", driver " << name
              << "; move the tool along each axis, turn it, and press each button; Ctrl-C ends\n"
              << std::flush;
    made.device->prepare (std::chrono::duration<double> (look).count());
    const auto begin = Clock::now();
    while (file->isGood() && ! stopRequested() && (options.duration_s <= 0.0 || Clock::now() - begin < std::chrono::duration<double> (options.duration_s)))
    {
        made.device->read();
        std::this_thread::sleep_for (look);
    }
    const auto& device = dynamic_cast<const PluginDevice&> (*made.device);
    const auto readings = device.counts().readings;
    const auto trouble = device.trouble();
    made.device.reset();
    if (! file->isGood()) fail ("output/unwritable", options.file + ": the capture could not be written to its end", "check the disk");
    std::cout << "wrote " << printableName (options.file) << ": " << file->lines() << " messages; " << readings << " readings"
              << (trouble.empty() ? "" : ", last problem: " + inOneLine (trouble)) << "\n";
    return true;
}

}   // namespace tactus::host

#else

namespace tactus::host
{

bool captureService (const DeviceCapture&) { return false; }

}   // namespace tactus::host

#endif
