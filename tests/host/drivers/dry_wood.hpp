// SPDX-License-Identifier: MIT
#pragma once

#include "readings.hpp"
#include "support/waiting.hpp"

#include <host/devices/device_plugins/device_driver.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/run/engine.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

namespace tactus::test
{

/// Dry wood on a device of a driver, and on one that reads what the test tells it. All calls of the driver are on the thread of the ticks, so a fake that
/// answers at once makes virtual time: no time passes but that of the calls.
class DryWood
{
public:
    DryWood (const tactus_device_driver& table, Json description)
    {
        const auto driver = host::DeviceDriver::within (table);
        REQUIRE (driver);
        description["driver"] = table.name;
        device.opened = (*driver)->open (description, messages);
        REQUIRE (device.opened);
        limits.max_force = about().limits.max_force;
        const auto file = loadGraph (std::filesystem::path (TACTUS_SOURCE_DIR) / "graphs/dry_wood.json");
        REQUIRE_FALSE (hasErrors (file.messages));
        for (auto* each : { &offline, &live })
        {
            const auto plan = compile (file.graph, catalogue()).plan;
            REQUIRE (plan);
            each->emplace (plan);
        }
        offline->attach ("stylus", told, limits);
        live->attach ("stylus", device, limits);
    }

    const host::DriverAbout& about() const { return device.opened->about(); }

    /// The place of the hand at this reading. It touches from the start, and again and again.
    static Vec3 placeAt (int reading)
    {
        const double time = reading / 4000.0;
        return { 0.02 * std::sin (9.0 * time), 0.02 + 0.01 * std::sin (5.0 * time), -1e-3 + 1.5e-3 * std::cos (7.0 * time + 2.0) };
    }

    using IsNext = std::function<bool (const tactus_reading&, const tactus_device_stamp&)>;

    /// Reads once more, as a run that waits for its first reading does.
    bool reads (const IsNext& is_next)
    {
        device.is_next = is_next;
        return device.read().valid;
    }

    /// A tick of both: with the reading that `is_next` knows, and with this position. Returns the force of the render.
    Vec3 tick (const Vec3& rounded, const IsNext& is_next)
    {
        device.is_next = is_next;
        told.next.position = rounded;
        told.next.valid = device.is_past_first;
        live->tick();
        offline->tick();
        device.is_past_first = true;   // the first tick brings a device to rest
        pushed += told.last.force.isZero (0.0) ? 0 : 1;
        return told.last.force;
    }

    /// Writes the last force again, for a device that has given it up because the computer was busy.
    void writeAgain() { device.write (told.last); }

    bool hasFailed() const { return device.has_failed; }
    int pushes() const { return pushed; }

private:
    struct Told final : Device
    {
        void prepare (double) override {}
        Reading read() noexcept override { return next; }
        void write (const Effort& effort) noexcept override { last = effort; }
        Reading next;
        Effort last;
    };

    struct Driven final : Device
    {
        void prepare (double) override {}
        Reading read() noexcept override
        {
            tactus_reading from {};
            tactus_device_stamp stamp {};
            Reading reading;
            const auto has_come = [&] { return opened->read (std::chrono::milliseconds (50), from, stamp, why) == TACTUS_DEVICE_OK && is_next (from, stamp); };
            reading.valid = eventually (std::chrono::nanoseconds (0), has_come) && is_past_first;
            reading.position = Position (from.position);
            return reading;
        }
        void write (const Effort& effort) noexcept override
        {
            has_failed = opened->write (effort, false, GuardLimits::none, why) != TACTUS_DEVICE_OK || has_failed;
        }
        std::unique_ptr<host::OpenedDevice> opened;
        host::DriverReport why;
        IsNext is_next;
        bool is_past_first = false, has_failed = false;
    };

    Messages messages;
    GuardLimits limits;
    Told told;
    Driven device;
    std::optional<Engine> offline, live;
    int pushed = 0;
};

}   // namespace tactus::test
