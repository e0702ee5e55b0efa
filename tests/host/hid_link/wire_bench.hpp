// SPDX-License-Identifier: MIT
#pragma once

#include <host/hid_link/fake_device.hpp>
#include <host/hid_link/hid_device.hpp>

#include <tactus/run/device/make_device.hpp>

#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <memory>
#include <span>
#include <thread>
#include <utility>
#include <vector>

// What tests of devices on a wire share.
namespace tactus::test::wire
{

using WireClock = host::hid::WireFile::Clock;

/// True as soon as the condition holds; false if it still does not hold after a long time.
template <typename F>
inline bool eventually (F&& so)
{
    const auto end = WireClock::now() + std::chrono::seconds (30);
    while (! so())
    {
        if (WireClock::now() > end) return false;
        std::this_thread::sleep_for (std::chrono::microseconds (200));
    }
    return true;
}

/// A computer without HID devices, with a clock of its own.
struct NoHid final : host::hid::HidSystem
{
    std::vector<host::hid::ConnectedDevice> connected() override { return {}; }
    Result<std::unique_ptr<host::hid::Transport>> open (const host::hid::ConnectedDevice&) override
    {
        return Message::error ("hid/not_opened", {}, "there is none");
    }
    std::chrono::steady_clock::time_point now() const noexcept override { return std::chrono::steady_clock::time_point (std::chrono::nanoseconds (ns.load())); }

    std::atomic<std::int64_t> ns = 1'000'000'000;
};

inline std::unique_ptr<Device> stillHand()
{
    auto made = makeDevice ({ { "driver", "sim" } }, {});
    REQUIRE (made.device);
    return std::move (made.device);
}

/// A device in a run without a wire: the reports of a log, and the answers after encoding. A device rests before it pushes, on its first tick unless it
/// `has_rested`.
struct OffTheWire final : Device
{
    OffTheWire (std::shared_ptr<const host::hid::Profile> p, std::span<const host::hid::Bytes> r, bool has_rested = false)
        : model (std::move (p)), reports (r), resting (has_rested ? 0 : 1)
    {
    }

    void prepare (double) override {}

    Reading read() noexcept override
    {
        model.decode (reports[tick++]);
        auto reading = model.reading();
        reading.valid = reading.valid && tick > resting;
        reading.unrendered_force = force - model.renderedForce();
        reading.unrendered_torque = torque - model.renderedTorque();
        for (std::size_t i = 0; i < model.axisNames().size(); ++i)
            reading.axes.set (static_cast<int> (i), model.sample().axes[i]);
        return reading;
    }

    void write (const Effort& guarded) noexcept override
    {
        force = guarded.force;
        torque = guarded.torque;
        host::hid::HidEffort effort { force, torque, model.restEfforts() };
        model.take (guarded.axes, effort);
        const auto bytes = model.encodeValues (0, model.drive (effort, 1e-3));
        answers.emplace_back (bytes.begin() + (host::hid::usesIds (model.profile()) ? 0 : 1), bytes.end());
    }

    DeviceLayout layout() const override { return host::hid::layoutOf (model); }

    host::hid::HidModel model;
    std::span<const host::hid::Bytes> reports;
    const std::size_t resting;   // ticks without a valid reading
    std::size_t tick = 0;
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    std::vector<host::hid::Bytes> answers;
};

}   // namespace tactus::test::wire
