// SPDX-License-Identifier: MIT
#pragma once

#include "support/sketch.hpp"
#include "support/waiting.hpp"

#include <host/base/platform/peer_lock.hpp>
#include <host/devices/device_plugins/device_driver.hpp>
#include <host/devices/device_plugins/open_plugin_device.hpp>
#include <host/devices/device_plugins/plugin_device.hpp>

#include <catch2/catch.hpp>

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace tactus::test
{

/// How long the driver and its threads wait for the service.
enum class Patience
{
    promised,   ///< as in a run: for tests of what a service costs that does not answer
    ample       ///< so long that a busy computer does not look like such a service
};

/// What another program holds that drives this part of a service; empty if the lock is taken.
inline std::optional<host::PeerLock> lockOn (int port, std::string_view part = {})
{
    const int socket = ::socket (AF_INET, SOCK_STREAM, 0);
    sockaddr_in where {};
    where.sin_family = AF_INET;
    where.sin_port = htons (static_cast<std::uint16_t> (port));
    where.sin_addr.s_addr = htonl (INADDR_LOOPBACK);
    REQUIRE (::connect (socket, reinterpret_cast<const sockaddr*> (&where), sizeof where) == 0);
    auto lock = host::PeerLock::take (socket, part);
    ::close (socket);
    return std::move (lock.lock);
}

/// A fake service, and its driver on it.
template <typename Service>
struct ServiceBench
{
    /// `patient` is the driver that waits longer; `silence_s`, how long an effort lasts with it if no other one is offered.
    ServiceBench (std::unique_ptr<Service> s, const char* driver, const tactus_device_driver& patient, Patience patience, Json more, double silence_s = 60.0)
        : service (std::move (s)), description (std::move (more))
    {
        description["driver"] = driver;
        description["port"] = "localhost:" + std::to_string (service->port());
        if (patience == Patience::promised)
            opened = host::openPluginDevice (description);
        else if (const auto patient_driver = host::DeviceDriver::within (patient))
            if (auto there = (*patient_driver)->open (description, opened.messages))
            {
                opened.limits = there->about().limits;
                const host::PluginDevice::Options options { .silence_s = silence_s, .patience = std::chrono::minutes (1) };
                // Without a failsafe, which would notice that the test was suspended.
                opened.device = std::make_unique<host::PluginDevice> (std::move (there), std::nullopt, options);
            }
        INFO (text (opened.messages));
        REQUIRE (opened.device);
        device = dynamic_cast<host::PluginDevice*> (opened.device.get());
        REQUIRE (device != nullptr);
        device->prepare (1e-3);
    }

    /// One tick; `put` makes its effort if the reading is valid. True if it is.
    template <typename F>
    bool tick (F&& put)
    {
        reading = device->read();
        Effort effort;
        if (reading.valid) put (effort);
        device->write (effort);
        return reading.valid;
    }

    /// Ticks that ask for nothing until as many have been written that none from before is on its way to the driver.
    bool stops()
    {
        const auto writes = device->counts().writes;
        return eventually ([&] {
            tick ([] (Effort&) {});
            return device->counts().writes >= writes + 2;
        });
    }

    std::unique_ptr<Service> service;   // ends after the device
    Json description;
    MadeDevice opened;
    host::PluginDevice* device = nullptr;
    Reading reading;
};

}   // namespace tactus::test
