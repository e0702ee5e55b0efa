// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/device.hpp>
#include <host/hid/hid_model.hpp>
#include <host/hid_link/hid_port.hpp>
#include <host/hid_link/shaking.hpp>
#include <host/hid_link/stream_feed.hpp>
#include <host/runtime/snapshot.hpp>

#include <array>
#include <bitset>
#include <cstdint>
#include <memory>
#include <vector>

namespace tactus::host::hid
{

/// What a device told a run.
struct ReadingCounts
{
    std::uint64_t taken = 0;                          ///< reports that were understood
    std::uint64_t lost = 0;                           ///< by the sequence numbers that did not come, without those that the port had no room for
    std::uint64_t restarts = 0;                       ///< sequence numbers that went back
    std::uint64_t skipped = 0;                        ///< understood, but another one was there before a tick looked
    std::array<std::uint64_t, refusals> refused {};   ///< by Refusal
    double age = 0.0, oldest = 0.0;                   ///< s, of the reading: now, and the most it was once there had been one
};

/// What nodes find of it by name: all of its axes, efforts and buttons; and its signal outputs, first the channels of its
/// streams, then those that its profile makes of efforts.
DeviceLayout layoutOf (const HidModel&);

/// A HID device in a run. What came is decoded, and what is to be sent is encoded, at the tick: so an answer has the pose
/// and the sequence number of the very report it answers. Neither calls the system, locks or allocates.
///
/// A reading is the newest report; its age is the ticks since then. It is not valid before the first one, while the device
/// is away, and after a report that was refused, until a good one comes. (Reports of ids that the profile does not know
/// are counted and left out: many devices send some.)
///
/// An effort of an axis that is 0 leaves it as it is in the neutral report: a frequency of 0 would be none.
///
/// A signal for a stream goes into blocks of samples at the stream's rate, each sent when it is full; one for a motor that
/// takes an amplitude becomes that.
///
/// After the device was away, or the ticks stood still so long that the port let it go, nothing is sent to it until the
/// guard has gone to zero once: then efforts rise as the guard's ramp has it.
class HidDevice final : public Device
{
public:
    explicit HidDevice (std::unique_ptr<HidPort>);

    void prepare (double dt_s) override;                    // [main thread]
    Reading read() noexcept override;                       // [tick thread]
    void write (const Effort& guarded) noexcept override;   // [tick thread]

    DeviceLayout layout() const override { return layoutOf (values); }

    HidPort& port() noexcept { return *link; }
    const HidPort& port() const noexcept { return *link; }

    /// What was decoded last, with names and units. [tick thread]
    const HidModel& model() const noexcept { return values; }

    ReadingCounts counts() const noexcept { return published.load(); }   // [any thread]

private:
    void take (const ArrivedReport&) noexcept;
    void publish() noexcept;
    void shake (const Channels& signals, HidEffort&) noexcept;

    /// A report of samples; of an output without, there is none.
    struct Streamed
    {
        std::size_t report;
        StreamFeed feed;
    };

    /// A motor that is told how to shake, by the numbers of its efforts; -1: none.
    struct Shaken
    {
        int amplitude, frequency, channel;
        double hold;   // s
        Shaking shaking {};
    };

    std::unique_ptr<HidPort> link;
    HidModel values;
    const bool only_changes;   // it is silent while nothing moves, and not old for that
    double dt = 1e-3;

    // Of the tick thread.
    ReadingCounts tally;
    std::uint64_t episode = 0, connection = 0, overflown = 0, ticks_without = 0;
    std::bitset<256> came_now;   // ids of the reports that were taken at this tick
    std::uint64_t owed = 0;      // reports without room that no sequence number has told of yet
    Nanoseconds latest = 0;      // when the one came that this tick answers; 0: none did
    bool has_one = false;        // of this connection
    bool refused = false;        // the newest one
    bool has_to_rest = true;     // until the guard has been at zero

    std::vector<Streamed> streams;
    std::vector<Shaken> shaken;

    Snapshot<ReadingCounts> published;
};

}   // namespace tactus::host::hid
