// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/hid/report_record.hpp>
#include <tactus/node/reading_fault.hpp>
#include <tactus/tactus_device.h>

#include <cstdint>

namespace tactus::host
{

/// Judges readings by what the device itself says about them (tactus_device_stamp), as HidDevice judges reports by their sequence number and time:
///
///  - The same number or time again is not a new reading.
///  - A lower number or an earlier time means that the device has restarted, or that readings come out of order: 16 good ones must follow.
///  - Readings that are missing count as lost: by the number, or else by the rate.
///  - A reading without a stamp that the driver has promised (tactus_device_about) is not used.
///  - A clock that falls behind the wall clock means that readings wait somewhere on the way: they are older than they seem, by
///
///        lag = (t - s) - o      o' = min (o + d T, t - s)      t: wall clock, s: clock of the device, T: time since the last reading, d: 0.1 %
///
///    so a slower clock of the device is no lag, as long as it is right to 0.1 %.
class StampWatch
{
public:
    explicit StampWatch (double rate_hz, std::uint32_t promised_stamps = 0) noexcept : rate (rate_hz), promised (promised_stamps) {}

    struct Assessment
    {
        bool is_new = true;           ///< false: the last reading is still the newest
        ReadingFault fault {};        ///< why a new reading must not be used, or why this one is not new
        double lag_s = 0.0;           ///< how much older the reading is than it seems
        std::uint64_t lost = 0;       ///< readings that are missing before this one
        bool has_gone_back = false;   ///< of the number or the time
    };

    /// A reading came at this time of the wall clock.
    Assessment operator() (const tactus_device_stamp&, double now_s) noexcept;

private:
    double lagOf (double time_s, double now_s) noexcept;

    double rate;
    std::uint32_t promised;
    hid::ReportRecord record;
    std::uint64_t number = 0;
    double time = 0.0, arrived = 0.0, offset = 0.0;
    bool has_one = false, has_clock = false, restarted = false;
};

}   // namespace tactus::host
