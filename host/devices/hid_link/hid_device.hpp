// SPDX-License-Identifier: MIT
#pragma once

#include "hid_port.hpp"
#include "stream_feed.hpp"

#include <host/devices/hid/board_stop.hpp>
#include <host/devices/hid/hid_model.hpp>
#include <host/devices/hid/reading_judge.hpp>
#include <host/devices/hid/vibration_tracker.hpp>
#include <tactus/kit/threads/snapshot.hpp>
#include <tactus/node/device.hpp>
#include <tactus/run/guard.hpp>
#include <tactus/run/guard/falling_limit.hpp>

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

namespace tactus::host::hid
{

/// Describes the counts, as in "5000 taken, 12 lost, 3 refused (2 too short, 1 wrong mark), 5 skipped, 40 stray bytes".
std::string describe (const ReadingCounts&, const PortCounts&);

/// Says how many bytes of a serial line belong to no report, and what that means if no report has come; empty: none.
std::string describeStray (const PortCounts&);

/// The parts that nodes can address by name: all axes, efforts and buttons, and the signal outputs. Of the signal outputs, the channels of the
/// streams come first, then the signals that the profile turns into efforts.
DeviceLayout layoutOf (const HidModel&);

/// A HID device in a run. Reports are decoded and encoded on the tick thread, so an answer carries the pose and the sequence
/// number of the very report that it answers. Neither step allocates or locks. At its end, write() wakes the port's writing
/// thread, so every device gets its effort right away, whichever clock drives the run; this is the only call into the system.
///
/// A reading is the newest report; its age is the time since the report arrived. If several reports say where the tool
/// is, that of the oldest counts, and reports that do not say it count for nothing. (A driven device that sends only when
/// something changes is asked for a report while it is silent, see HidPort.) It is not valid before the first
/// report, while the device is disconnected, and after a refused report until a good one arrives. (Reports whose ids the profile
/// does not know are counted and ignored: many devices send some.) Nor is it valid while an alarm of the profile is on, while more
/// than half of the last 32 reports are missing, and for 16 reports after one with an earlier number or time. A report with the
/// same number or the same time as the last one does not count as a new reading. `fault` says which of these it is.
///
/// An axis effort of 0 leaves the value of the neutral report: a frequency of 0, for example, would be meaningless.
///
/// A signal for a stream is collected into blocks of samples at the stream's rate, each sent when it is full. A signal for
/// a motor that takes an amplitude is converted to an amplitude.
///
/// A device with an emergency stop of its own is told of each stop of its guard that only a rearm ends (BoardStop).
///
/// After the device was disconnected, or the ticks paused for so long that the port sent the neutral reports, only neutral reports
/// are sent until the guard has been at zero once. Then efforts rise along the guard's ramp.
class HidDevice final : public Device
{
public:
    explicit HidDevice (std::unique_ptr<HidPort>);

    void prepare (double dt_s) override;                    // [main thread]
    Reading read() noexcept override;                       // [tick thread]
    void write (const Effort& guarded) noexcept override;   // [tick thread]
    void withhold() noexcept override;                      // [tick thread]

    /// `max` also limits the motor of a signal when the graph drives it as an effort. Steps are left to the guard. [main thread]
    void limitSignals (double max, double max_slew) override;

    void limitSlews (double force, double torque, double axis) override { values.limitSlews (force, torque, axis); }   // [main thread]

    DeviceLayout layout() const override { return layoutOf (values); }

    /// Names the guard of the role, whose latched stops are those of the device, too. It must last until the last tick. [main thread]
    void heed (const Guard& guard) noexcept { heeded.store (&guard, std::memory_order_release); }

    HidPort& port() noexcept { return *link; }
    const HidPort& port() const noexcept { return *link; }

    /// The latest decoded values, with names and units. [tick thread]
    const HidModel& model() const noexcept { return values; }

    /// The values of all efforts as last offered to the device, after all limits, in the order of HidModel::effortNames(). 0 while it
    /// is at rest. [tick thread]
    const EffortValues& effortsNow() const noexcept { return driven; }

    ReadingCounts counts() const noexcept { return published.load(); }   // [any thread]

private:
    void take (const ArrivedReport&) noexcept;
    void publish() noexcept;
    double limitOfVibration() noexcept;
    void vibrate (const Channels& signals, HidEffort&) noexcept;
    std::span<const std::uint8_t> bytesOf (std::size_t report, BoardStop::Says) noexcept;
    BoardStop::Cause latched() const noexcept;

    /// An output report that carries samples.
    struct SampleOutput
    {
        std::size_t report;
        StreamFeed feed;
    };

    /// A motor that takes amplitude and frequency, given as indices of efforts; -1: none.
    struct VibrationMotor
    {
        int amplitude, frequency, channel;
        double hold;   // in s
        VibrationTracker tracker {};
    };

    std::unique_ptr<HidPort> link;
    HidModel values;
    const Nanoseconds longest_pause;
    double dt = 1e-3;

    // [tick thread]
    ReadingJudge judge;
    std::uint64_t episode = 0, connection = 0, overflown = 0;
    Nanoseconds written = 0;   // time of the last write(); 0: none
    bool has_to_rest = true;   // true until the guard has been at zero once
    double driven_for = 0.0;   // how long the motors have been driven, in s

    // The part of the last effort that the limits of the motors removed, in N and N m.
    Vec3 unrendered_force = Vec3::Zero(), unrendered_torque = Vec3::Zero();

    std::vector<SampleOutput> streams;
    std::vector<VibrationMotor> motors;
    std::atomic<double> asked_max_signal = GuardLimits::none;   // of each amplitude   [main thread writes, tick thread reads]
    FallingLimit max_signal;
    EffortValues driven {};
    std::atomic<const Guard*> heeded = nullptr;   // ticks on the tick thread, before write()
    BoardStop board_stop;

    Snapshot<ReadingCounts> published;
};

}   // namespace tactus::host::hid
