// SPDX-License-Identifier: MIT
#pragma once

#include "hid_model.hpp"
#include "report_record.hpp"
#include <host/devices/hid/report/measured_time.hpp>

#include <tactus/node/device.hpp>

#include <array>
#include <bitset>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace tactus::host::hid
{

/// A time in ns, on a clock that only moves forward.
using Nanoseconds = std::int64_t;

/// The readings of a device during a run.
struct ReadingCounts
{
    std::uint64_t taken = 0;                          ///< reports that were decoded
    std::uint64_t lost = 0;                           ///< missing sequence numbers, not counting reports that the port had no room for
    std::uint64_t restarts = 0;                       ///< sequence numbers that went backwards
    std::uint64_t skipped = 0;                        ///< reports that a newer one with the same id replaced within the same tick
    std::array<std::uint64_t, refusals> refused {};   ///< refused reports, indexed by Refusal
    double age = 0.0, oldest = 0.0;                   ///< age of the reading, in s: now, and the maximum since the first reading
};

/// The judge of a device's reports: decodes each one, and says what the reading is worth. HidDevice describes when a reading is not valid, and what
/// its age is. The program and the page that drives devices from a browser use this class. Neither allocates nor throws after construction. Each tick
/// calls begin(), then take() for each report that has arrived, then reading(). For one thread at a time.
class ReadingJudge
{
public:
    /// The time at which a tick asks for the reading, and what the tick knows.
    struct Tick
    {
        double period_s = 0.0;      ///< 0: the caller has no ticks, and only the clock counts
        Nanoseconds now = 0;        ///< on the clock of the arrivals
        double driven_s = 0.0;      ///< how long the motors have been driven
        bool is_connected = true;   ///< false: no reading is valid
        bool is_usable = true;      ///< false: newer reports may have been lost on the way, so none counts as new
    };

    /// The model must outlive the judge.
    explicit ReadingJudge (HidModel&);

    /// Nothing has been heard, as before the first tick. Counts stay.
    void prepare() noexcept;

    /// A new connection: the device's clocks and counters start again.
    void reconnect() noexcept;

    /// So many reports were dropped before they could be taken. The gaps that they leave in the numbers are not losses of the device.
    void dropped (std::uint64_t count) noexcept { owed += count; }

    void begin() noexcept;

    /// Takes a report, as HidModel::decode, that arrived at this time, which is not 0.
    void take (std::span<const std::uint8_t> report, Nanoseconds arrival) noexcept;

    Reading reading (const Tick&) noexcept;

    /// The arrival of the last report that was taken since begin(); 0: none.
    Nanoseconds latest() const noexcept { return newest; }

    const ReadingCounts& counts() const noexcept { return tally; }

private:
    void judge (Nanoseconds arrival, std::uint64_t lost) noexcept;
    void restartTime() noexcept;
    void time() noexcept;
    ReadingFault fault (bool is_connected) const noexcept;

    /// The last arrival of a report.
    struct ReportArrival
    {
        double age (bool comes, Nanoseconds arrival, double lag_s, double period_s, Nanoseconds now) noexcept;   // in s; call once per tick

        std::optional<std::size_t> id {};   // empty: any report
        std::uint64_t ticks_without = 0;
        Nanoseconds at = 0;   // 0: never
        double lag = 0.0;     // how much older it was then, in s
    };

    HidModel& values;
    const bool has_ids;
    const double expected_rate;   // of reports without numbers, in Hz; 0: their loss cannot be detected
    ReadingCounts tally;
    std::vector<ReportArrival> heard;   // of the reports that say where the tool is, if they have ids; else one entry for all reports
    std::bitset<256> came_now;          // ids of the reports decoded since begin()
    std::uint64_t owed = 0;             // reports that were dropped and have not shown up as a gap in the sequence numbers yet
    Nanoseconds newest = 0;
    bool was_connected = false;
    bool has_one = false;   // true once a report that says where the tool is has been decoded since the device was connected
    bool refused = false;   // true if the newest report was refused

    ReportRecord record;
    bool restarted = false;         // a report's number or time went backwards; true until enough new reports have arrived to trust the record again
    ReadingFault standing {};       // why the newest report is not a new reading: repeated or clock_stopped
    Nanoseconds arrived_last = 0;   // arrival of the report before; 0: none since the device was connected

    const InputReport* timed = nullptr;   // the only kind of report that says where the tool is; null: there are several, or none
    MeasuredTime measured { false, 0.0 };
    Nanoseconds timed_at = 0;                               // arrival of the newest of this kind since begin(); 0: none
    double clock = 0.0, passed_on_clock = 0.0, lag = 0.0;   // its time, the time since the one that time() took last, and its lag, in s
};

}   // namespace tactus::host::hid
