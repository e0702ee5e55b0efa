// SPDX-License-Identifier: MIT
#pragma once

#include "support/eventually.hpp"
#include "support/sketch.hpp"

#include <host/device_plugins/device_driver.hpp>
#include <host/device_plugins/open_plugin_device.hpp>
#include <host/device_plugins/plugin_device.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace tactus::test
{

/// How long the driver and its threads wait for the service.
enum class Patience
{
    promised,   ///< as in a run: for tests of what a service costs that does not answer
    ample       ///< so long that a busy computer does not look like such a service
};

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
