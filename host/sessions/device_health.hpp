// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "awaited_device.hpp"
#include "rate_meter.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tactus::host
{

/// A device of a run that is really there, or will be.
struct RealDevice
{
    std::string role;
    hid::HidDevice* present = nullptr;
    const AwaitedDevice* awaited = nullptr;   ///< if it was not there when the run began

    hid::HidDevice* device() const noexcept { return present != nullptr ? present : awaited->device(); }   ///< null until it has come
    const hid::Profile& profile() const noexcept { return present != nullptr ? *present->port().profile() : *awaited->profile(); }
};

/// The same of a device that a role has (BoundDevice::driver); nothing if it is not a real one.
std::optional<RealDevice> realDevice (const std::string& role, Device&);

/// How a device is doing.
struct DeviceHealth
{
    std::string role, profile;   ///< id of the profile
    bool has_come = false;       ///< it was there once
    bool connected = false;
    bool ticks = false;               ///< the run goes by its clock
    double age = 0.0, oldest = 0.0;   ///< s, of its readings: now, and the most
    std::uint64_t reports = 0, lost = 0, departures = 0;
    std::optional<double> rate_hz {};     ///< of its reports
    std::optional<double> drift_ppm {};   ///< how much faster its clock goes than the one that ticks; not of the one that ticks
    double drift_error_ppm = 0.0;         ///< standard error
    std::string trouble;                  ///< what failed last
};

/// "1000.3 reports/s, 0 ms old, +12 ppm": in short, for a line that stands. [any thread]
std::string describe (const DeviceHealth&);

/// Keeps account of the devices of a run, from a thread that looks now and then. A device's reports are timed as they come in
/// (HidPort), so that nothing is asked of the tick thread; the reference is the device that ticks, or else the clock of the
/// computer, which the timer goes by. Reports that were lost are counted too, as their numbers tell, so that they do not
/// look like a slow clock; when a device was away the measurement begins anew. [one thread]
class HealthWatch
{
public:
    /// Before this a drift would be a guess, s.
    static constexpr double usual_span = 2.0;

    /// `clock_role`: whose device ticks; empty: none of them.
    explicit HealthWatch (std::string clock_role = {}, double shortest_span_s = usual_span) : clock (std::move (clock_role)), shortest_span (shortest_span_s) {}

    void look (std::span<const RealDevice>);   ///< some ten times a second

    const std::vector<DeviceHealth>& health() const noexcept { return known; }   ///< as it was at the last look

private:
    struct Meter
    {
        std::string role;
        RateMeter rate;
        std::uint64_t departures = 0;
    };

    Meter& meterOf (const std::string& role);

    std::string clock;
    double shortest_span;
    std::vector<Meter> meters;
    std::vector<DeviceHealth> known;
};

}   // namespace tactus::host
