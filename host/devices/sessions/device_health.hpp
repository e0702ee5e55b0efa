// SPDX-License-Identifier: MIT
#pragma once

#include "awaited_device.hpp"
#include "rate_meter.hpp"

#include <host/devices/device_plugins/plugin_device.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tactus::host
{

/// A real device of a run, either present or awaited.
struct RealDevice
{
    std::string role;
    hid::HidDevice* present = nullptr;
    const AwaitedDevice* awaited = nullptr;   ///< set if the device was missing when the run began

    hid::HidDevice* device() const noexcept { return present != nullptr ? present : awaited->device(); }   ///< null until the device is available
    const hid::Profile& profile() const noexcept { return present != nullptr ? *present->port().profile() : *awaited->profile(); }
};

/// The real device behind a driver (BoundDevice::driver); empty for a simulated one.
std::optional<RealDevice> realDevice (const std::string& role, Device&);

/// A device of a driver in a plugin, in a run.
struct PluginRole
{
    std::string role;
    const PluginDevice* device = nullptr;
};

/// The same for a device of a plugin; empty for any other.
std::optional<PluginRole> pluginRole (const std::string& role, Device&);

/// The state of a device.
struct DeviceHealth
{
    std::string role, profile;   ///< id of the profile, or name of the driver
    bool has_come = false;       ///< true if the device has been available at some time during the run
    bool connected = false;
    bool ticks = false;               ///< true if its reports tick the run
    bool read_by_tick = false;        ///< true if the tick thread reads it, or did so, rather than a thread of the port
    double age = 0.0, oldest = 0.0;   ///< age of its readings, in s: current and maximum
    std::uint64_t reports = 0, lost = 0, departures = 0;
    std::optional<double> rate_hz {};     ///< rate of its reports
    double reached_hz = 0.0;              ///< how many new efforts per second reach it, if its driver measures that; else 0
    std::optional<double> drift_ppm {};   ///< drift of its clock relative to the clock of the run; empty for the device that is that clock
    double drift_error_ppm = 0.0;         ///< standard error of the drift
    std::optional<Message> warning {};    ///< what is wrong with its wire or its profile. Ids: device/rate, device/no_frame
    std::string trouble;                  ///< the latest failure
};

/// Describes the state for a status line, as in "1000.3 reports/s, latest 0.5 ms old, clock +12 ppm". [any thread]
std::string describe (const DeviceHealth&);

/// Monitors the devices of a run, from a thread that looks now and then. Reports are timed on arrival (HidPort), so the
/// tick thread is not involved. The reference is the device that ticks the run, or else the computer's clock, which also
/// drives the timer. Lost reports, known from sequence numbers, are counted too, so they do not look like a slow clock. When
/// a device that was disconnected is back, the measurement of its rate starts again. A rate that is off by more than 2 % in two spans in a row is reported:
/// one span can contain a short pause of the computer, in which reports were lost. After a gap of a quarter of a span, both measurements begin again: what
/// came before and after a stall says nothing about the rate. [one thread]
class HealthWatch
{
public:
    /// The default for the shortest span from which the drift is estimated, in s.
    static constexpr double usual_span = 2.0;

    /// `clock_role`: the role whose device ticks the run; empty: none.
    explicit HealthWatch (std::string clock_role = {}, double shortest_span_s = usual_span) : clock (std::move (clock_role)), shortest_span (shortest_span_s) {}

    void poll (std::span<const RealDevice>, std::span<const PluginRole> = {});   ///< call about ten times a second

    const std::vector<DeviceHealth>& health() const noexcept { return known; }   ///< as of the last look

private:
    struct Meter
    {
        std::string role;
        /// Adds a look, or begins again after a gap.
        void add (double at_s, std::uint64_t reports, double longest_gap_s) noexcept;

        RateMeter rate {}, recent {};   // `recent`: begins again after each `shortest_span`
        double latest_s = 0.0;
        std::uint64_t departures = 0;
        int wrong = 0;           // how many spans in a row were too slow (< 0) or too fast
        double wrong_hz = 0.0;   // the rate in the last one of them
    };

    Meter& meterOf (const std::string& role);
    void poll (const PluginRole&);
    void judgeRate (Meter&, DeviceHealth&, double nominal_hz) const;

    double longestGap() const noexcept { return 0.25 * shortest_span; }

    std::string clock;
    double shortest_span;
    std::vector<Meter> meters;
    std::vector<DeviceHealth> known;
};

}   // namespace tactus::host
