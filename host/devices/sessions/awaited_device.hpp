// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/hid_link/hid_device.hpp>
#include <host/devices/hid_link/open_device.hpp>

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace tactus::host
{

/// A HID device that is not connected yet, or is in use by another program. Keeps trying to open the device; once it is open,
/// passes everything on to it. Until then no reading is valid, so the guard holds the efforts at zero; then they ramp up. The
/// parts of the device are known from the start, from its profile.
class AwaitedDevice final : public Device
{
public:
    static constexpr std::chrono::milliseconds usual_pause { 500 };   ///< between two attempts to open the device

    /// `description` is the same as for hid::openDevice. The system must outlive the device.
    AwaitedDevice (Json description, std::shared_ptr<const hid::Profile>, hid::HidSystem&, std::chrono::milliseconds pause = usual_pause);
    ~AwaitedDevice() override;

    void prepare (double dt_s) override;                    // [main thread]
    Reading read() noexcept override;                       // [tick thread]
    void write (const Effort& guarded) noexcept override;   // [tick thread]
    void withhold() noexcept override;                      // [tick thread]

    void limitSignals (double max, double max_slew) override;                                                  // [main thread]
    void limitSlews (double force, double torque, double axis) override { slews = { force, torque, axis }; }   // [main thread]
    DeviceLayout layout() const override;                                                                      // [main thread]

    /// The device, once it is open; null until then. Valid as long as this object. [any thread]
    hid::HidDevice* device() const noexcept { return there.load (std::memory_order_acquire); }

    const std::shared_ptr<const hid::Profile>& profile() const noexcept { return wanted; }

    /// The reason why the latest attempt to open the device failed. [any thread]
    std::string trouble() const;

private:
    void lookOn();
    void poll();
    void note (const std::string& trouble);
    bool isStopping() const;

    const Json description;
    const std::shared_ptr<const hid::Profile> wanted;
    hid::HidSystem& system;
    const std::chrono::milliseconds pause;
    double dt = 1e-3;
    std::array<double, 3> slews { GuardLimits::none, GuardLimits::none, GuardLimits::none };   // set before the search begins

    double age = 0.0;   // time spent waiting for the device to open, without a reading, in s   [tick thread]

    mutable std::mutex mutex;   // protects the limits, `last_trouble` and `stopping`
    double max_signal = GuardLimits::none, max_signal_slew = GuardLimits::none;
    std::condition_variable stopped;
    bool stopping = false;
    std::string last_trouble;

    std::unique_ptr<Device> opened;   // set by the searching thread; stays open until this object is destroyed
    std::atomic<hid::HidDevice*> there = nullptr;
    std::jthread looking;   // declared last: it uses the other members
};

}   // namespace tactus::host
