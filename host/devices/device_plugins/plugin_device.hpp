// SPDX-License-Identifier: MIT
#pragma once

#include "device_driver.hpp"

#include <host/devices/hid/report/measured_time.hpp>
#include <tactus/kit/threads/snapshot.hpp>
#include <tactus/node/device.hpp>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>

namespace tactus::host
{

/// The counts of what has passed between a driver and a run.
struct PluginCounts
{
    std::uint64_t readings = 0;             ///< that were new and not malformed
    std::uint64_t refused = 0;              ///< malformed: a value that is not a number, or too few of them
    std::uint64_t repeated = 0;             ///< with the number or the time of the one before
    std::uint64_t lost = 0, restarts = 0;   ///< by the numbers and times of the device: missing ones, and how often they went back
    std::uint64_t read_errors = 0;
    std::uint64_t held_up = 0;   ///< how often the driver was called more slowly, because it returned at once again and again
    std::uint64_t writes = 0, write_errors = 0;
    std::uint64_t silences = 0;     ///< how often the device was brought to rest because no effort was offered for too long
    std::uint64_t departures = 0;   ///< how often the device was gone
    double oldest = 0.0;            ///< the highest age of a reading, in s
    double reached_hz = 0.0;        ///< how many new efforts per second reach the device, by the account of the driver; 0: it does not say
};

/// A device of a driver in a run. Nothing in a tick calls the driver: a thread reads, and another one writes, and they exchange the latest values with
/// the tick thread through snapshots.
///
/// Whatever a driver does, forces stay within its limits, and end when it cannot be trusted:
///
///  - A reading with a value that is not a number, or with fewer values than the driver has named, is not valid. More values are cut.
///  - The age of a reading is what the driver says, plus what the clock of the device reveals (StampWatch), plus the time since it came.
///  - Efforts keep their limits by the wall clock when they are written (EffortLimiter).
///  - If no effort is offered for `silence_s`, the device is brought to rest, again and again until the driver says that it is.
///  - If a function of the driver does not return, no reading is valid. While an effort may be on the device, the failsafe then takes it, as if the
///    program were frozen.
///  - If the driver fails to write for `silence_s`, the device is brought to rest as well. If that fails, too, the failsafe takes it.
///  - If the device is gone, or the failsafe has taken it, it is brought to rest, closed and opened again. It stays closed while its failsafe cannot
///    be armed.
///  - A driver that returns at once, again and again, is called more slowly. Its threads have less priority than ticks and stop keys.
///
/// After each return of the device, and after each silence, nothing is sent until the guard has been at zero once. Then efforts rise along its ramp.
///
/// The destructor waits for the driver for `patience`. If it does not return, its threads, its device and its plugin are left as they are.
class PluginDevice final : public Device
{
public:
    struct Options
    {
        double silence_s = GuardLimits::default_watchdog;
        std::chrono::milliseconds look_again { 500 };   ///< interval between attempts to open a device that is gone
        std::chrono::milliseconds patience { 2000 };
        bool real_time = true;   ///< real-time priority for the threads, if the system grants it
    };

    /// Starts the threads. The failsafe is that of armFailsafe(). [main thread]
    PluginDevice (std::unique_ptr<OpenedDevice>, std::optional<Failsafe>, const Options&);
    ~PluginDevice() override;   ///< [main thread]
    PluginDevice (const PluginDevice&) = delete;
    PluginDevice& operator= (const PluginDevice&) = delete;

    void prepare (double dt_s) override;                                   // [main thread]
    void limitSlews (double force, double torque, double axis) override;   // [main thread]
    void limitSignals (double max, double max_slew) override;              // [main thread]
    Reading read() noexcept override;                                      // [tick thread]
    void withhold() noexcept override { is_withheld = true; }              // [tick thread]
    void write (const Effort& guarded) noexcept override;                  // [tick thread]
    DeviceLayout layout() const override { return described.layout; }

    const DriverAbout& about() const noexcept { return described; }
    const std::string& driver() const noexcept { return called; }

    bool isConnected() const noexcept;                                    ///< [any thread]
    bool isDriven() const noexcept;                                       ///< an effort may be on the device   [any thread]
    double age() const noexcept { return age_now.load(); }                ///< of the reading of the latest tick, in s   [any thread]
    std::chrono::steady_clock::time_point lastArrival() const noexcept;   ///< of a new reading   [any thread]
    PluginCounts counts() const noexcept;                                 ///< [any thread]
    std::string trouble() const;                                          ///< the latest failure, or a call that does not return; "": none   [any thread]

private:
    class Link;

    void restartTime() noexcept;

    const DriverAbout described;
    const std::string called;
    const std::chrono::milliseconds patience;
    std::shared_ptr<Link> link;   // also held by the threads, which may outlive this object

    double dt = 1e-3;
    std::uint64_t episode = 0, seen = 0;         // of the latest tick: what it belongs to, and the number of its reading   [tick thread]
    double ticks_without = 0.0;                  // a new reading   [tick thread]
    hid::MeasuredTime measured { false, 0.0 };   // of readings without a time of the device   [tick thread]
    double numbered = 0.0, lag = 0.0;            // of the latest new reading   [tick thread]
    bool has_to_rest = true;                     // until the guard has been at zero once   [tick thread]
    bool is_withheld = false;                    // the next effort   [tick thread]
    std::atomic<double> age_now = 0.0, oldest = 0.0;
    std::uint64_t offers = 0;   // [tick thread]

    std::thread reader, writer;
};

}   // namespace tactus::host
