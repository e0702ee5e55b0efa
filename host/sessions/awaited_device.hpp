// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid_link/hid_device.hpp>
#include <host/hid_link/open_device.hpp>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace tactus::host
{

/// A HID device that is not there yet, or that another program has: looked for until it opens, and from then on as it is.
/// Until then there is no valid reading, so that its guard holds the efforts at zero; then they rise by its ramp. What it
/// has, nodes know from the start, by its profile.
class AwaitedDevice final : public Device
{
public:
    static constexpr std::chrono::milliseconds usual_pause { 500 };   ///< between two looks

    /// What hid::openDevice takes, with a profile that is known by name. The system outlives the device.
    AwaitedDevice (Json description, std::shared_ptr<const hid::Profile>, hid::HidSystem&, std::chrono::milliseconds pause = usual_pause);
    ~AwaitedDevice() override;

    void prepare (double dt_s) override;                    // [main thread]
    Reading read() noexcept override;                       // [tick thread]
    void write (const Effort& guarded) noexcept override;   // [tick thread]
    DeviceLayout layout() const override;                   // [main thread]

    /// The device once it is there, as long as this lives; until then null. [any thread]
    hid::HidDevice* device() const noexcept { return there.load (std::memory_order_acquire); }

    const std::shared_ptr<const hid::Profile>& profile() const noexcept { return wanted; }

    /// Why it does not open, in words. [any thread]
    std::string trouble() const;

private:
    void lookOn();
    void look();

    const Json description;
    const std::shared_ptr<const hid::Profile> wanted;
    hid::HidSystem& system;
    const std::chrono::milliseconds pause;
    double dt = 1e-3;

    double age = 0.0;   // s without a reading, while there is none   [tick thread]

    mutable std::mutex mutex;   // of `last_trouble` and `stopping`
    std::condition_variable stopped;
    bool stopping = false;
    std::string last_trouble;

    std::unique_ptr<Device> opened;   // of the looking thread; never let go
    std::atomic<hid::HidDevice*> there = nullptr;
    std::jthread looking;   // last: it uses the others
};

}   // namespace tactus::host
